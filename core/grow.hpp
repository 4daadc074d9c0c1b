#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "core/compare.hpp"

namespace raywatch {

/// How far a changed point reaches for others of the same thing: `cluster_distance_m`, and farther where the scan is
/// too sparse for it. In a union always `cluster_distance_m`.
float reach_m(const ScanView& view, const Eigen::Vector3f& point_m, const CompareParameters& parameters);

/// A point of a scan, and the class that it takes.
struct ClassedPoint {
  std::uint32_t index;
  PointClass point_class;
};

/// A point that one scan saw free.
struct Candidate {
  std::uint32_t index;
  PointClass point_class;
  bool contradicted = false;  ///< another scan, which decides, did not
};

/// Tells for each of the given points whether it may belong to a change: whether no scan shows that it was there.
using IsOpen = std::function<std::vector<std::uint8_t>(std::span<const std::uint32_t>)>;

/// Hysteresis: from points that surely changed (`seeds`, by index) a change grows over the points that lie beside it
/// and may belong to it, so that the foot of a thing and the side that was out of sight are not lost. Only seeds that
/// form a cluster grow, and no farther than `growth_distance_m` from a seed.
/// @returns the points that join, by index. Deterministic.
std::vector<ClassedPoint> grow(const ScanView& view, std::span<const Candidate> candidates,
                               std::span<const ScanView> asked, const CompareParameters& parameters,
                               const IsOpen& is_open);

}  // namespace raywatch
