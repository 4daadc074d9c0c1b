#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/compare.hpp"

namespace raywatch::evaluation {

/// The half-angle within which a scan's returns can tell about a direction: 1.5 spacings of its shots.
double testing_angle_rad(const ScanView& asked);

/// For each point of `view` whether one of the `others` could tell what was there: it has returns within 1.5 spacings
/// of its shots around the point's direction, and not all of them are nearer than the point by more than 5 cm. A point
/// behind what all others saw, or where none of them looked, cannot be tested by any method.
std::vector<std::uint8_t> testable_points(const ScanView& view, std::span<const ScanView> others);

}  // namespace raywatch::evaluation
