#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>

#include "core/compare.hpp"
#include "core/shot_extent.hpp"
#include "core/smoothness.hpp"

namespace raywatch {

/// What the points of a cluster, taken together, tell about whether `asked` saw their place free. Counts are of points
/// that are looked at: of large clusters only a part.
struct ClusterVotes {
  /// Rays of `asked` that went through the cluster, and crossed its surface: returns well behind it in directions that
  /// its points surround. What is thinner than the spacing of the rays can hide between them: then there are none.
  std::size_t rays_through = 0;
  /// Points with rays of `asked` no farther aside than half the spacing of the scan's own shots, all of which went well
  /// behind the point, or some of which did not. A surface that fills the space between the points stops such rays.
  std::size_t penetrated = 0, blocked = 0;
  std::size_t looked_at = 0;  ///< points, of which some have no such rays
  /// The median distance of the points from the nearest return of `asked`; at most 1 m. Low where an edge was measured
  /// a second time, a little beside; and of leaves that swayed.
  double clearance_m = 0.0;
  /// What `asked` shows within `foliage_distance_m` of the cluster.
  Surroundings surroundings;
  /// The mean of how rough what `asked` shows near the points is; see core/smoothness.hpp.
  double roughness_m = 0.0;

  /// 0..1
  double share_penetrated() const {
    return static_cast<double>(penetrated) / static_cast<double>(std::max<std::size_t>(looked_at, 1));
  }
};

/// @param members points of `view`, at least one.
/// @param least_log_odds what is of interest: nothing is returned when the log-odds of a change are surely below it,
///   which is often clear before the rays are counted, the costliest step.
std::optional<ClusterVotes> votes_of(const ScanView& view, std::span<const std::uint32_t> members,
                                     const ScanView& asked, const CompareParameters& parameters, double least_log_odds);

/// Whether `asked` shows a cluster just where it is: most of its rays there end at the cluster's points or beside them.
bool shows(const ScanView& asked, const ScanView& view, std::span<const std::uint32_t> members,
           const CompareParameters& parameters);

/// The share of the scan's own rays into a cluster that went through it, 0..1: high for fences, foliage and scattered
/// returns, through which the rays of other scans can pass, too.
double porosity_of(const ScanView& view, std::span<const std::uint32_t> members, const CompareParameters& parameters);

/// What a cluster looks like in its own scan.
struct ClusterLook {
  double porosity = 0.0;             ///< see `porosity_of`
  double smoothness = 1.0;           ///< see core/smoothness.hpp; low where returns mix at a silhouette
  std::optional<ShotExtent> extent;  ///< empty: nothing speaks against it
};
ClusterLook look_of(const ScanView& view, std::span<const std::uint32_t> members, const CompareParameters& parameters);

/// Whether a small cluster is no surface: most of the scan's shots beside its points return from elsewhere. So look
/// mixed returns at a silhouette, a silhouette that is one shot wide, and single returns of a fence or of grass that
/// happen to lie together.
bool is_scattered(std::size_t size, double smoothness);

/// The logarithm of the odds that a cluster truly changed, which the votes of one scan and its look tell: a logistic
/// regression over the clusters of simulated places, one of those where leaves and grass are to be reckoned with and
/// another of those without. Grows with the rays, the penetrated points, the clearance and both kinds of smoothness,
/// and falls with the others.
double log_odds_of_change(const ClusterVotes& votes, const ClusterLook& look, const CompareParameters& parameters);

}  // namespace raywatch
