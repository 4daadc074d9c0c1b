#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/compare.hpp"
#include "core/judged_clusters.hpp"

namespace raywatch {

/// A point of a scan, and the class that it takes.
struct ClassedPoint {
  std::uint32_t index;
  PointClass point_class;
};

/// The points of the clusters that surely changed, for each scan by kind and cluster: one of the asked scans is sure of
/// it, or nearly so while a second one, or another scan's cluster at the same place, says the same.
/// @param scans the clusters of each scan.
std::vector<std::vector<ClassedPoint>> find_seeds(std::span<const std::vector<JudgedCluster>> scans,
                                                  const CompareParameters& parameters);

}  // namespace raywatch
