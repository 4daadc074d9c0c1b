#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/compare.hpp"

namespace raywatch {

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

/// How far a changed point reaches for others of the same thing: `cluster_distance_m`, and farther where the scan is
/// too sparse for it. In a union always `cluster_distance_m`.
float reach_m(const ScanView& view, const Eigen::Vector3f& point_m, const CompareParameters& parameters);

/// The candidates that surely changed: those in clusters of which one of the `asked` scans surely saw the place free
/// (core/cluster_votes.hpp), and which are mostly not contradicted. By kind, cluster and index.
std::vector<ClassedPoint> find_seeds(const ScanView& view, std::span<const Candidate> candidates,
                                     std::span<const ScanView> asked, const CompareParameters& parameters);

}  // namespace raywatch
