#include "core/cluster_aspect.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "core/assumed_sensor.hpp"
#include "core/cluster_plane.hpp"
#include "core/doubts.hpp"
#include "core/principal_axes.hpp"
#include "core/returns_sample.hpp"

namespace raywatch {
namespace {

constexpr std::size_t kMostPoints = 500;  // that are looked at

using Points3d = std::vector<Eigen::Vector3d>;

/// Some of the returns of a scan in a box around the members of a cluster.
Points3d returns_beside(const ScanView& view, const Points3d& members_m) {
  constexpr double kBeside_m = 0.1;
  Eigen::AlignedBox3d box_m;
  for (const Eigen::Vector3d& p : members_m) box_m.extend(p);
  box_m.min().array() -= kBeside_m;
  box_m.max().array() += kBeside_m;
  return sample_of_returns_around(view.index.impl(), box_m.center(), 0.5 * box_m.diagonal().norm(), kMostPoints,
                                  [&](const Eigen::Vector3d& p) { return box_m.contains(p); });
}

/// Begins with the plane of the members of a cluster, and goes on with what lies on it beside them, if that is more.
PrincipalAxes<3> surface_of(PrincipalAxes<3> plane, std::size_t members, const Points3d& beside_m, double on_m) {
  constexpr int kRounds = 3;
  for (int round = 0; round < kRounds; ++round) {
    Points3d on;
    for (const Eigen::Vector3d& p : beside_m) {
      if (std::abs(plane.directions.col(0).dot(p - plane.mean)) < on_m) on.push_back(p);
    }
    if (on.size() < members) break;
    plane = principal_axes_of<3>(on);
  }
  return plane;
}

/// How far points reach along a direction.
double reach_along(const Points3d& points_m, const Eigen::Vector3d& direction) {
  double least_m = std::numeric_limits<double>::infinity(), greatest_m = -least_m;
  for (const Eigen::Vector3d& p : points_m) {
    least_m = std::min(least_m, direction.dot(p));
    greatest_m = std::max(greatest_m, direction.dot(p));
  }
  return greatest_m - least_m;
}

/// The width of the narrowest band across `ray` that is spread as widely as the points are.
double breadth_across(const Points3d& points_m, const Eigen::Vector3d& ray) {
  const Eigen::Vector3d u = ray.unitOrthogonal(), v = ray.cross(u);
  std::vector<Eigen::Vector2d> across_m;
  for (const Eigen::Vector3d& p : points_m) across_m.emplace_back(u.dot(p), v.dot(p));
  return principal_axes_of<2>(across_m).widths()[0];
}

constexpr double kTellsNothing = std::numeric_limits<double>::infinity();

/// The sides of cupboards and shelves, which are thinner than the noise, or than the shots are apart, when they are met
/// edge-on; and pieces of such a side, of which other points were not free: full of gaps, or without an edge.
double doubt_in_room(const ClusterAspect& aspect, const ClusterVotes& votes, const ClusterLook& look) {
  constexpr double kSlanted = 0.35, kOblique = 0.2, kMoreOblique = 0.1, kEdgeOn = 0.05;  // 20, 11.5, 6 and 3 degrees
  constexpr double kThin_m = 0.02, kThinBetweenShots = 0.4, kNarrowBetweenShots = 0.75;
  constexpr double kWithoutEdge = 0.95;
  if (!aspect.is_flat) return 0.0;
  const double thin_m = kThinBetweenShots * aspect.spacing_m;
  if (votes.rays_through == 0 && aspect.facing < kEdgeOn && aspect.foreshortened_m() < thin_m) return kTellsNothing;
  const bool has_gaps = look.extent && look.extent->has_gaps();
  const bool is_narrow = aspect.breadth_m < kNarrowBetweenShots * aspect.spacing_m;
  const bool is_without_edge = look.smoothness > kWithoutEdge;
  if (aspect.facing < kMoreOblique && (has_gaps || is_without_edge)) return kTellsNothing;
  if (aspect.facing < kSlanted && has_gaps && (is_narrow || is_without_edge)) return kTellsNothing;
  return aspect.facing < kOblique && aspect.foreshortened_m() < kThin_m ? kDoubtOfEdgeOn : 0.0;
}

/// Posts that stand between the shots of a far scan. Not what is only met edge-on, as the sides of cars; unless hardly
/// any point of it was penetrated.
double doubt_outdoors(const ClusterAspect& aspect, const ClusterVotes& votes) {
  constexpr double kFacing = 0.25, kBetweenShots = 0.5, kThinBetweenShots = 0.4, kFewPenetrated = 0.35;
  const bool is_upright = aspect.facing > kFacing && aspect.breadth_m < kBetweenShots * aspect.spacing_m;
  const bool is_thin =
      votes.share_penetrated() < kFewPenetrated && aspect.breadth_m < kThinBetweenShots * aspect.spacing_m;
  return is_upright || is_thin ? kDoubtOfBetweenShots : 0.0;
}

}  // namespace

ClusterAspect aspect_of(const ScanView& view, std::span<const std::uint32_t> members, const ScanView& asked) {
  constexpr double kOn = 2.0;  // what is farther off a surface by so many deviations lies beside it
  Points3d members_m;
  for (const std::uint32_t i : thinned(members, kMostPoints)) members_m.push_back(view.points[i].cast<double>());
  const double deviation_m = kEven_m + noise_of(view);
  const PrincipalAxes<3> own = principal_axes_of<3>(members_m);
  const PrincipalAxes<3> surface =
      surface_of(own, members_m.size(), returns_beside(view, members_m), kOn * deviation_m);
  const Eigen::Vector3d normal = surface.directions.col(0);

  const Pose view_from_asked = view.world_from_sensor.inverse() * asked.world_from_sensor;
  const Eigen::Vector3d to_cluster_m = own.mean - view_from_asked.position_m;
  const double distance_m = std::max(to_cluster_m.norm(), 1e-6);
  const Eigen::Vector3d ray = to_cluster_m / distance_m;
  const Eigen::Vector3d along = ray - ray.dot(normal) * normal;
  return {.is_flat = std::sqrt(surface.variances[0]) < deviation_m,
          .facing = std::min(1.0, std::abs(ray.dot(normal))),
          .depth_m = reach_along(members_m, along.normalized()),
          .breadth_m = breadth_across(members_m, ray),
          .spacing_m = spacing_of(asked).maxCoeff() * distance_m};
}

double doubt_of(const ClusterAspect& aspect, const ClusterVotes& votes, const ClusterLook& look,
                const CompareParameters& parameters) {
  return parameters.foliage_distance_m == 0.0 ? doubt_in_room(aspect, votes, look) : doubt_outdoors(aspect, votes);
}

}  // namespace raywatch
