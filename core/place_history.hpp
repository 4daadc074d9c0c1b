#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "core/ids.hpp"
#include "core/point_cloud.hpp"
#include "core/prior_index.hpp"
#include "core/time.hpp"

namespace raywatch {

/// What was at a place at some time, as far as the rays tell.
enum class Presence : std::uint8_t { free, occupied, not_seen };
std::string_view to_string(Presence presence);

/// What the returns of a scan say about a place, both in the sensor frame: the question of `ask`, of one place and
/// without an index. `returns` must hold all returns of the scan that lie within the angle of the place's direction;
/// others do no harm.
Answer ask_returns(std::span<const PointCloud> returns, const UsableRange& usable, const Eigen::Vector3d& place_m,
                   const Thresholds& thresholds);

/// What the answers about one place, or about several places in a box, say together: occupied when any is; free when at
/// least half of them are; else not seen.
Presence presence_of(std::span<const Answer> answers);

/// What one scan showed of a place.
struct PlaceSight {
  ScanId scan;
  Time at;
  Presence presence = Presence::not_seen;
};

/// A time through which a place was the same. The first and the last scan bracket it: what was between two intervals is
/// not known.
struct PlaceInterval {
  Presence presence = Presence::not_seen;
  ScanId first_scan, last_scan;
  Time from, to;               ///< when these were taken
  std::uint64_t scans = 0;     ///< that showed it so
  std::uint64_t not_seen = 0;  ///< scans between these that could not see the place
};

/// The sights of a place, in the order of time, as intervals. Scans that could not see it stand as an interval of their
/// own only where the others before and after them differ, or at either end.
std::vector<PlaceInterval> intervals_of(std::span<const PlaceSight> sights);

}  // namespace raywatch
