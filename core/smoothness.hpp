#pragma once

#include <cstdint>
#include <span>

#include "core/compare.hpp"

namespace raywatch {

/// What the surface around a place is like, as a scan shows it. Places are in the scan's sensor frame.

/// What a scan shows within some distance of a place.
struct Surroundings {
  /// The mean, over the returns, of the share of the shots beside a return whose own lie on its surface, whatever its
  /// slope is; 0..1. Leaves and grass are low, and they move. 1 where the scan shows hardly anything.
  double smoothness = 1.0;
  std::size_t returns = 0;
};
Surroundings surroundings_of(const ScanView& view, const Eigen::Vector3d& center_m, double distance_m);

/// The same of some of the scan's own returns: the mean share of the shots beside each that lie on its surface.
double smoothness_of(const ScanView& view, std::span<const std::uint32_t> members);

/// How thick: the standard deviation of the returns within `radius_m` across their plane, beyond what the scan's noise
/// explains. 0 where the scan shows hardly anything.
double roughness_around_m(const ScanView& view, const Eigen::Vector3d& center_m, double radius_m);

}  // namespace raywatch
