#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "core/compare.hpp"

namespace raywatch {

using Members = std::vector<std::uint32_t>;  ///< places in a list of points

/// The changed points of one kind, in the world, and which of the views each was seen by.
struct SeenPoints {
  std::span<const Eigen::Vector3d> world_m;
  std::span<const std::uint32_t> view_of;  ///< place in `views`, one a point
  std::vector<const ScanView*> views;
};

/// Joins clusters that are parts of one thing as far as anybody could see: what stands before it, its own near side, or
/// lost returns can hide all that lies between them. Two are joined when the gap between them is at most as wide as the
/// larger of them is long in plan, and none of the views that show either saw a place in the gap free. Narrow gaps come
/// first, and what has been joined counts as one.
///
/// Deterministic, and the same for every order of points and clusters but for the order of the result: each joined
/// cluster stands where the first of its parts did, with its members ascending.
std::vector<Members> join_parts(std::vector<Members> clusters, const SeenPoints& points,
                                const CompareParameters& parameters);

}  // namespace raywatch
