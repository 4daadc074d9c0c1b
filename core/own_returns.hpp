#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "core/point_cloud.hpp"

namespace raywatch {

/// The directions in which a scan saw its own rig, such as a mast or the roof of a vehicle: those of returns nearer
/// than `UsableRange::min_m`. What lies behind is hidden, though no return in the index tells so. Immutable.
class OwnReturns {
 public:
  OwnReturns() = default;
  /// O(n).
  OwnReturns(const PointCloud& points, const UsableRange& usable);

  /// Whether the rig is in the way within so many radians (east, north) around a direction (sensor frame).
  bool hide(const Eigen::Vector3d& direction, const Eigen::Vector2d& around_rad) const;

  std::size_t bytes() const { return cells_.size() * sizeof(cells_.front()); }

 private:
  std::vector<std::uint32_t> cells_;  ///< of a grid of azimuth and elevation, row by row; ascending
};

}  // namespace raywatch
