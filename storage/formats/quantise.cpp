#include "storage/formats/quantise.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>
#include <variant>

#include "storage/formats/out_buffer.hpp"
#include "storage/formats/write.hpp"

namespace raywatch {
namespace {

constexpr double kSteps = 65535.0;

/// The column of a name and type; nothing there: empty.
template <class T>
std::span<const T> column(const PointTable& table, std::string_view name) {
  const auto found = std::ranges::find(table.columns, name, &PointColumn::name);
  if (found == table.columns.end()) return {};
  const auto* values = std::get_if<std::span<const T>>(&found->values);
  return values ? *values : std::span<const T>{};
}

struct Columns {
  CoordinatePlanes points;
  std::span<const std::uint8_t> classes;
  std::span<const float> intensity;
};

std::uint64_t count_finite(const CoordinatePlanes& points) {
  std::uint64_t count = 0;
  for (std::size_t i = 0; i < points.size(); ++i) count += points[i].allFinite() ? 1U : 0U;
  return count;
}

void write_header(OutBuffer& out, const Columns& columns, const Quantisation& quantisation,
                  const Eigen::Vector3d& origin_m) {
  constexpr std::uint32_t kVersion = 1;
  out.text("RWPQ");
  out.bits(kVersion);
  out.bits(count_finite(columns.points));
  out.bits(quantisation.total);
  out.bits(quantisation.first);
  const Eigen::Vector3d low_m = quantisation.box_m.isEmpty() ? Eigen::Vector3d::Zero() : quantisation.box_m.min();
  for (const double value : Eigen::Vector3d(low_m + origin_m)) out.bits(value);
  for (const double value : quantisation.step_m()) out.bits(value);
  out.bits(quantisation.intensity_low);
  out.bits(quantisation.intensity_high);
  out.bits(std::uint32_t{columns.classes.empty() ? 0U : 1U} | (columns.intensity.empty() ? 0U : 2U));
  out.bits(std::uint32_t{0});
}

/// The share of `most` that stands for a value between zero and `whole`.
template <class T>
T share_of(double value, double whole, double most) {
  if (!(whole > 0.0) || !std::isfinite(value)) return 0;
  return static_cast<T>(std::clamp(std::round(value / whole * most), 0.0, most));
}

void write_point(OutBuffer& out, const Columns& columns, std::size_t i, const Quantisation& quantisation) {
  const Eigen::Vector3d offset_m = columns.points[i] - quantisation.box_m.min();
  const Eigen::Vector3d extent_m = quantisation.box_m.sizes();
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    out.bits(share_of<std::uint16_t>(offset_m[axis], extent_m[axis], kSteps));
  }
  out.bits(columns.classes.empty() ? std::uint8_t{0} : columns.classes[i]);
  constexpr double kBrightest = 255.0;
  const double low = quantisation.intensity_low;
  const double span = static_cast<double>(quantisation.intensity_high) - low;
  out.bits(columns.intensity.empty()
               ? std::uint8_t{0}
               : share_of<std::uint8_t>(static_cast<double>(columns.intensity[i]) - low, span, kBrightest));
}

}  // namespace

Eigen::Vector3d Quantisation::step_m() const {
  if (box_m.isEmpty()) return Eigen::Vector3d::Zero();
  return box_m.sizes() / kSteps;
}

Quantisation quantisation_of(const CoordinatePlanes& points, std::span<const float> intensity) {
  Quantisation result;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector3d point_m = points[i];
    if (!point_m.allFinite()) continue;
    result.box_m.extend(point_m);
    ++result.total;
  }
  bool is_first = true;
  for (const float value : intensity) {
    if (!std::isfinite(value)) continue;
    result.intensity_low = is_first ? value : std::min(result.intensity_low, value);
    result.intensity_high = is_first ? value : std::max(result.intensity_high, value);
    is_first = false;
  }
  return result;
}

void write_quantised(OutBuffer& out, const PointTable& table) {
  const Columns columns{.points = {table.x_m, table.y_m, table.z_m},
                        .classes = column<std::uint8_t>(table, "class"),
                        .intensity = column<float>(table, "intensity")};
  const Quantisation quantisation =
      table.quantisation ? *table.quantisation : quantisation_of(columns.points, columns.intensity);
  write_header(out, columns, quantisation, table.origin_m);
  for (std::size_t i = 0; i < columns.points.size(); ++i) {
    if (columns.points[i].allFinite()) write_point(out, columns, i, quantisation);
  }
}

}  // namespace raywatch
