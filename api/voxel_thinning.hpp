#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace raywatch {

/// The coordinates of points to thin; all planes have one length.
struct ThinningInput {
  std::span<const float> x_m, y_m, z_m;
  std::span<const std::uint8_t> groups;  ///< points of different groups never stand for each other; empty: one group
};

/// The places, in ascending order, of one point for each occupied cube of a grid with the edge `voxel_m` > 0 and for
/// each group in it: the point nearest to the mean of the cube's points, the first of equals. Points that are not
/// finite are left out. Deterministic; O(n log n).
std::vector<std::uint32_t> thin(const ThinningInput& points, double voxel_m);

}  // namespace raywatch
