#include "core/cluster_votes.hpp"

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

#include "core/assumed_sensor.hpp"
#include "core/cluster_rays.hpp"
#include "core/doubts.hpp"
#include "core/median.hpp"
#include "core/nearest_return.hpp"
#include "core/returns_near.hpp"
#include "core/smoothness.hpp"
#include "core/spread_sample.hpp"

namespace raywatch {
namespace {

/// Points of a cluster that are looked at for means and medians.
constexpr std::size_t kMostLookedAt = 100;
/// Rays through a cluster that are counted: more tell no more.
constexpr std::size_t kEnoughRays = 60;

/// Some points of a cluster, evenly spread over it, in its own frame and that of the scan that is asked.
struct Sample {
  std::vector<Eigen::Vector3d> own_m, asked_m;
};

Sample sample_of(const ScanView& view, std::span<const std::uint32_t> members, const ScanView& asked) {
  const Pose asked_from_view = asked.world_from_sensor.inverse() * view.world_from_sensor;
  Sample sample;
  for (const std::uint32_t i : thinned(members, kMostLookedAt)) {
    sample.own_m.emplace_back(view.points[i].cast<double>());
    sample.asked_m.push_back(asked_from_view * sample.own_m.back());
  }
  return sample;
}

/// A point's spacing of shots where `asked` sees it, as an angle there.
double seen_spacing_rad(const ScanView& view, const Eigen::Vector3d& own_m, const Eigen::Vector3d& asked_m) {
  return spacing_of(view).maxCoeff() * own_m.norm() / std::max(asked_m.norm(), 0.1);
}

std::size_t rays_through(const ScanView& view, std::span<const std::uint32_t> members, const ScanView& asked,
                         const Sample& sample, double margin_m, const Crossing& crossing) {
  constexpr double kReach = 1.5, kGreatest_rad = 0.3;  // the cost grows with the square of the angle
  double spacing_rad = 0.0;
  for (std::size_t k = 0; k < sample.own_m.size(); ++k) {
    spacing_rad += seen_spacing_rad(view, sample.own_m[k], sample.asked_m[k]);
  }
  spacing_rad /= static_cast<double>(sample.own_m.size());
  const double angle_rad = std::min(kGreatest_rad, kReach * std::max(spacing_of(asked).maxCoeff(), spacing_rad));
  const PriorIndex cluster = index_of(view, members, asked);
  return count_rays(cluster.impl(), asked.index.impl(), {angle_rad, margin_m, kEnoughRays}, &crossing);
}

/// Of the points of a sample: around how many all near rays of `asked` crossed the surface, and around how many not all
/// of them went well behind the point.
struct Penetration {
  std::size_t penetrated = 0, blocked = 0;
};

Penetration penetration_of(const ScanView& view, const ScanView& asked, const Sample& sample, double margin_m,
                           const Crossing& crossing) {
  constexpr double kHalf = 0.5, kGreatest_rad = 0.3;
  const PriorIndex::Impl& index = asked.index.impl();
  Penetration count;
  for (std::size_t k = 0; k < sample.own_m.size(); ++k) {
    const Eigen::Vector3d& point_m = sample.asked_m[k];
    const double range_m = point_m.norm();
    const double angle_rad = std::min(kGreatest_rad, kHalf * seen_spacing_rad(view, sample.own_m[k], point_m));
    const double cosine_m = std::cos(angle_rad) * range_m;
    std::vector<Eigen::Vector3d> ends_m;
    bool behind = true;
    for_each_return_near(index, point_m, angle_rad, [&](std::uint32_t i) {
      const Eigen::Vector3d end_m = point_of(index.returns[i]);
      const double end_range_m = end_m.norm();
      if (end_m.dot(point_m) < cosine_m * end_range_m) return;
      behind &= end_range_m >= range_m + margin_m;
      ends_m.push_back(end_m);
    });
    if (!behind) {
      ++count.blocked;
    } else if (!ends_m.empty() && crossing.any_of(point_m, ends_m)) {
      ++count.penetrated;
    }
  }
  return count;
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
  return median(std::move(distances_m));
}

/// Whether rays may have passed a strip at most three shots wide although nothing changed: through its gaps, as between
/// the wires of a fence; or beside it, as past a post that stands between two columns of the shots of `asked`, when few
/// of its points were penetrated.
bool may_have_been_passed(const ShotExtent& extent, const ClusterVotes& votes) {
  constexpr double kStrip = 3.0, kFew = 0.3;
  if (extent.width >= kStrip) return false;
  return extent.has_gaps() || votes.share_penetrated() < kFew;
}

/// Whether a cluster is a piece of a fence: its own scan sees through it, and the shots beside most of its points
/// return from elsewhere.
bool is_sieve(const ClusterLook& look) {
  constexpr double kPorous = 0.25, kSmooth = 0.6;
  return look.porosity > kPorous && look.smoothness < kSmooth;
}

/// Whether a cluster lies close among things that `asked` shows densely, and as rough: leaves near a sensor, each of
/// which is a surface of many shots that the wind has moved.
bool is_among_leaves(const ClusterVotes& votes) {
  constexpr double kRough = 0.95, kClose_m = 0.5;
  constexpr std::size_t kDense = 80;  // returns
  return votes.surroundings.smoothness < kRough && votes.surroundings.returns > kDense && votes.clearance_m < kClose_m;
}

}  // namespace

std::optional<ClusterVotes> votes_of(const ScanView& view, std::span<const std::uint32_t> members,
                                     const ScanView& asked, const CompareParameters& parameters,
                                     double least_log_odds) {
  const Sample sample = sample_of(view, members, asked);
  const auto count = static_cast<double>(sample.asked_m.size());
  // What is not known yet is as good as it can be.
  ClusterVotes votes{
      .rays_through = kEnoughRays, .penetrated = sample.asked_m.size(), .looked_at = sample.asked_m.size()};
  const auto is_hopeless = [&] { return log_odds_of_change(votes, {}, parameters) < least_log_odds; };

  votes.clearance_m = median_clearance_m(asked, sample);
  if (is_hopeless()) return std::nullopt;

  Eigen::Vector3d center_m = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& point_m : sample.asked_m) center_m += point_m / count;
  votes.surroundings = surroundings_of(asked, center_m, parameters.foliage_distance_m);
  if (is_hopeless()) return std::nullopt;

