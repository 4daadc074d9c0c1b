#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "core/compare.hpp"

namespace raywatch {

/// A point that one scan saw free.
struct Candidate {
  std::uint32_t index;
  PointClass point_class;
  bool contradicted = false;  ///< another scan, which decides, did not
};

/// A cluster of candidates of one scan, and what the asked scans say of it, each by itself: the log-odds that it truly
/// changed (core/cluster_votes.hpp). Minus infinity where the answer is a clear no, or too low to make a difference.
struct JudgedCluster {
  PointClass point_class;
  std::vector<std::uint32_t> members;
  Eigen::AlignedBox3d box_m;                                        ///< around the members, in the frame of the poses
  double log_odds = -std::numeric_limits<double>::infinity();       ///< of the scan that is surest
  double next_log_odds = -std::numeric_limits<double>::infinity();  ///< of the next; not known where the first suffices
  std::size_t rays_through = 0;                                     ///< the most that one of these scans counted
};

/// Fewer rays may have passed through gaps of a cluster, or along a thin surface that they met edge-on.
inline constexpr std::size_t kEnoughRaysThrough = 6;

/// The log-odds at which a cluster of so many points counts as changed.
double sure_log_odds(std::size_t points, const CompareParameters& parameters);

/// Clusters whose log-odds are lower do not even count as a second opinion.
double least_log_odds_of_second_opinion(const CompareParameters& parameters);

/// The clusters of candidates that may have changed, by kind and first candidate, without those that are mostly
/// contradicted.
/// @param asked scans that may have seen the clusters' place free.
/// @param is_one_of_several whether the clusters of other scans are looked at beside these: then also what is less sure
///   is of interest.
std::vector<JudgedCluster> judge_clusters(const ScanView& view, std::span<const Candidate> candidates,
                                          std::span<const ScanView> asked, bool is_one_of_several,
                                          const CompareParameters& parameters);

}  // namespace raywatch
