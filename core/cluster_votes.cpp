#include "core/cluster_votes.hpp"

#include <vector>

#include "core/assumed_sensor.hpp"
#include "core/nearest_return.hpp"
#include "core/returns_near.hpp"
#include "core/smoothness.hpp"

namespace raywatch {
namespace {

/// Points of a cluster that are looked at for means and medians.
constexpr std::size_t kMostLookedAt = 100;

/// Some points of a cluster, evenly spread over it, in its own frame and that of the scan that is asked.
struct Sample {
  std::vector<Eigen::Vector3d> own_m, asked_m;
};

Sample sample_of(const ScanView& view, std::span<const std::uint32_t> members, const ScanView& asked) {
  const Pose asked_from_view = asked.world_from_sensor.inverse() * view.world_from_sensor;
  const std::size_t step = (members.size() - 1) / kMostLookedAt + 1;
  Sample sample;
  for (std::size_t k = 0; k < members.size(); k += step) {
    sample.own_m.emplace_back(view.points[members[k]].cast<double>());
    sample.asked_m.push_back(asked_from_view * sample.own_m.back());
  }
  return sample;
}

/// An index of the members of a cluster alone, in the frame of `asked`.
PriorIndex index_of(const ScanView& view, std::span<const std::uint32_t> members, const ScanView& asked) {
  const Pose asked_from_view = asked.world_from_sensor.inverse() * view.world_from_sensor;
  PointCloud cluster;
  cluster.reserve(members.size());
  for (const std::uint32_t i : members) {
    const Eigen::Vector3f p = (asked_from_view * view.points[i].cast<double>()).cast<float>();
    cluster.push_back(p.x(), p.y(), p.z());
  }
  return PriorIndex::build(cluster, {});
}

/// Whether a ray that ended at `end_m` went through a cluster: its members within the angle surround the ray, and end
/// at least `margin_m` before it does.
bool goes_through(const PriorIndex::Impl& cluster, const Eigen::Vector3d& end_m, double angle_rad, double margin_m) {
  const double range_m = end_m.norm(), cosine_m = std::cos(angle_rad) * range_m;
  const Eigen::Vector3d east = end_m.cross(Eigen::Vector3d::UnitZ()), north = east.cross(end_m);
  bool on_west = false, on_east = false, on_south = false, on_north = false, behind = true;
  for_each_return_near(cluster, end_m, angle_rad, [&](std::uint32_t i) {
    const Eigen::Vector3d member_m = point_of(cluster.returns[i]);
    const double member_range_m = member_m.norm();
    if (end_m.dot(member_m) < cosine_m * member_range_m) return;
    behind &= range_m >= member_range_m + margin_m;
    const double a = east.dot(member_m), e = north.dot(member_m);
    on_west |= a <= 0.0;
    on_east |= a >= 0.0;
    on_south |= e <= 0.0;
    on_north |= e >= 0.0;
  });
  return behind && on_west && on_east && on_south && on_north;
}

struct RayCount {
  std::size_t through = 0;
  std::size_t members = 0;  ///< around which rays were looked for
};

/// Counts the rays through a cluster. Its members are sorted by direction, so that the part of a large cluster that is
/// looked at is a band of it, without holes.
RayCount count_rays(const PriorIndex::Impl& cluster, const PriorIndex::Impl& rays, double angle_rad, double margin_m) {
  constexpr std::size_t kMostMembers = 500;
  const double cosine = std::cos(angle_rad);
  RayCount count{.members = std::min(kMostMembers, cluster.returns.size())};
  std::vector<std::uint32_t> near;
  for (std::size_t k = 0; k < count.members; ++k) {
    const Eigen::Vector3d member_m = point_of(cluster.returns[k]);
    for_each_return_near(rays, member_m, angle_rad, [&](std::uint32_t i) {
      const Eigen::Vector3d end_m = point_of(rays.returns[i]);
      if (end_m.dot(member_m) >= cosine * end_m.norm() * member_m.norm()) near.push_back(i);
    });
  }
  std::sort(near.begin(), near.end());
  near.erase(std::unique(near.begin(), near.end()), near.end());
  count.through = static_cast<std::size_t>(std::count_if(near.begin(), near.end(), [&](std::uint32_t i) {
    return goes_through(cluster, point_of(rays.returns[i]), angle_rad, margin_m);
  }));
  return count;
}

/// A point's spacing of shots where `asked` sees it, as an angle there.
double seen_spacing_rad(const ScanView& view, const Eigen::Vector3d& own_m, const Eigen::Vector3d& asked_m) {
  return spacing_of(view).maxCoeff() * own_m.norm() / std::max(asked_m.norm(), 0.1);
}

std::size_t rays_through(const ScanView& view, std::span<const std::uint32_t> members, const ScanView& asked,
                         const Sample& sample, double margin_m) {
  constexpr double kReach = 1.5, kGreatest_rad = 0.3;  // the cost grows with the square of the angle
  double spacing_rad = 0.0;
  for (std::size_t k = 0; k < sample.own_m.size(); ++k) {
    spacing_rad += seen_spacing_rad(view, sample.own_m[k], sample.asked_m[k]);
  }
  spacing_rad /= static_cast<double>(sample.own_m.size());
  const double angle_rad = std::min(kGreatest_rad, kReach * std::max(spacing_of(asked).maxCoeff(), spacing_rad));
  const PriorIndex cluster = index_of(view, members, asked);
  return count_rays(cluster.impl(), asked.index.impl(), angle_rad, margin_m).through;
}

void count_penetrated(const ScanView& view, const ScanView& asked, const Sample& sample, double margin_m,
                      ClusterVotes& votes) {
  constexpr double kHalf = 0.5, kGreatest_rad = 0.3;
  const PriorIndex::Impl& index = asked.index.impl();
  for (std::size_t k = 0; k < sample.own_m.size(); ++k) {
    const Eigen::Vector3d& point_m = sample.asked_m[k];
    const double range_m = point_m.norm();
    const double angle_rad = std::min(kGreatest_rad, kHalf * seen_spacing_rad(view, sample.own_m[k], point_m));
    const double cosine_m = std::cos(angle_rad) * range_m;
    bool asked_any = false, behind = true;
    for_each_return_near(index, point_m, angle_rad, [&](std::uint32_t i) {
      const Eigen::Vector3d end_m = point_of(index.returns[i]);
      const double end_range_m = end_m.norm();
      if (end_m.dot(point_m) < cosine_m * end_range_m) return;
      asked_any = true;
      behind &= end_range_m >= range_m + margin_m;
    });
    if (asked_any) ++(behind ? votes.penetrated : votes.blocked);
  }
}

/// The distance from a point to the nearest return of `asked`, at most 1 m; in growing balls, as most are near.
double clearance_m(const ScanView& asked, const Eigen::Vector3d& point_m) {
  constexpr double kLeast_m = 0.125, kGreatest_m = 1.0;
  for (double farthest_m = kLeast_m; farthest_m <= kGreatest_m && farthest_m < point_m.norm(); farthest_m *= 2.0) {
    const double nearest_m = nearest_return_m(asked.index.impl(), point_m, 0.0, farthest_m);
    if (nearest_m < farthest_m) return nearest_m;
  }
  return kGreatest_m;
}

double median_clearance_m(const ScanView& asked, const Sample& sample) {
  std::vector<double> distances_m;
  for (const Eigen::Vector3d& point_m : sample.asked_m) distances_m.push_back(clearance_m(asked, point_m));
  const auto median = distances_m.begin() + static_cast<std::ptrdiff_t>(distances_m.size() / 2);
  std::nth_element(distances_m.begin(), median, distances_m.end());
  return *median;
}

}  // namespace

ClusterVotes votes_of(const ScanView& view, std::span<const std::uint32_t> members, const ScanView& asked,
                      const CompareParameters& parameters) {
  const Sample sample = sample_of(view, members, asked);
  ClusterVotes votes{.rays_through = rays_through(view, members, asked, sample, parameters.range_m),
                     .clearance_m = median_clearance_m(asked, sample)};
  count_penetrated(view, asked, sample, parameters.range_m, votes);
  const auto count = static_cast<double>(sample.asked_m.size());
  Eigen::Vector3d center_m = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& point_m : sample.asked_m) {
    center_m += point_m / count;
    votes.roughness_m += roughness_around_m(asked, point_m, parameters.growth_distance_m) / count;
  }
  votes.surroundings = smoothness_around(asked, center_m, parameters.foliage_distance_m);
  return votes;
}