  const Crossing crossing(view, asked, parameters.support_distance_m);
  const Penetration penetration = penetration_of(view, asked, sample, parameters.range_m, crossing);
  votes.penetrated = penetration.penetrated;
  votes.blocked = penetration.blocked;
  if (is_hopeless()) return std::nullopt;

  for (const Eigen::Vector3d& point_m : sample.asked_m) {
    votes.roughness_m += roughness_around_m(asked, point_m, parameters.growth_distance_m) / count;
  }
  if (is_hopeless()) return std::nullopt;

  votes.rays_through = rays_through(view, members, asked, sample, parameters.range_m, crossing);
  if (is_hopeless()) return std::nullopt;
  return votes;
}

bool shows(const ScanView& asked, const ScanView& view, std::span<const std::uint32_t> members,
           const CompareParameters& parameters) {
  constexpr double kBeside = 0.5;  // of the distance that belongs to one thing
  constexpr double kMostly = 0.45;
  constexpr std::size_t kLeastBlocked = 4;
  const Sample sample = sample_of(view, members, asked);
  if (median_clearance_m(asked, sample) > kBeside * parameters.growth_distance_m) return false;
  const Crossing crossing(view, asked, parameters.support_distance_m);
  const Penetration rays = penetration_of(view, asked, sample, parameters.range_m, crossing);
  return rays.blocked >= kLeastBlocked &&
         static_cast<double>(rays.blocked) > kMostly * static_cast<double>(rays.blocked + rays.penetrated);
}

