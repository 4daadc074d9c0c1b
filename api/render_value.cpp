#include "api/render.hpp"

namespace raywatch {

Json render(const Eigen::Vector3d& vector) { return Json::array({vector.x(), vector.y(), vector.z()}); }

Json render(const Pose& pose) {
  const Eigen::Quaterniond& q = pose.orientation;
  return {{"position_m", render(pose.position_m)}, {"orientation_xyzw", {q.x(), q.y(), q.z(), q.w()}}};
}

Json render(const std::optional<Time>& time) { return time ? Json(format_rfc3339(*time)) : Json(nullptr); }

Eigen::Vector3d origin_of(const Site& site) { return site.origin_m.value_or(Eigen::Vector3d::Zero()); }

}  // namespace raywatch
