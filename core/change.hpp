#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

namespace raywatch {

/// What happened to the world at the place of a cluster.
enum class ChangeKind : std::uint8_t {
  added,        ///< was free, is occupied
  removed,      ///< was occupied, is free
  discrepancy,  ///< two scans of the same time disagree
};
std::string_view to_string(ChangeKind kind);
/// @throws InvalidInput naming the known ones.
ChangeKind parse_change_kind(std::string_view name);

/// A box with its own axes. `world_from_box` turns box axes (x: longest horizontal side, z: up) into world axes.
struct OrientedBox {
  Eigen::Vector3d center_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d size_m = Eigen::Vector3d::Zero();
  Eigen::Quaterniond world_from_box = Eigen::Quaterniond::Identity();
};

/// How sure a change is: over its points, the mean share of priors that saw them free, that supported them, and that
/// could not tell. `value`: the share of the telling scans that agree; a prior that shows what was removed agrees.
struct Confidence {
  double value = 0.0;  ///< 0..1
  double free = 0.0;
  double supported = 0.0;
  double unknown = 0.0;
};

/// One cluster of changed points, in the world frame.
struct Change {
  ChangeKind kind = ChangeKind::added;
  Eigen::Vector3d centroid_m = Eigen::Vector3d::Zero();
  Eigen::AlignedBox3d bounds_m;
  OrientedBox box;
  double volume_m3 = 0.0;  ///< of `box`, not of the object
  std::size_t points = 0;
  Confidence confidence;
};

/// The box of least volume around `points_m` (3 x n, world, n >= 1) among those with a vertical axis.
/// O(n log n): one side lies on an edge of the convex hull of the horizontal projection.
OrientedBox bounding_box(const Eigen::Matrix3Xd& points_m);

}  // namespace raywatch
