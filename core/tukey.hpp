#pragma once

#include <cmath>

namespace raywatch {

/// Tukey's biweight: how much an observation counts that is off by so many deviations, 1..0; nothing beyond 4.7 of
/// them, where the estimate has 95 % of the efficiency of least squares if the errors are normal.
/// @param spread how much wider than the deviations the observations spread, > 0
inline double tukey_weight(double deviations, double spread = 1.0) {
  constexpr double kBeyond = 4.7;
  const double u = deviations / (kBeyond * spread);
  return std::abs(u) >= 1.0 ? 0.0 : (1.0 - u * u) * (1.0 - u * u);
}

}  // namespace raywatch
