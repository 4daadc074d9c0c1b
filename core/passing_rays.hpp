#pragma once

#include <vector>

#include "core/compare.hpp"

namespace raywatch {

/// How low the rays of a scan passed over the ground: where a ray went on beyond a place, the ground there lies below
/// it. Kept as the least slope of the rays by sector of azimuth and by horizontal distance from the sensor.
class PassingRays {
 public:
  /// What is kept, and how finely.
  struct Extent {
    double step_m = 1.0;   ///< of distance
    double reach_m = 1.0;  ///< farther places are not asked about
  };
  /// O(returns). Only returns tell how far a ray went; shots without a return bound nothing.
  PassingRays(const ScanView& scan, const Extent& extent);

  /// A height (world) below which the ground lies all over a square cell: the greatest height at which, in any sector
  /// of azimuth that the cell touches, the lowest ray crossed it. Infinity when in some sector none did.
  double ceiling_m(const Eigen::Vector2d& center_m, double cell_m) const;

 private:
  float least_slope(std::size_t sector, double distance_m) const;

  Eigen::Vector3d position_m_;
  Extent extent_;
  std::size_t sectors_;
  std::size_t steps_;
  std::vector<float> least_slope_;  ///< sector by sector: of rays that went beyond each step of distance
};

}  // namespace raywatch
