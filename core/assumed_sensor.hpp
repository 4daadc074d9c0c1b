#pragma once

#include "core/compare.hpp"

namespace raywatch {

/// The spacing of a scan's shots in azimuth and elevation, in radians; assumed where nothing is known.
inline Eigen::Vector2d spacing_of(const ScanView& view) {
  constexpr double kFallbackSpacing_rad = 0.01;
  return view.sensor.angular_resolution_rad.value_or(Eigen::Vector2d::Constant(kFallbackSpacing_rad));
}

/// The standard deviation of a scan's ranges in metres; assumed where nothing is known.
inline double noise_of(const ScanView& view) {
  constexpr double kFallbackNoise_m = 0.02;
  return view.sensor.range_noise_m.value_or(kFallbackNoise_m);
}

}  // namespace raywatch
