#pragma once

#include <cstdint>
#include <span>

#include "core/compare.hpp"

namespace raywatch {

/// What the points of a cluster, taken together, tell about whether `asked` saw their place free.
struct ClusterVotes {
  /// Rays of `asked` that went through the cluster: returns well behind it in directions that its points surround. What
  /// is thinner than the spacing of the rays can hide between them: then there are none.
  std::size_t rays_through = 0;
  /// The mean share of the shots beside a point whose returns lie on its surface, 0..1: high on solid things, low in
  /// foliage, on fences and for returns mixed of two surfaces. Through such things rays of `asked` may pass. Beside:
  /// one shot of either scan away, whichever is farther.
  double coherence = 0.0;
  /// The same share of the returns of `asked` within `foliage_distance_m` of the cluster, whatever the slope of their
  /// surface is. Leaves and grass are low, and they move.
  double surroundings = 1.0;
  /// The mean thickness of the layer in which the returns of `asked` near the points lie: low beside flat surfaces.
  double roughness_m = 0.0;
};

/// @param members points of `view`, at least one.
ClusterVotes votes_of(const ScanView& view, std::span<const std::uint32_t> members, const ScanView& asked,
                      const CompareParameters& parameters);

}  // namespace raywatch
