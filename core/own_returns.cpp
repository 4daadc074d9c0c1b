#include "core/own_returns.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace raywatch {
namespace {

constexpr std::int64_t kCellColumns = 1440, kCellRows = 720;
constexpr double kCell_rad = 2.0 * std::numbers::pi / kCellColumns;

double azimuth_rad(const Eigen::Vector3d& p) { return std::atan2(p.y(), p.x()) + std::numbers::pi; }
double elevation_rad(const Eigen::Vector3d& p) {
  return std::atan2(p.z(), p.head<2>().norm()) + 0.5 * std::numbers::pi;
}

std::int64_t cell_of(double angle_rad) { return static_cast<std::int64_t>(std::floor(angle_rad / kCell_rad)); }

std::int64_t wrapped(std::int64_t column) { return ((column % kCellColumns) + kCellColumns) % kCellColumns; }

}  // namespace

OwnReturns::OwnReturns(const PointCloud& points, const UsableRange& usable) {
  // A point at the sensor itself stands for a shot without return.
  constexpr float kLeast_m = 0.05f;
  const auto least_m2 = kLeast_m * kLeast_m, most_m2 = static_cast<float>(usable.min_m * usable.min_m);
  if (!(most_m2 > least_m2)) return;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const float x = points.x_m[i], y = points.y_m[i], z = points.z_m[i];
    const float range_m2 = x * x + y * y + z * z;
    if (!(range_m2 < most_m2 && range_m2 > least_m2)) continue;
    const Eigen::Vector3d p(x, y, z);
    const std::int64_t row = std::min(kCellRows - 1, cell_of(elevation_rad(p)));
    cells_.push_back(static_cast<std::uint32_t>(row * kCellColumns + wrapped(cell_of(azimuth_rad(p)))));
  }
  std::ranges::sort(cells_);
  cells_.erase(std::ranges::unique(cells_).begin(), cells_.end());
  cells_.shrink_to_fit();
}

bool OwnReturns::hide(const Eigen::Vector3d& direction, const Eigen::Vector2d& around_rad) const {
  if (cells_.empty()) return false;
  const double elevation = elevation_rad(direction), azimuth = azimuth_rad(direction);
  const double flat = std::max(direction.head<2>().norm() / direction.norm(), 1e-3);
  const double half_width = std::min(around_rad.x() / flat, std::numbers::pi);
  const std::int64_t first_row = std::max<std::int64_t>(0, cell_of(elevation - around_rad.y()));
  const std::int64_t last_row = std::min(kCellRows - 1, cell_of(elevation + around_rad.y()));
  const std::int64_t first = cell_of(azimuth - half_width),
                     last = std::min(cell_of(azimuth + half_width), first + kCellColumns - 1);
  const auto any_in = [&](std::int64_t row, std::int64_t from, std::int64_t to) {
    const auto found = std::ranges::lower_bound(cells_, static_cast<std::uint32_t>(row * kCellColumns + from));
    return found != cells_.end() && *found <= static_cast<std::uint32_t>(row * kCellColumns + to);
  };
  for (std::int64_t row = first_row; row <= last_row; ++row) {
    const std::int64_t from = wrapped(first), to = wrapped(last);
    if (from <= to ? any_in(row, from, to) : any_in(row, from, kCellColumns - 1) || any_in(row, 0, to)) return true;
  }
  return false;
}

}  // namespace raywatch
