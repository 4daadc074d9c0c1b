#pragma once

#include "core/compare.hpp"

namespace raywatch {

/// A scan's returns, indexed, and what they show about their sensor.
struct ScanIndex {
  PriorIndex index;
  SensorModel estimated;
  UsableRange usable;  ///< the returns that the index holds: `usable_range` of `known` and `estimated` together
};

/// Indexes a scan of which not more may be known than what it shows itself. A range that the sensor reports instead of
/// "no return" is only seen once the scan is indexed; the few scans that have one are indexed again without it.
ScanIndex index_scan(const PointCloud& points, const SensorModel& known, const CompareParameters& parameters);

}  // namespace raywatch
