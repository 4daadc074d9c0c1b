#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <span>
#include <vector>

#include "core/compare.hpp"

namespace raywatch {

/// Priors that speak together about a part of the world.
struct PriorGroup {
  std::vector<ScanView> priors;
  std::optional<Eigen::AlignedBox3d> region_m;  ///< world; not given: wherever no other group speaks
  /// Per prior, or empty for none: it shows what is normal only together with all others of the group. What it saw and
  /// another one saw free, such as somebody who passed by or a twig in a gust, was never normal and cannot be missed.
  std::vector<bool> normal_together = {};
};

/// `detect` against priors of which each has a say only about its own part of the world: about a place the last group
/// speaks whose region holds it, or else the groups without a region, of which there should be one. What a prior saw
/// elsewhere neither supports nor frees anything, and is not asked about.
/// The priors of the result are those of all groups, one group after the other.
Detection detect_in_regions(const ScanView& scan, std::span<const PriorGroup> groups,
                            const CompareParameters& parameters);

/// The priors of all groups, in the order in which a merged detection numbers them.
std::vector<ScanView> all_priors(std::span<const PriorGroup> groups);

}  // namespace raywatch
