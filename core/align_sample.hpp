#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "core/compare.hpp"

namespace raywatch {

/// A flat piece of a scan's surface, in its sensor frame.
struct SurfaceSample {
  Eigen::Vector3d point_m;  ///< on the fitted plane
  Eigen::Vector3d normal;   ///< unit, towards the sensor
  double sigma_m;           ///< standard error of the plane's place
};

/// At most `count` pieces, from all directions that the scan covers, and with normals as different as the scene allows
/// (normal-space sampling after Rusinkiewicz and Levoy, "Efficient variants of the ICP algorithm", 3DIM 2001): a wall
/// that fixes the way along a road weighs as much as the road. Deterministic. Runs in the caller's oneTBB arena.
std::vector<SurfaceSample> sample_surface(const ScanView& scan, std::size_t count);

}  // namespace raywatch
