#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "core/compare.hpp"

namespace raywatch {

/// Of each change of a comparison at most `most` (> 0) of its points (world), evenly chosen in their order.
std::vector<std::vector<Eigen::Vector3f>> sample_changes(const ScanView& scan, std::span<const ScanView> priors,
                                                         const Comparison& comparison, std::size_t most);

}  // namespace raywatch
