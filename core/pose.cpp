#include "core/pose.hpp"

#include <cmath>
#include <string>

#include "core/error.hpp"

namespace raywatch {

Pose checked_pose(const Eigen::Vector3d& position_m, const Eigen::Vector4d& orientation_xyzw, const char* field) {
  if (!position_m.allFinite() || !orientation_xyzw.allFinite()) {
    throw InvalidInput("The pose has a value that is not a finite number.", {{field, "must be finite numbers"}});
  }
  if ((position_m.array().abs() > kFarthestPosition_m).any()) {
    const std::string found = "must have a position within 1e8 m of the origin of the coordinates, on each axis";
    throw InvalidInput("The pose " + found + ".", {{field, found}});
  }
  const double norm = orientation_xyzw.norm();
  if (std::abs(norm - 1.0) > kQuaternionNormTolerance) {
    const std::string found = "must be a unit quaternion x, y, z, w; its norm is " + std::to_string(norm);
    throw InvalidInput("The orientation of the pose " + found + ".", {{field, found}});
  }
  const Eigen::Vector4d unit = orientation_xyzw / norm;
  return {Eigen::Quaterniond(unit.w(), unit.x(), unit.y(), unit.z()), position_m};
}

double angle_between_rad(const Pose& a, const Pose& b) { return a.orientation.angularDistance(b.orientation); }

}  // namespace raywatch
