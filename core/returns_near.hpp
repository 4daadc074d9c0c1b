#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/cone.hpp"
#include "core/prior_index_impl.hpp"

namespace raywatch {

/// Every cell is of interest.
inline constexpr auto kAnyCell = [](std::uint32_t) { return true; };

/// Calls visit(i) for the returns of an index in the cells that a cone touches: all that lie in the cone, and some
/// more. Cells for which `matters(cell)` is false are passed over.
template <class Visit, class Matters = decltype(kAnyCell)>
void for_each_return_near(const PriorIndex::Impl& index, const Eigen::Vector3d& direction, double angle_rad,
                          Visit visit, const Matters& matters = kAnyCell) {
  const Direction axis = direction_of(direction.x(), direction.y(), direction.z());
  Cone(std::min(angle_rad, std::numbers::pi / 2)).for_each_cell(index.grid, axis, [&](std::uint32_t cell, bool) {
    if (!matters(cell)) return true;
    for (std::uint32_t i = index.first[cell]; i < index.first[cell + 1]; ++i) visit(i);
    return true;
  });
}

/// The same for a ball that the sensor does not stand in; nothing when it does.
template <class Visit, class Matters = decltype(kAnyCell)>
void for_each_return_around(const PriorIndex::Impl& index, const Eigen::Vector3d& center_m, double radius_m,
                            Visit visit, const Matters& matters = kAnyCell) {
  const double range_m = center_m.norm();
  if (!(range_m > radius_m)) return;
  const auto visit_inside = [&](std::uint32_t i) {
    if ((point_of(index.returns[i]) - center_m).squaredNorm() < radius_m * radius_m) visit(i);
  };
  for_each_return_near(index, center_m, std::asin(radius_m / range_m), visit_inside, matters);
}

}  // namespace raywatch
