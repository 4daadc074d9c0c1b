#pragma once

#include <Eigen/Core>
#include <bit>
#include <cstdint>
#include <tuple>
#include <vector>

#include "core/direction_grid.hpp"
#include "core/own_returns.hpp"
#include "core/prior_index.hpp"
#include "core/raw_array.hpp"

namespace raywatch {

/// A usable return in the sensor frame.
struct Return {
  float x_m, y_m, z_m;
};

inline Eigen::Vector3d point_of(const Return& r) { return {r.x_m, r.y_m, r.z_m}; }
inline Direction direction_of(const Return& r) { return direction_of(r.x_m, r.y_m, r.z_m); }

/// Upper bound of the relative error of the bounds of cells, which are in single precision. Decisions closer to a
/// threshold than this are taken in double precision from the coordinates.
inline constexpr float kRangeError = 5e-7f;

/// The usable returns, sorted by the cell of their direction; in a cell they keep the order of the scan.
struct PriorIndex::Impl {
  UsableRange usable;
  DirectionGrid grid;
  RawArray<Return> returns;
  RawArray<std::uint32_t> first;        ///< first return of each cell, and the number of returns
  RawArray<float> least_m, greatest_m;  ///< ranges of each cell's returns; infinity and -infinity where it is empty
  OwnReturns own;                       ///< which are not among the returns
};

/// The return of an occupied cell that stands for it, whatever the order of the scan's points is.
inline std::uint32_t standing_for(const PriorIndex::Impl& index, std::uint32_t cell) {
  const auto place = [&](std::uint32_t i) {
    return std::make_tuple(index.returns[i].x_m, index.returns[i].y_m, index.returns[i].z_m);
  };
  std::uint32_t least = index.first[cell];
  for (std::uint32_t i = least + 1; i < index.first[cell + 1]; ++i) {
    if (place(i) < place(least)) least = i;
  }
  return least;
}

/// Chooses about one return in `stride`, the same ones whatever the order of the scan's points is.
inline bool is_chosen(const Return& r, std::uint32_t stride) {
  if (stride <= 1) return true;
  std::uint32_t mixed = std::bit_cast<std::uint32_t>(r.x_m) * 0x9E3779B1u ^
                        std::bit_cast<std::uint32_t>(r.y_m) * 0x85EBCA77u ^
                        std::bit_cast<std::uint32_t>(r.z_m) * 0xC2B2AE3Du;
  mixed = (mixed ^ (mixed >> 15)) * 0x2C1B3C6Du;
  return (mixed ^ (mixed >> 13)) % stride == 0;
}

/// The place in the scan of each return of its index, which is made anew in O(n): only few comparisons need it.
std::vector<std::uint32_t> sources_of(const PriorIndex::Impl& index, const PointCloud& points);

}  // namespace raywatch
