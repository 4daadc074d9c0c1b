#include "core/passing_rays.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/assumed_sensor.hpp"

namespace raywatch {
namespace {

constexpr float kNone = std::numeric_limits<float>::infinity();
constexpr double kTurn_rad = 2.0 * std::numbers::pi;

/// A sector is at least two shots wide, so that none is empty by chance.
std::size_t sector_count(const ScanView& scan) {
  constexpr double kFewest = 90.0, kMost = 7200.0;
  return static_cast<std::size_t>(std::clamp(kTurn_rad / (2.0 * spacing_of(scan).x()), kFewest, kMost));
}

double turn_of(double x, double y) { return (std::atan2(y, x) + std::numbers::pi) / kTurn_rad; }  // 0..1

}  // namespace

PassingRays::PassingRays(const ScanView& scan, const Extent& extent)
    : position_m_(scan.world_from_sensor.position_m),
      extent_(extent),
      sectors_(sector_count(scan)),
      steps_(static_cast<std::size_t>(extent.reach_m / extent.step_m) + 1),
      least_slope_(sectors_ * steps_, kNone) {
  const Eigen::Matrix3d rotation = scan.world_from_sensor.orientation.toRotationMatrix();
  const UsableRange& usable = scan.index.usable();
  for (std::size_t i = 0; i < scan.points.size(); ++i) {
    const Eigen::Vector3d in_sensor_m = scan.points[i].cast<double>();
    if (!is_usable(in_sensor_m.norm(), usable)) continue;
    const Eigen::Vector3d ray_m = rotation * in_sensor_m;
    const double distance_m = ray_m.head<2>().norm();
    const auto passed = static_cast<std::size_t>(distance_m / extent.step_m);
    if (passed == 0) continue;
    const std::size_t sector =
        std::min(static_cast<std::size_t>(turn_of(ray_m.x(), ray_m.y()) * static_cast<double>(sectors_)), sectors_ - 1);
    float& least = least_slope_[sector * steps_ + std::min(passed, steps_) - 1];
    least = std::min(least, static_cast<float>(ray_m.z() / distance_m));
  }
  for (std::size_t sector = 0; sector < sectors_; ++sector) {
    float* const slopes = &least_slope_[sector * steps_];
    for (std::size_t step = steps_ - 1; step > 0; --step) slopes[step - 1] = std::min(slopes[step - 1], slopes[step]);
  }
}

float PassingRays::least_slope(std::size_t sector, double distance_m) const {
  const auto step = static_cast<std::size_t>(distance_m / extent_.step_m);
  return step < steps_ ? least_slope_[sector * steps_ + step] : kNone;
}

double PassingRays::ceiling_m(const Eigen::Vector2d& center_m, double cell_m) const {
  const Eigen::Vector2d from_m = center_m - position_m_.head<2>();
  const double half_m = cell_m * std::numbers::sqrt2 / 2.0;
  const double near_m = from_m.norm() - half_m, far_m = from_m.norm() + half_m;
  if (near_m <= 0.0) return kNone;
  const auto count = static_cast<double>(sectors_);
  const double middle = turn_of(from_m.x(), from_m.y()) * count;
  const double half = std::asin(half_m / from_m.norm()) / kTurn_rad * count;
  double ceiling_m = -std::numeric_limits<double>::infinity();
  for (double sector = std::floor(middle - half); sector <= middle + half; ++sector) {
    const double wrapped = std::fmod(sector + count, count);
    const double slope = least_slope(static_cast<std::size_t>(wrapped), far_m);
    ceiling_m = std::max({ceiling_m, near_m * slope, far_m * slope});
  }
  return position_m_.z() + ceiling_m;
}

}  // namespace raywatch
