#pragma once

#include <Eigen/Core>

#include "core/compare.hpp"

namespace raywatch {

/// How far a changed point reaches for others of the same thing: `cluster_distance_m`, and farther where the scan is
/// too sparse for it. In a union always `cluster_distance_m`.
float reach_m(const ScanView& view, const Eigen::Vector3f& point_m, const CompareParameters& parameters);

}  // namespace raywatch
