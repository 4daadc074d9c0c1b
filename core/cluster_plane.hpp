#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/compare.hpp"

namespace raywatch {

/// How even a flat surface is (standard deviation) beside the noise of its scan.
inline constexpr double kEven_m = 0.015;

/// The plane of a flat cluster, in the frame of a scan that is asked about it.
struct ClusterPlane {
  Eigen::Vector3d center_m, normal;
  Eigen::Vector3d own_sensor_m;           ///< where the sensor stood that saw the cluster
  double thickness_m;                     ///< how flat the cluster had to be: a standard deviation
  double radius_m;                        ///< of a ball around the centre that holds nearly all members
  std::vector<Eigen::Vector3d> points_m;  ///< some of the members, evenly spread

  /// Nothing for a cluster that is small, narrow or not flat beside the noise of its scan.
  /// @param members points of `view`
  static std::optional<ClusterPlane> fit(const ScanView& view, std::span<const std::uint32_t> members,
                                         const ScanView& asked);

  double off_m(const Eigen::Vector3d& point_m) const { return std::abs(normal.dot(point_m - center_m)); }
  /// The cosine of the incidence at which a sensor meets a place of the plane.
  double facing(const Eigen::Vector3d& point_m, const Eigen::Vector3d& sensor_m) const;
  /// The median over the cluster.
  double median_facing(const Eigen::Vector3d& sensor_m) const;
};

}  // namespace raywatch
