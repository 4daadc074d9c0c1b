#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "core/prior_index.hpp"

namespace raywatch::testing {

/// The five answers straight from their definition, every return of the prior against every point, in double precision
/// and with angles as angles. `margin` tells how far the point is from being answered otherwise.
struct BruteForceAnswer {
  Answer answer = Answer::unseen;
  /// The least distance of any compared quantity from its threshold, relative to the quantity's size: angles to T_a,
  /// ranges to rho +- T_r, tangent-plane offsets (of returns in the cone) to 0.
  double margin = 0.0;
};

BruteForceAnswer brute_force_answer(const std::vector<Eigen::Vector3d>& prior_returns_m, const Eigen::Vector3d& point_m,
                                    const Thresholds& thresholds);

/// 1 for each answer that is free, else 0.
std::vector<std::uint8_t> are_free(std::span<const Answer> answers);

/// `find_free` with a result of its own.
std::vector<std::uint8_t> free_points(const PriorIndex& prior, const PointCloud& points,
                                      std::span<const std::uint8_t> valid, const Pose& prior_from_points,
                                      const Thresholds& thresholds);

/// The usable returns of a cloud in double.
std::vector<Eigen::Vector3d> usable_returns(const PointCloud& cloud, const UsableRange& usable);

}  // namespace raywatch::testing
