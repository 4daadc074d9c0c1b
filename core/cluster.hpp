#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace raywatch {

/// Euclidean clustering: points nearer than `distance_m` to each other are in one cluster, and so are all that are
/// linked through others (single linkage).
/// @param distance_m greater than 0, finite.
/// @returns the cluster of each point, numbered from 0 in the order of each cluster's first point. Deterministic;
///   O(n log n) also when many points share one place.
std::vector<std::uint32_t> cluster_points(std::span<const Eigen::Vector3f> points_m, double distance_m);

/// The same with a distance for every point, for scans that are sparser far away: two points belong together when they
/// are nearer to each other than the smaller of their reaches, each rounded down to a power of the square root of 2
/// times the least one.
/// @param reach_m one a point, greater than 0, finite.
std::vector<std::uint32_t> cluster_points(std::span<const Eigen::Vector3f> points_m, std::span<const float> reach_m);

}  // namespace raywatch
