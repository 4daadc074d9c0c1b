#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "core/compare.hpp"

namespace raywatch {

/// With what a scan is asked about single places. They are asked about more closely than T_r allows: a thing that
/// stands flat before a wall is gone when the wall is seen, however near that is.
Thresholds look_thresholds(const SensorModel& sensor, const CompareParameters& parameters);

/// What a scan says about single places (world): free, occupied or out of sight. The angular threshold follows the
/// resolution of the sensor as in `detect`.
std::vector<Answer> look_at(const ScanView& scan, std::span<const Eigen::Vector3d> places_m,
                            const CompareParameters& parameters);

}  // namespace raywatch