double porosity_of(const ScanView& view, std::span<const std::uint32_t> members, const CompareParameters& parameters) {
  constexpr double kReach = 2.4;  // in spacings: bridges a lost return
  const PriorIndex cluster = index_of(view, members, view);
  const RayCount own =
      count_rays(cluster.impl(), view.index.impl(), kReach * spacing_of(view).maxCoeff(), parameters.range_m);
  return static_cast<double>(own.through) / static_cast<double>(std::max<std::size_t>(1, own.through + own.members));
}

double log_odds_of_change(const ClusterVotes& votes, double porosity) {
  // Beyond these, more tells no more: ground may well be rough for other reasons than leaves.
  constexpr double kMostRays = 60.0, kMostRoughness_m = 0.01;
  constexpr double kLeastClearance_m = 0.02;
  const auto rays = std::min(kMostRays, static_cast<double>(votes.rays_through));
  const auto penetrated = static_cast<double>(votes.penetrated), blocked = static_cast<double>(votes.blocked);
  return -12.32 + 1.51 * std::log1p(rays) + 2.29 * std::log1p(std::min(kMostRays, penetrated)) -
         1.73 * blocked / (penetrated + blocked + 1.0) - 17.75 * porosity +
         5.67 * std::log(votes.clearance_m + kLeastClearance_m) + 9.74 * votes.surroundings -
         569.0 * std::min(kMostRoughness_m, votes.roughness_m);
}

}  // namespace raywatch
