#include "core/shot_extent.hpp"

#include <Eigen/Core>
#include <vector>

#include "core/assumed_sensor.hpp"
#include "core/principal_axes.hpp"

namespace raywatch {

ShotExtent extent_in_shots(const ScanView& view, std::span<const std::uint32_t> members) {
  const auto count = static_cast<double>(members.size());
  const auto direction_of_member = [&](std::uint32_t i) {
    return Eigen::Vector3d(view.points[i].cast<double>().normalized());
  };
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  for (const std::uint32_t i : members) center += direction_of_member(i) / count;
  Eigen::Vector3d eastward = Eigen::Vector3d::UnitZ().cross(center);
  if (eastward.squaredNorm() == 0.0) eastward = Eigen::Vector3d::UnitX();
  eastward.normalize();
  const Eigen::Vector3d northward = center.cross(eastward).normalized();
  const Eigen::Vector2d spacing_rad = spacing_of(view);

  std::vector<Eigen::Vector2d> shots;
  for (const std::uint32_t i : members) {
    const Eigen::Vector3d direction = direction_of_member(i);
    shots.push_back(Eigen::Vector2d(eastward.dot(direction), northward.dot(direction)).cwiseQuotient(spacing_rad));
  }
  // The variance of n values a step apart is (n^2 - 1) / 12.
  const Eigen::Vector2d extent = (12.0 * principal_axes_of<2>(shots).variances.array() + 1.0).sqrt();
  return {.length = extent[1], .width = extent[0], .filled = count / extent.prod()};
}

}  // namespace raywatch
