#include "core/panorama.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/error.hpp"
#include "core/index_kernels.hpp"

namespace raywatch {
namespace {

constexpr double kPi = std::numbers::pi;

std::size_t cell_of(float azimuth_rad, float elevation_rad) {
  const auto row = static_cast<std::size_t>(std::max(0.0, (elevation_rad / kPi + 0.5) * Panorama::kRows));
  const auto column = static_cast<std::size_t>(std::max(0.0, (azimuth_rad / (2 * kPi) + 0.5) * Panorama::kColumns));
  return std::min(row, Panorama::kRows - 1) * Panorama::kColumns + std::min(column, Panorama::kColumns - 1);
}

/// Calls visit(i, range_m, cell) for every point, in order.
template <class Visit>
void for_each_cell(const PointPlanes& points, Visit visit) {
  constexpr std::size_t kBlock = 1024;
  std::array<float, kBlock> ranges_m, azimuths_rad, elevations_rad;
  for (std::size_t begin = 0; begin < points.size; begin += kBlock) {
    const std::size_t count = std::min(kBlock, points.size - begin);
    to_spherical(points.subspan(begin, count), ranges_m.data(), azimuths_rad.data(), elevations_rad.data());
    for (std::size_t k = 0; k < count; ++k) {
      visit(begin + k, ranges_m[k], std::isfinite(ranges_m[k]) ? cell_of(azimuths_rad[k], elevations_rad[k]) : 0);
    }
  }
}

std::uint16_t encode(double range_m) {
  return static_cast<std::uint16_t>(1 + std::lround(std::min(1000.0 * std::log2(1.0 + range_m), 65534.0)));
}

/// The ranges of all codes: looking one up is far quicker than computing it, and millions are asked for.
const std::vector<double>& decoded_ranges_m() {
  static const std::vector<double> ranges_m = [] {
    std::vector<double> all{0.0};
    for (int code = 1; code <= std::numeric_limits<std::uint16_t>::max(); ++code) {
      all.push_back(std::exp2((code - 1) / 1000.0) - 1.0);
    }
    return all;
  }();
  return ranges_m;
}

}  // namespace

double Panorama::range_m(std::size_t cell) const { return decoded_ranges_m()[farthest[cell]]; }

Panorama make_panorama(const PointCloud& points, const UsableRange& usable) {
  std::vector<float> farthest_m(Panorama::kRows * Panorama::kColumns, 0.0f);
  for_each_cell(planes_of(points), [&](std::size_t, float range_m, std::size_t cell) {
    if (is_usable(range_m, usable)) farthest_m[cell] = std::max(farthest_m[cell], range_m);
  });
  Panorama panorama;
  panorama.farthest.reserve(farthest_m.size());
  for (const float range_m : farthest_m) panorama.farthest.push_back(range_m > 0.0f ? encode(range_m) : 0);
  return panorama;
}

std::vector<std::uint8_t> to_bytes(const Panorama& panorama) {
  std::vector<std::uint8_t> bytes;
  bytes.reserve(panorama.farthest.size() * 2);
  for (const std::uint16_t code : panorama.farthest) {
    bytes.push_back(static_cast<std::uint8_t>(code & 0xff));
    bytes.push_back(static_cast<std::uint8_t>(code >> 8));
  }
  return bytes;
}

Panorama panorama_from_bytes(std::span<const std::uint8_t> bytes) {
  constexpr std::size_t kCells = Panorama::kRows * Panorama::kColumns;
  if (bytes.size() != 2 * kCells) {
    throw CorruptData("A stored panorama has " + std::to_string(bytes.size()) + " bytes instead of " +
                      std::to_string(2 * kCells) + ".");
  }
  Panorama panorama;
  panorama.farthest.resize(kCells);
  for (std::size_t i = 0; i < kCells; ++i) {
    panorama.farthest[i] = static_cast<std::uint16_t>(bytes[2 * i] | (bytes[2 * i + 1] << 8));
  }
  return panorama;
}

std::vector<std::uint8_t> covered(const Panorama& panorama, const Pose& sensor_from_world,
                                  std::span<const Eigen::Vector3d> points_m) {
  constexpr double kBehind = 0.05;  // of the range: within it a point may still be part of the farthest surface
  PointCloud local;
  local.reserve(points_m.size());
  for (const Eigen::Vector3d& point_m : points_m) {
    const Eigen::Vector3f p = (sensor_from_world * point_m).cast<float>();
    local.push_back(p.x(), p.y(), p.z());
  }
  std::vector<std::uint8_t> inside(points_m.size());
  const std::vector<double>& ranges_m = decoded_ranges_m();
  for_each_cell(planes_of(local), [&](std::size_t i, float range_m, std::size_t cell) {
    const double seen_m = ranges_m[panorama.farthest[cell]];
    inside[i] = seen_m > 0.0 && range_m <= seen_m * (1.0 + kBehind) + kBehind;
  });
  return inside;
}

double reach_m(const Panorama& panorama) {
  const auto farthest = std::max_element(panorama.farthest.begin(), panorama.farthest.end());
  return panorama.range_m(static_cast<std::size_t>(farthest - panorama.farthest.begin()));
}

}  // namespace raywatch
