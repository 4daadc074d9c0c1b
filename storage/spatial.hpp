#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <limits>

namespace raywatch {

// What an R*Tree keeps are 32-bit floats. These give the nearest float on the safe side, so that bounds only ever grow.
// Besides, all bounds get a margin: an R*Tree decides by volumes, and flat boxes (one site, one height) have none.

/// The largest float that is not above `value`.
inline float float_below(double value) {
  const auto rounded = static_cast<float>(value);
  return static_cast<double>(rounded) > value ? std::nextafterf(rounded, -std::numeric_limits<float>::infinity())
                                              : rounded;
}

/// The smallest float that is not below `value`.
inline float float_above(double value) { return -float_below(-value); }

inline constexpr double kTreeMargin = 0.1;
inline float tree_min(double value) { return float_below(value - kTreeMargin); }
inline float tree_max(double value) { return float_above(value + kTreeMargin); }

}  // namespace raywatch
