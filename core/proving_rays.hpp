#pragma once

#include <cstdint>
#include <vector>

#include "core/point_cloud.hpp"
#include "core/prior_index.hpp"

namespace raywatch {

/// The rays of a scan that went where the points of a change are: they pass within `thresholds.angle_rad` of at least
/// one of them, and end at least `thresholds.range_m` behind every one that they pass so near.
///
/// `change` and `returns` stand in the frame of the sensor that sent the rays, which end at `returns`. Gives places in
/// `returns`, ascending.
std::vector<std::uint32_t> proving_rays(const PointCloud& change, const PointCloud& returns, const UsableRange& usable,
                                        const Thresholds& thresholds);

}  // namespace raywatch
