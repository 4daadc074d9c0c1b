#pragma once

#include <span>

#include "core/compare.hpp"

namespace raywatch {

/// How far a point of one scan can stand off a surface that another scan measured, though it is a point of it. Standard
/// deviations but for the first.
struct SurfaceTolerance {
  double roughness_m = 0.0;    ///< of the surface itself, and of taking it as flat; at least this is allowed
  double range_noise_m = 0.0;  ///< of the difference of two ranges
  double position_m = 0.0;     ///< of the poses of both scans, each axis
  double angle_rad = 0.0;      ///< the same
};
SurfaceTolerance tolerance_between(const ScanView& a, const ScanView& b, const CompareParameters& parameters);

/// Looks closely at what a prior shows around points, where `ask` is blind: it takes the prior's surface as constant at
/// its least range, so that a point before a slanted surface seems supported, and one on its far side free.
///
/// Where the returns within T_a lie in a plane, the point's distance to it decides: on it, supported; well before it,
/// free; behind it, occluded. Elsewhere a return as near as that supports, and `answers`, which holds what `ask` said,
/// decides if nothing is near. What is too near to be free and too far to be supported is ambiguous.
/// `points` stand in a frame that `prior_from_points` leads out of; `answers` has one element a point.
void weigh(const PriorIndex& prior, const PointCloud& points, const Pose& prior_from_points,
           const Thresholds& thresholds, const SurfaceTolerance& tolerance, std::span<Answer> answers);

}  // namespace raywatch
