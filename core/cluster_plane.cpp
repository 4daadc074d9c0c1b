#include "core/cluster_plane.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <utility>

#include "core/assumed_sensor.hpp"
#include "core/median.hpp"
#include "core/spread_sample.hpp"

namespace raywatch {

std::optional<ClusterPlane> ClusterPlane::fit(const ScanView& view, std::span<const std::uint32_t> members,
                                              const ScanView& asked) {
  constexpr std::size_t kMostMembers = 300;  // that are looked at
  constexpr std::size_t kLeastMembers = 20;  // fewer say too little about a plane
  constexpr double kLeastWidth_m = 0.1;
  constexpr double kEven_m = 0.015;  // how even a plane is (standard deviation) beside the noise
  if (members.size() < kLeastMembers) return std::nullopt;
  const Pose asked_from_view = asked.world_from_sensor.inverse() * view.world_from_sensor;
  ClusterPlane plane{.own_sensor_m = asked_from_view.position_m, .thickness_m = kEven_m + noise_of(view)};
  for (const std::uint32_t i : thinned(members, kMostMembers)) {
    plane.points_m.push_back(asked_from_view * view.points[i].cast<double>());
  }
  const auto count = static_cast<double>(plane.points_m.size());
  plane.center_m.setZero();
  for (const Eigen::Vector3d& p : plane.points_m) plane.center_m += p / count;
  Eigen::Matrix3d covariance_m2 = Eigen::Matrix3d::Zero();
  for (const Eigen::Vector3d& p : plane.points_m) {
    covariance_m2 += (p - plane.center_m) * (p - plane.center_m).transpose() / count;
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(covariance_m2);
  const Eigen::Vector3d variance_m2 = solver.eigenvalues().cwiseMax(0.0);
  const double width_m = std::sqrt(12.0 * variance_m2[1]), length_m = std::sqrt(12.0 * variance_m2[2]);
  if (variance_m2[0] > plane.thickness_m * plane.thickness_m || width_m < kLeastWidth_m) return std::nullopt;
  plane.normal = solver.eigenvectors().col(0);
  plane.radius_m = 0.5 * std::hypot(width_m, length_m);
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

bool ClusterPlane::is_met_edge_on() const {
  constexpr double kEdgeOn = 0.07, kLeastBreadth_m = 0.05;
  const double cosine = median_facing(Eigen::Vector3d::Zero());
  return cosine < kEdgeOn && 2.0 * radius_m * cosine < kLeastBreadth_m;
}

}  // namespace raywatch
