#pragma once

#include <chrono>
#include <cmath>
#include <numbers>

#include "core/time.hpp"

namespace raywatch {

/// @{ The units of the API beside those of the program. Degrees are rounded to 1e-9, so that 0.2 comes back as 0.2.
inline double radians_of_deg(double deg) { return deg * (std::numbers::pi / 180.0); }
inline double deg_of_radians(double rad) { return std::round(rad * (180.0 / std::numbers::pi) * 1e9) / 1e9; }
inline double radians_of_mrad(double mrad) { return mrad * 1e-3; }
inline double mrad_of_radians(double rad) { return std::round(rad * 1e3 * 1e9) / 1e9; }
inline double seconds_of(Duration duration) { return std::chrono::duration<double>(duration).count(); }
inline Duration duration_of_seconds(double seconds) {
  return std::chrono::round<Duration>(std::chrono::duration<double>(seconds));
}
/// @}

}  // namespace raywatch
