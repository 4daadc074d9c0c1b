#include "core/glass.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "core/assumed_sensor.hpp"
#include "core/median.hpp"
#include "core/plane_patch.hpp"
#include "core/returns_near.hpp"
#include "core/spread_sample.hpp"

namespace raywatch {
namespace {

/// Members that are looked at, evenly spread over the cluster.
constexpr std::size_t kMostMembers = 300;
/// Smaller clusters say too little about a plane.
constexpr std::size_t kLeastMembers = 20;
constexpr double kLeastWidth_m = 0.1;
/// How even a pane is (standard deviation) beside the noise, and within how many times that others are in line with it.
constexpr double kEven_m = 0.015;
constexpr double kInLine = 2.5;

/// Some members of a cluster in the frame of the scan that is asked.
std::vector<Eigen::Vector3d> some_of(const ScanView& view, std::span<const std::uint32_t> members,
                                     const Pose& asked_from_view) {
  std::vector<Eigen::Vector3d> points_m;
  for (const std::uint32_t i : thinned(members, kMostMembers)) {
    points_m.push_back(asked_from_view * view.points[i].cast<double>());
  }
  return points_m;
}

struct Plane {
  Eigen::Vector3d center_m, normal;
  double radius_m;  ///< of a ball around the centre that holds nearly all members

  double off_m(const Eigen::Vector3d& point_m) const { return std::abs(normal.dot(point_m - center_m)); }
};

/// The plane of points that are as flat as `thickness_m` (standard deviation) allows and as wide as a pane.
std::optional<Plane> plane_of(std::span<const Eigen::Vector3d> points_m, double thickness_m) {
  const auto count = static_cast<double>(points_m.size());
  Eigen::Vector3d center_m = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& p : points_m) center_m += p / count;
  Eigen::Matrix3d covariance_m2 = Eigen::Matrix3d::Zero();
  for (const Eigen::Vector3d& p : points_m) covariance_m2 += (p - center_m) * (p - center_m).transpose() / count;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(covariance_m2);
  const Eigen::Vector3d variance_m2 = solver.eigenvalues().cwiseMax(0.0);
  const double width_m = std::sqrt(12.0 * variance_m2[1]), length_m = std::sqrt(12.0 * variance_m2[2]);
  if (variance_m2[0] > thickness_m * thickness_m || width_m < kLeastWidth_m) return std::nullopt;
  return Plane{center_m, solver.eigenvectors().col(0), 0.5 * std::hypot(width_m, length_m)};
}

/// The cosine of the incidence at which a sensor meets a place of the plane.
double facing(const Plane& plane, const Eigen::Vector3d& point_m, const Eigen::Vector3d& sensor_m) {
  const Eigen::Vector3d ray_m = point_m - sensor_m;
  return std::abs(plane.normal.dot(ray_m)) / std::max(ray_m.norm(), 1e-6);
}

double median_facing(const Plane& plane, std::span<const Eigen::Vector3d> points_m, const Eigen::Vector3d& sensor_m) {
  std::vector<double> cosines;
  for (const Eigen::Vector3d& p : points_m) cosines.push_back(facing(plane, p, sensor_m));
  return median(std::move(cosines));
}

/// Some of the returns within reach of a cluster that lie on its plane, in an order that does not depend on the scan's.
std::vector<Eigen::Vector3d> returns_on(const Plane& plane, const ScanView& asked, double off_m) {
  constexpr double kBeside_m = 2.0;
  constexpr std::size_t kMost = 100;
  std::vector<Eigen::Vector3d> on;
  for_each_return_around(asked.index.impl(), plane.center_m, plane.radius_m + kBeside_m, [&](std::uint32_t i) {
    const Eigen::Vector3d p = point_of(asked.index.impl().returns[i]);
    if (plane.off_m(p) <= off_m) on.push_back(p);
  });
  std::sort(on.begin(), on.end(), [](const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
    return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end());
  });
  return thinned(std::span<const Eigen::Vector3d>(on), kMost);
}

}  // namespace

bool may_be_glass(const ScanView& view, std::span<const std::uint32_t> members, const ScanView& asked) {
  constexpr double kOblique = 0.9;      // nearly upright rays no glass lets through without any return
  constexpr double kParallel = 0.9;     // of the normals of a surface and the cluster's plane
  constexpr std::size_t kLeastOn = 10;  // returns that make a surface
  constexpr double kMostAsOblique = 0.1;
  if (members.size() < kLeastMembers) return false;
  const Pose asked_from_view = asked.world_from_sensor.inverse() * view.world_from_sensor;
  const std::vector<Eigen::Vector3d> points_m = some_of(view, members, asked_from_view);
  const double thickness_m = kEven_m + noise_of(view);
  const std::optional<Plane> plane = plane_of(points_m, thickness_m);
  if (!plane) return false;
  const double asked_facing = median_facing(*plane, points_m, Eigen::Vector3d::Zero());
  const double own_facing = median_facing(*plane, points_m, asked_from_view.position_m);
  if (asked_facing > kOblique || own_facing <= asked_facing) return false;
  const PatchFitter surface_at(asked);
  std::size_t on = 0, as_oblique = 0;
  for (const Eigen::Vector3d& p : returns_on(*plane, asked, kInLine * thickness_m)) {
    const std::optional<PlanePatch> surface = surface_at(p);
    if (!surface || std::abs(surface->normal().dot(plane->normal)) < kParallel) continue;
    ++on;
    as_oblique += facing(*plane, p, Eigen::Vector3d::Zero()) <= asked_facing;
  }
  return on >= kLeastOn && static_cast<double>(as_oblique) <= kMostAsOblique * static_cast<double>(on);
}

}  // namespace raywatch
