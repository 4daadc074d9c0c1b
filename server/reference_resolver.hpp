#pragma once

#include <Eigen/Geometry>
#include <set>
#include <vector>

#include "core/time.hpp"
#include "storage/comparisons.hpp"
#include "storage/scans.hpp"
#include "storage/sites.hpp"

namespace raywatch {

/// Bounds of the search for priors.
struct ReferenceLimits {
  double radius_m = 0.0;              ///< vantages farther from the scan are not asked
  Duration contemporary_tolerance{};  ///< `previous` is older than this
  Duration previous_limit{};          ///< `previous` is not older than this
};

/// At most so many vantages, the nearest, are asked for a scan.
inline constexpr std::size_t kMaxVantages = 64;

/// The scans that a reference offers to be compared with `scan`, by the time policy of the reference: for `previous`
/// and `window` the latest of each near vantage, for `baseline` what is accepted everywhere from each near vantage, for
/// `explicit` those named. Nearest vantage first. Never `scan` itself.
/// @throws InvalidInput when an explicit one is of another site or `scan` itself; NotFound when it is not there.
std::vector<ScanRecord> resolve_reference(const Snapshot& snapshot, const ScanRecord& scan, const Site& site,
                                          const Reference& reference, const ReferenceLimits& limits);

/// Scans that speak together about a region of the baseline.
struct BaselinePatch {
  Eigen::AlignedBox3d region_m;  ///< local
  std::vector<ScanRecord> scans;
};
/// The patches of a baseline whose region lies within a distance of a scan, in the order in which they came.
std::vector<BaselinePatch> resolve_patches(const Snapshot& snapshot, const ScanRecord& scan, const Site& site,
                                           double radius_m);

/// Those of `scans` that are in the baseline because they were among the first of their vantage.
std::set<ScanId> learned_among(const Snapshot& snapshot, SiteId site, const std::vector<ScanRecord>& scans);

/// True when the reference names its scans, so that all of them are wanted.
bool is_explicit(const Reference& reference);

}  // namespace raywatch
