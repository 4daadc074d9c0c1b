#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <type_traits>

#include "core/cone.hpp"
#include "core/prior_index_impl.hpp"

namespace raywatch {

/// Calls visit(i) and tells whether to go on: what it returns, and always if it returns nothing.
template <class Visit>
bool goes_on(Visit& visit, std::uint32_t i) {
  if constexpr (std::is_void_v<decltype(visit(i))>) {
    visit(i);
    return true;
  } else {
    return visit(i);
  }
}

/// Calls visit(i) for the returns of an index in the cells that a cone touches, all that lie in the cone and some more,
/// until it returns false; it may return nothing.
template <class Visit>
void for_each_return_near(const PriorIndex::Impl& index, const Eigen::Vector3d& direction, double angle_rad,
                          Visit visit) {
  const Direction axis = direction_of(direction.x(), direction.y(), direction.z());
  const Cone cone(std::min(angle_rad, std::numbers::pi / 2));
  cone.for_each_stretch(index.grid, axis, [&](std::uint32_t first, std::uint32_t end) {
    for (std::uint32_t i = index.first[first]; i < index.first[end]; ++i) {
      if (!goes_on(visit, i)) return false;
    }
    return true;
  });
}

/// Every cell is of interest.
struct EveryCell {
  /// Calls look(cell) for the cells first..end - 1 for which `may_hold(cell)`, until it returns false, and then returns
  /// false. Where none is, as in most rows around a thing that stands free, one test without branches says so.
  template <class MayHold, class Look>
  bool for_each(std::uint32_t first, std::uint32_t end, const MayHold& may_hold, const Look& look) const {
    std::uint32_t some = 0;
    for (std::uint32_t cell = first; cell < end; ++cell) some |= static_cast<std::uint32_t>(may_hold(cell));
    for (std::uint32_t cell = first; some != 0 && cell < end; ++cell) {
      if (may_hold(cell) && !look(cell)) return false;
    }
    return true;
  }
};

/// The same for a ball that the sensor does not stand in: all returns in it, and none else, of the cells of interest.
/// Nothing when the sensor does.
/// @param cells the cells of interest, gone through by `for_each`: see `EveryCell`.
template <class Visit, class Cells = EveryCell>
void for_each_return_around(const PriorIndex::Impl& index, const Eigen::Vector3d& center_m, double radius_m,
                            Visit visit, const Cells& cells = {}) {
  const double range_m = center_m.norm();
  if (!(range_m > radius_m)) return;
  const double rounding_m = kRangeError * (2.0 * range_m + radius_m);
  const auto nearest_m = static_cast<float>(range_m - radius_m - rounding_m);
  const auto farthest_m = static_cast<float>(range_m + radius_m + rounding_m);
  const auto may_hold = [&](std::uint32_t cell) {
    return (index.least_m[cell] <= farthest_m) & (index.greatest_m[cell] >= nearest_m);
  };
  const auto look = [&](std::uint32_t cell) {
    for (std::uint32_t i = index.first[cell]; i < index.first[cell + 1]; ++i) {
      if ((point_of(index.returns[i]) - center_m).squaredNorm() < radius_m * radius_m && !goes_on(visit, i)) {
        return false;
      }
    }
    return true;
  };
  const Direction axis = direction_of(center_m.x(), center_m.y(), center_m.z());
  Cone(std::asin(radius_m / range_m))
      .for_each_stretch_of_box(index.grid, axis, [&](std::uint32_t first, std::uint32_t end) {
        return cells.for_each(first, end, may_hold, look);
      });
}

}  // namespace raywatch
