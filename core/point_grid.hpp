#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "core/point_cloud.hpp"

namespace raywatch {

/// Points sorted into cubic cells, for those near a place or an axis. Immutable after it is built, so that any number
/// of threads may ask it. Non-finite points are left out.
class PointGrid {
 public:
  /// O(n log n). Runs in the caller's oneTBB arena. @param cell_m above 0; about the radius that is asked for.
  PointGrid(const PointCloud& points, double cell_m);

  /// Calls `visit(point)` for the points at most `radius_m` from `center_m`, always in the same order.
  template <class Visit>
  void for_each_near(const Eigen::Vector3d& center_m, double radius_m, Visit visit) const {
    const Cell low = cell_of(center_m - Eigen::Vector3d::Constant(radius_m));
    const Cell high = cell_of(center_m + Eigen::Vector3d::Constant(radius_m));
    for_each_in(low, high, [&](const Eigen::Vector3d& p) {
      if ((p - center_m).squaredNorm() <= radius_m * radius_m) visit(p);
    });
  }

  /// A cylinder around an axis, on both sides of its middle.
  struct Cylinder {
    Eigen::Vector3d center_m;
    Eigen::Vector3d axis;  ///< of unit length
    double radius_m;
    double half_length_m;
  };
  /// Calls `visit(point, distance along the axis)` for the points in a cylinder, always in the same order.
  template <class Visit>
  void for_each_in(const Cylinder& cylinder, Visit visit) const;

 private:
  using Cell = std::array<std::int32_t, 3>;
  struct Hash {
    std::size_t operator()(const Cell& cell) const;
  };
  struct Range {
    std::uint32_t first, last;
  };

  Cell cell_of(const Eigen::Vector3d& p) const {
    const auto at = [&](int i) { return static_cast<std::int32_t>(std::floor(p[i] / cell_m_)); };
    return {at(0), at(1), at(2)};
  }
  template <class Visit>
  void for_each_in(const Cell& low, const Cell& high, Visit visit) const {
    for (std::int32_t i = low[0]; i <= high[0]; ++i) {
      for (std::int32_t j = low[1]; j <= high[1]; ++j) {
        for (std::int32_t k = low[2]; k <= high[2]; ++k) {
          const auto found = cells_.find({i, j, k});
          if (found == cells_.end()) continue;
          for (std::uint32_t n = found->second.first; n < found->second.last; ++n) visit(points_[n].cast<double>());
        }
      }
    }
  }

  double cell_m_;
  std::vector<Eigen::Vector3f> points_;  ///< by cell
  std::unordered_map<Cell, Range, Hash> cells_;
};

template <class Visit>
void PointGrid::for_each_in(const Cylinder& cylinder, Visit visit) const {
  // The cylinder is walked in slices of one cell along the coordinate that its axis follows most; each slice is the box
  // around the axis in it.
  int along = 0;
  cylinder.axis.cwiseAbs().maxCoeff(&along);
  const Eigen::Vector3d reach_m = cylinder.half_length_m * cylinder.axis;
  const Eigen::Vector3d extra_m =
      cylinder.radius_m * (Eigen::Array3d::Ones() - cylinder.axis.array().square()).max(0.0).sqrt().matrix();
  const double from_m = cylinder.center_m[along] - std::abs(reach_m[along]) - extra_m[along];
  const double to_m = cylinder.center_m[along] + std::abs(reach_m[along]) + extra_m[along];
  const auto first = static_cast<std::int32_t>(std::floor(from_m / cell_m_));
  const auto last = static_cast<std::int32_t>(std::floor(to_m / cell_m_));
  for (std::int32_t slice = first; slice <= last; ++slice) {
    // A point in the slice has its foot on the axis no farther from it than the end of the cylinder is wide there.
    const double low = (slice * cell_m_ - extra_m[along] - cylinder.center_m[along]) / cylinder.axis[along];
    const double high = ((slice + 1) * cell_m_ + extra_m[along] - cylinder.center_m[along]) / cylinder.axis[along];
    const Eigen::Vector3d a_m = cylinder.center_m + low * cylinder.axis, b_m = cylinder.center_m + high * cylinder.axis;
    Cell low_cell = cell_of(a_m.cwiseMin(b_m) - extra_m), high_cell = cell_of(a_m.cwiseMax(b_m) + extra_m);
    low_cell[static_cast<std::size_t>(along)] = high_cell[static_cast<std::size_t>(along)] = slice;
    for_each_in(low_cell, high_cell, [&](const Eigen::Vector3d& p) {
      const Eigen::Vector3d offset_m = p - cylinder.center_m;
      const double depth_m = offset_m.dot(cylinder.axis);
      if (std::abs(depth_m) > cylinder.half_length_m) return;
      if ((offset_m - depth_m * cylinder.axis).squaredNorm() <= cylinder.radius_m * cylinder.radius_m) {
        visit(p, depth_m);
      }
    });
  }
}

}  // namespace raywatch
