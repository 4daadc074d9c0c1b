#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "core/direction_grid.hpp"
#include "core/prior_index.hpp"

namespace raywatch {

/// The ranges of the returns of one cell, rounded outwards so that a bound is never inside what it bounds.
struct RangeInterval {
  float least_m = std::numeric_limits<float>::infinity();
  float greatest_m = -std::numeric_limits<float>::infinity();

  bool empty() const { return least_m > greatest_m; }
  void extend(double range_m) {
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    auto low = static_cast<float>(range_m), high = low;
    if (low > range_m) low = std::nextafter(low, -kInfinity);
    if (high < range_m) high = std::nextafter(high, kInfinity);
    least_m = std::min(least_m, low);
    greatest_m = std::max(greatest_m, high);
  }
};

/// The usable returns, sorted by the cell of their direction.
struct PriorIndex::Impl {
  UsableRange usable;
  DirectionGrid grid;
  std::vector<std::uint32_t> first;    ///< first return of each cell, and the number of returns
  std::vector<RangeInterval> range_m;  ///< of each cell
  std::vector<float> x_m, y_m, z_m;    ///< in the sensor frame
  std::vector<std::uint32_t> source;   ///< place of each return in the scan
};

}  // namespace raywatch
