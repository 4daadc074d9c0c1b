#pragma once

#include <Eigen/Geometry>

namespace raywatch {

/// A rigid motion. Variables of this type are named by their frames, so that names chain:
/// `prior_from_new = prior_from_world * world_from_new`.
struct Pose {
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();  ///< of unit norm
  Eigen::Vector3d position_m = Eigen::Vector3d::Zero();

  Pose inverse() const {
    const Eigen::Quaterniond back = orientation.conjugate();
    return {back, -(back * position_m)};
  }
  Eigen::Vector3d operator*(const Eigen::Vector3d& point_m) const { return orientation * point_m + position_m; }
  Pose operator*(const Pose& inner) const {
    return {(orientation * inner.orientation).normalized(), orientation * inner.position_m + position_m};
  }
};

/// How far a pose may be off: one standard deviation of each axis. Zero: taken as exact.
struct PoseUncertainty {
  double position_m = 0.0;
  double angle_rad = 0.0;
};

/// How far the norm of a quaternion that a user gives may be from 1; within it the quaternion is normalised.
inline constexpr double kQuaternionNormTolerance = 1e-3;

/// How far from the origin of the coordinates a position may lie, on each axis. It leaves room for all coordinates of
/// maps, also for eastings with the number of their zone before them, and for geocentric ones; millimetres given for
/// metres exceed it.
inline constexpr double kFarthestPosition_m = 1e8;

/// The pose as a user gave it, checked: all finite, the position within `kFarthestPosition_m`, the quaternion of unit
/// norm within `kQuaternionNormTolerance`.
/// @throws InvalidInput naming `field` when it is not.
Pose checked_pose(const Eigen::Vector3d& position_m, const Eigen::Vector4d& orientation_xyzw, const char* field);

/// The rotation angle between two orientations, in radians, 0..pi.
double angle_between_rad(const Pose& a, const Pose& b);

}  // namespace raywatch
