#pragma once

#include <algorithm>
#include <cmath>

#include "core/returns_near.hpp"

namespace raywatch {

/// The distance from a point to the prior's nearest return, if it is below `farthest_m` (< the point's range), else
/// that; any distance below `enough_m` will do. Looks into the cone that a ball around the point fills, seen from the
/// prior.
inline double nearest_return_m(const PriorIndex::Impl& prior, const Eigen::Vector3d& point_m, double enough_m,
                               double farthest_m) {
  double nearest_m2 = farthest_m * farthest_m;
  for_each_return_around(prior, point_m, farthest_m, [&](std::uint32_t i) {
    nearest_m2 = std::min(nearest_m2, (point_of(prior.returns[i]) - point_m).squaredNorm());
    return nearest_m2 >= enough_m * enough_m;
  });
  return std::sqrt(nearest_m2);
}

}  // namespace raywatch
