#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/point_cloud.hpp"
#include "core/pose.hpp"

namespace raywatch {

/// A scan's coverage: for each coarse direction the farthest range that was seen. Small enough to be kept beside every
/// scan and to be read when priors are chosen, without touching the scan's points.
///
/// Cells are 3 degrees in elevation and azimuth, row by row from the nadir, columns from azimuth -pi. A cell holds
/// 0 for "nothing seen", else 1 + round(1000 * log2(1 + range_m)) (relative error of 1 + range below 0.04 %).
struct Panorama {
  static constexpr std::size_t kRows = 60;
  static constexpr std::size_t kColumns = 120;
  std::vector<std::uint16_t> farthest;  ///< kRows * kColumns

  double range_m(std::size_t cell) const;  ///< the farthest range seen in a cell; 0 if nothing was
};

/// From the usable returns of a scan. O(n).
Panorama make_panorama(const PointCloud& points, const UsableRange& usable);

/// The same as kRows * kColumns * 2 bytes, little endian.
std::vector<std::uint8_t> to_bytes(const Panorama& panorama);
/// @throws CorruptData when the length is wrong.
Panorama panorama_from_bytes(std::span<const std::uint8_t> bytes);

/// Of each point (world): 1 if it lies in a direction that was covered and not far behind what was seen there, else 0.
std::vector<std::uint8_t> covered(const Panorama& panorama, const Pose& sensor_from_world,
                                  std::span<const Eigen::Vector3d> points_m);

/// The farthest that the scan saw.
double reach_m(const Panorama& panorama);

}  // namespace raywatch