double porosity_of(const ScanView& view, std::span<const std::uint32_t> members, const CompareParameters& parameters) {
  constexpr double kReach = 2.4;  // in spacings: bridges a lost return
  const PriorIndex cluster = index_of(view, members, view);
  const RaySearch search{kReach * spacing_of(view).maxCoeff(), parameters.range_m};
  const auto through = static_cast<double>(count_rays(cluster.impl(), view.index.impl(), search, nullptr));
  const auto members_looked_at = static_cast<double>(std::min(kMostClusterMembers, members.size()));
  return through / std::max(1.0, through + members_looked_at);
}

ClusterLook look_of(const ScanView& view, std::span<const std::uint32_t> members, const CompareParameters& parameters) {
  return {.porosity = porosity_of(view, members, parameters),
          .smoothness = smoothness_of(view, thinned(members, kMostLookedAt)),
          .extent = extent_in_shots(view, members)};
}

bool is_scattered(std::size_t size, double smoothness) {
  constexpr std::size_t kFew = 12, kNotMany = 40;
  // What stands alone has 0.46 at two by three shots; a line of shots, such as a silhouette, has less than 0.25.
  constexpr double kSurface = 0.4, kLine = 0.3;
  return size < kNotMany && smoothness < (size < kFew ? kSurface : kLine);
}

double log_odds_of_change(const ClusterVotes& votes, const ClusterLook& look, const CompareParameters& parameters) {
  // Beyond these, more tells no more: ground may well be rough for other reasons than leaves.
  constexpr double kMostRays = 60.0, kMostRoughness_m = 0.01;
  constexpr double kLeastClearance_m = 0.02;
  const auto count = [](std::size_t value) { return static_cast<double>(value); };
  const double rays = std::log1p(std::min(kMostRays, count(votes.rays_through)));
  const double penetrated = std::log1p(std::min(kMostRays, count(votes.penetrated)));
  const double blocked = count(votes.blocked) / count(votes.penetrated + votes.blocked + 1);
  const double clearance = std::log(votes.clearance_m + kLeastClearance_m);
  const double roughness_m = std::min(kMostRoughness_m, votes.roughness_m);
  if (parameters.foliage_distance_m == 0.0) {
    constexpr std::size_t kFewestRays = 2, kShortLine = 7;
    constexpr double kFewPenetrated = 0.1;
    constexpr double kNever = -std::numeric_limits<double>::infinity();
    if (votes.rays_through + votes.penetrated < kFewestRays) return kNever;
    const bool line = look.extent && look.extent->is_line();
    if (line && votes.rays_through == 0 && votes.looked_at < kShortLine) return kNever;  // a far edge
    if (votes.rays_through == 0 && votes.share_penetrated() < kFewPenetrated) return kNever;
    const double looked_at = count(std::max<std::size_t>(votes.looked_at, 1));
    const bool in_doubt = line || (look.extent && look.extent->has_gaps());
    return -4.58 - (in_doubt ? kDoubtOfRemnant : 0.0) + 2.13 * rays + 0.44 * penetrated +
           5.17 * votes.share_penetrated() - 7.12 * blocked - 30.0 * look.porosity + 6.8 * clearance -
           0.20 * std::log(looked_at) + 9.2 * look.smoothness;
  }
  const double no_ray = votes.rays_through == 0 ? kDoubtOfNoRay : 0.0;
  const bool in_doubt = look.extent && may_have_been_passed(*look.extent, votes);
  const double sieve = is_sieve(look) ? kDoubtOfFence : 0.0;
  const double leaves = is_among_leaves(votes) ? kDoubtOfLeaves : 0.0;
  return -12.32 - no_ray - sieve - leaves - (in_doubt ? kDoubtOfStrip : 0.0) + 1.51 * rays + 2.29 * penetrated -
         1.73 * blocked - 17.75 * look.porosity + 5.67 * clearance + 9.74 * votes.surroundings.smoothness -
         569.0 * roughness_m;
}

}  // namespace raywatch
