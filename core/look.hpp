#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "core/compare.hpp"

namespace raywatch {

/// What a scan says about single places (world): free, occupied or out of sight. The angular threshold follows the
/// resolution of the sensor as in `detect`.
std::vector<Answer> look_at(const ScanView& scan, std::span<const Eigen::Vector3d> places_m,
                            const CompareParameters& parameters);

}  // namespace raywatch
