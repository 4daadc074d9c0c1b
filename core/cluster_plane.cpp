#include "core/cluster_plane.hpp"

#include <algorithm>
#include <utility>

#include "core/assumed_sensor.hpp"
#include "core/median.hpp"
#include "core/principal_axes.hpp"
#include "core/spread_sample.hpp"

namespace raywatch {

std::optional<ClusterPlane> ClusterPlane::fit(const ScanView& view, std::span<const std::uint32_t> members,
                                              const ScanView& asked) {
  constexpr std::size_t kMostMembers = 300;  // that are looked at
  constexpr std::size_t kLeastMembers = 20;  // fewer say too little about a plane
  constexpr double kLeastWidth_m = 0.1;
  if (members.size() < kLeastMembers) return std::nullopt;
  const Pose asked_from_view = asked.world_from_sensor.inverse() * view.world_from_sensor;
  ClusterPlane plane{.own_sensor_m = asked_from_view.position_m, .thickness_m = kEven_m + noise_of(view)};
  for (const std::uint32_t i : thinned(members, kMostMembers)) {
    plane.points_m.push_back(asked_from_view * view.points[i].cast<double>());
  }
  const PrincipalAxes<3> axes = principal_axes_of<3>(plane.points_m);
  const Eigen::Vector3d widths_m = axes.widths();
  if (std::sqrt(axes.variances[0]) > plane.thickness_m || widths_m[1] < kLeastWidth_m) return std::nullopt;
  plane.center_m = axes.mean;
  plane.normal = axes.directions.col(0);
  plane.radius_m = 0.5 * std::hypot(widths_m[1], widths_m[2]);
  return plane;
}

double ClusterPlane::facing(const Eigen::Vector3d& point_m, const Eigen::Vector3d& sensor_m) const {
  const Eigen::Vector3d ray_m = point_m - sensor_m;
  return std::abs(normal.dot(ray_m)) / std::max(ray_m.norm(), 1e-6);
}

double ClusterPlane::median_facing(const Eigen::Vector3d& sensor_m) const {
  std::vector<double> cosines;
  for (const Eigen::Vector3d& p : points_m) cosines.push_back(facing(p, sensor_m));
  return median(std::move(cosines));
}

}  // namespace raywatch
