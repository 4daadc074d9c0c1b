#pragma once

#include <Eigen/Core>
#include <optional>

#include "core/point_cloud.hpp"

namespace raywatch {

/// What a sensor is known to do. Fields that are not known are empty; `estimate_sensor` fills them from a scan.
struct SensorModel {
  std::optional<double> range_noise_m;                    ///< one standard deviation
  std::optional<Eigen::Vector2d> angular_resolution_rad;  ///< spacing of shots in azimuth and in elevation
  std::optional<double> beam_divergence_rad;              ///< full angle
  std::optional<double> min_range_m;
  std::optional<double> max_range_m;
  std::optional<double> no_return_m;  ///< the range reported for "no return", when the sensor has such a sentinel
};

/// What one scan shows about the sensor that took it:
/// - `angular_resolution_rad`: the median angular distance between neighbouring returns in the order of the file
///   (azimuth) and between neighbouring rings (elevation; equal to the former where no rings stand out);
/// - `no_return_m`: a range that an implausible share of the returns has to the millimetre and none exceeds.
/// Fields that the scan does not show stay empty. Deterministic; O(n log n).
SensorModel estimate_sensor(const PointCloud& cloud);

/// `known` with its empty fields filled from `estimated`.
SensorModel merged(const SensorModel& known, const SensorModel& estimated);

}  // namespace raywatch
