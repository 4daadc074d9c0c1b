#pragma once

#include <Eigen/Core>

namespace raywatch::simulator {

struct Ray {
  Eigen::Vector3d origin_m;
  Eigen::Vector3d direction;  ///< of unit length

  Eigen::Vector3d at(double range_m) const { return origin_m + range_m * direction; }
};

/// Hits nearer than this are the surface that the ray starts on.
inline constexpr double kNearestHit_m = 1e-9;

}  // namespace raywatch::simulator
