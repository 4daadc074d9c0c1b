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

class PriorIndex;

/// What one scan shows about the sensor that took it:
/// - `angular_resolution_rad`: the medians of the angular distance to the neighbouring returns on either side, and
/// above
///   and below;
/// - `no_return_m`: a range that an implausible share of the returns has to the millimetre and none exceeds;
/// - `range_noise_m`: from how far returns are from the planes through their neighbours on either side.
/// The first and the last do not depend on the order of the returns. Fields that the scan does not show stay empty.
/// Deterministic; O(n).
SensorModel estimate_sensor(const PointCloud& cloud);
/// The same with an index of the cloud's returns that is there already.
SensorModel estimate_sensor(const PointCloud& cloud, const PriorIndex& index);

/// `known` with its empty fields filled from `estimated`.
SensorModel merged(const SensorModel& known, const SensorModel& estimated);

}  // namespace raywatch
