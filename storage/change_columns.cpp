#include "storage/change_columns.hpp"

namespace raywatch {

void bind_change(Statement& row, const Change& change, const PoseBytes& box_pose) {
  row.bind(to_string(change.kind));
  for (const Eigen::Vector3d& v : {change.centroid_m, change.bounds_m.min(), change.bounds_m.max()}) {
    row.bind(v.x(), v.y(), v.z());
  }
  row.bind(box_pose, change.box.size_m.x(), change.box.size_m.y(), change.box.size_m.z(), change.volume_m3,
           change.points, change.confidence.value, change.confidence.free, change.confidence.supported,
           change.confidence.unknown);
}

Change take_change(Statement& row) {
  Change change;
  change.kind =
      enum_from_text(row.take<std::string>(), {ChangeKind::added, ChangeKind::removed, ChangeKind::discrepancy});
  change.centroid_m = take_vector(row);
  change.bounds_m = take_box(row);
  const Pose world_from_box = pose_from_bytes(row.take<std::span<const std::uint8_t>>());
  change.box = {world_from_box.position_m, take_vector(row), world_from_box.orientation};
  change.volume_m3 = row.take<double>();
  change.points = row.take<std::size_t>();
  change.confidence.value = row.take<double>();
  change.confidence.free = row.take<double>();
  change.confidence.supported = row.take<double>();
  change.confidence.unknown = row.take<double>();
  return change;
}

}  // namespace raywatch
