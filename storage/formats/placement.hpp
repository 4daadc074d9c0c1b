#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>

#include "core/point_cloud.hpp"
#include "core/pose.hpp"
#include "storage/formats/scan_file.hpp"

namespace raywatch {

/// How the coordinates of a file become points in the sensor frame.
struct Placement {
  std::optional<Pose> world_from_sensor;               ///< of the scan, from whoever knows it
  std::optional<Pose> sensor_from_file;                ///< empty when the file's points are in the sensor frame
  Eigen::Vector3d origin_m = Eigen::Vector3d::Zero();  ///< what the file's coordinates are relative to

  bool moves_points() const { return sensor_from_file.has_value() || !origin_m.isZero(0.0); }
};

/// The pose is what a person gave, else what the file says, else the sensor's fixed one.
/// @throws InvalidInput when the points are in world coordinates and there is no pose.
Placement placement_of(const ScanHints& hints, Frame usual_frame, const std::optional<Pose>& pose_in_file,
                       const Eigen::Vector3d& origin_m = Eigen::Vector3d::Zero());

/// `checked_pose` whose message says by itself where the pose stands ("line 9: VIEWPOINT") and what is wrong with it.
Pose checked_pose_at(const std::string& place, const Eigen::Vector3d& position_m,
                     const Eigen::Vector4d& orientation_xyzw);

/// Throws the InvalidInput for a finite value that is no finite float.
[[noreturn]] void throw_not_a_float(double value, std::size_t point);

/// `value` as a float, NaN and infinity kept. `point` stands in the message.
/// @throws InvalidInput when a finite value would become infinite.
inline float narrowed(double value, std::size_t point) {
  if (std::abs(value) > static_cast<double>(std::numeric_limits<float>::max()) && std::isfinite(value)) {
    const auto rounded = static_cast<float>(value);
    if (!std::isfinite(rounded)) throw_not_a_float(value, point);
    return rounded;
  }
  return static_cast<float>(value);
}

/// Appends a point given in the coordinates of the file. The motion is done in double. A point with a coordinate that
/// is not finite is nowhere, so it keeps its coordinates.
/// @throws InvalidInput naming the point when a coordinate does not fit into a float.
inline void append_placed(PointCloud& cloud, const Placement& placement, const Eigen::Vector3d& file_point_m) {
  Eigen::Vector3d point_m = file_point_m;
  if (point_m.allFinite() && placement.moves_points()) {
    point_m += placement.origin_m;
    if (placement.sensor_from_file) point_m = *placement.sensor_from_file * point_m;
  }
  const std::size_t index = cloud.size();
  const float x = narrowed(point_m.x(), index);
  const float y = narrowed(point_m.y(), index);
  const float z = narrowed(point_m.z(), index);
  cloud.push_back(x, y, z);
}

}  // namespace raywatch
