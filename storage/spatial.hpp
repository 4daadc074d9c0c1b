#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <limits>

namespace raywatch {

// What an R*Tree keeps are 32-bit floats. These give the nearest float on the safe side, so that bounds only ever grow.

/// The largest float that is not above `value`.
inline float float_below(double value) {
  const auto rounded = static_cast<float>(value);
  return static_cast<double>(rounded) > value ? std::nextafterf(rounded, -std::numeric_limits<float>::infinity())
                                              : rounded;
}

/// The smallest float that is not below `value`.
inline float float_above(double value) { return -float_below(-value); }

}  // namespace raywatch
