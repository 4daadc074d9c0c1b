#include "storage/formats/placement.hpp"

#include <sstream>
#include <string>

#include "core/error.hpp"

namespace raywatch {

Placement placement_of(const ScanHints& hints, Frame usual_frame, const std::optional<Pose>& pose_in_file,
                       const Eigen::Vector3d& origin_m) {
  Placement placement;
  placement.origin_m = origin_m;
  placement.world_from_sensor = hints.pose ? hints.pose : pose_in_file ? pose_in_file : hints.fixed_pose;
  if (hints.frame.value_or(usual_frame) == Frame::sensor) return placement;
  if (!placement.world_from_sensor) {
    throw InvalidInput(
        "the points are in world coordinates and no pose is given: the sensor position is needed, because without it "
        "there are no rays, and nothing can be said about what was free",
        {{"pose", "is needed, because the points are in world coordinates"}});
  }
  placement.sensor_from_file = placement.world_from_sensor->inverse();
  return placement;
}

Pose checked_pose_at(const std::string& place, const Eigen::Vector3d& position_m,
                     const Eigen::Vector4d& orientation_xyzw) {
  try {
    return checked_pose(position_m, orientation_xyzw, place.c_str());
  } catch (const InvalidInput& error) {
    const std::string detail = error.fields().empty() ? error.what() : error.fields().front().message;
    throw InvalidInput(place + ": " + detail, {{"pose", detail}});
  }
}

void throw_not_a_float(double value, std::size_t point) {
  std::ostringstream message;
  message << "point " << point << " (counted from 0): the value " << value << " is too large for a 32-bit float";
  throw InvalidInput(message.str());
}

}  // namespace raywatch
