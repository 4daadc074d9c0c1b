#pragma once

#include <algorithm>
#include <cmath>

#include "core/cone.hpp"
#include "core/prior_index_impl.hpp"

namespace raywatch {

/// The distance from a point to the prior's nearest return, if it is below `farthest_m` (< the point's range), else
/// that; any distance below `enough_m` will do. Looks into the cone that a ball around the point fills, seen from the
/// prior.
inline double nearest_return_m(const PriorIndex::Impl& prior, const Eigen::Vector3d& point_m, double enough_m,
                               double farthest_m) {
  const double range_m = point_m.norm(), reach_m = farthest_m + kRangeError * (range_m + farthest_m);
  double nearest_m2 = farthest_m * farthest_m;
  const Direction axis = direction_of(point_m.x(), point_m.y(), point_m.z());
  Cone(std::asin(farthest_m / range_m)).for_each_cell(prior.grid, axis, [&](std::uint32_t cell, bool) {
    if (prior.least_m[cell] > range_m + reach_m || prior.greatest_m[cell] < range_m - reach_m) return true;
    for (std::uint32_t i = prior.first[cell]; i < prior.first[cell + 1]; ++i) {
      nearest_m2 = std::min(nearest_m2, (point_of(prior.returns[i]) - point_m).squaredNorm());
    }
    return nearest_m2 >= enough_m * enough_m;
  });
  return std::sqrt(nearest_m2);
}

}  // namespace raywatch
