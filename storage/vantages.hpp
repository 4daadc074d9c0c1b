#pragma once

#include "storage/scans.hpp"

namespace raywatch {

// The part of `scans.hpp` about vantages that only the store itself uses.

/// The ids of a site's vantages whose position is nearer than `radius_m` to a place, in no order.
struct VantageDistance {
  VantageId id;
  double distance_m = 0.0;
};
std::vector<VantageDistance> vantages_within(const Snapshot& snapshot, SiteId site, const Eigen::Vector3d& position_m,
                                             double radius_m);

/// The vantage of a new scan at a place: the nearest within `kVantageRadius_m`, or a new one.
VantageId vantage_for_scan(Transaction& transaction, SiteId site, const Eigen::Vector3d& position_m);

/// Counts a scan in. / Counts it out after its record was deleted; a vantage without scans is deleted.
void add_scan_to_vantage(Transaction& transaction, VantageId vantage, Time captured_at);
void drop_scan_from_vantage(Transaction& transaction, VantageId vantage);

}  // namespace raywatch
