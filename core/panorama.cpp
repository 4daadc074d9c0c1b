#include "core/panorama.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/error.hpp"

namespace raywatch {
namespace {

constexpr double kPi = std::numbers::pi;

std::size_t cell_of(const Eigen::Vector3d& point_m) {
  const double elevation = std::atan2(point_m.z(), std::hypot(point_m.x(), point_m.y()));
  const double azimuth = std::atan2(point_m.y(), point_m.x());
  const auto row = static_cast<std::size_t>(std::max(0.0, (elevation / kPi + 0.5) * Panorama::kRows));
  const auto column = static_cast<std::size_t>(std::max(0.0, (azimuth / (2 * kPi) + 0.5) * Panorama::kColumns));
  return std::min(row, Panorama::kRows - 1) * Panorama::kColumns + std::min(column, Panorama::kColumns - 1);
}

std::uint16_t encode(double range_m) {
  return static_cast<std::uint16_t>(1 + std::lround(std::min(1000.0 * std::log2(1.0 + range_m), 65534.0)));
}

}  // namespace

double Panorama::range_m(std::size_t cell) const {
  return farthest[cell] == 0 ? 0.0 : std::exp2((farthest[cell] - 1) / 1000.0) - 1.0;
}

Panorama make_panorama(const PointCloud& points, const UsableRange& usable) {
  std::vector<double> farthest_m(Panorama::kRows * Panorama::kColumns, 0.0);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector3d point_m = points[i].cast<double>();
    const double range_m = point_m.norm();
    if (!is_usable(range_m, usable)) continue;
    double& farthest = farthest_m[cell_of(point_m)];
    farthest = std::max(farthest, range_m);
  }
  Panorama panorama;
  panorama.farthest.reserve(farthest_m.size());
  for (const double range_m : farthest_m) panorama.farthest.push_back(range_m > 0.0 ? encode(range_m) : 0);
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

bool covers(const Panorama& panorama, const Pose& sensor_from_world, const Eigen::Vector3d& point_m) {
  constexpr double kBehind = 0.05;  // of the range: within it a point may still be part of the farthest surface
  const Eigen::Vector3d local_m = sensor_from_world * point_m;
  const double seen_m = panorama.range_m(cell_of(local_m));
  return seen_m > 0.0 && local_m.norm() <= seen_m * (1.0 + kBehind) + kBehind;
}

double reach_m(const Panorama& panorama) {
  double farthest_m = 0.0;
  for (std::size_t cell = 0; cell < panorama.farthest.size(); ++cell) {
    farthest_m = std::max(farthest_m, panorama.range_m(cell));
  }
  return farthest_m;
}

}  // namespace raywatch
