#include "tests/api/wall_scan.hpp"

#include <cmath>
#include <numbers>
#include <sstream>

#include "storage/formats/write.hpp"

namespace raywatch::testing {
namespace {

constexpr double kWall_m = 10.0;
constexpr double kBoxFace_m = 4.5;
constexpr double kBoxHalfSize_m = 0.5;

/// The direction of a shot, scaled to x = 1.
Eigen::Vector3d shot(int column, int row) {
  const double step_rad = std::numbers::pi / 180.0;
  const double azimuth_rad = (column - 30) * step_rad;
  const double elevation_rad = (row - 20) * step_rad;
  return {1.0, std::tan(azimuth_rad), std::tan(elevation_rad) / std::cos(azimuth_rad)};
}

bool hits_box(const Eigen::Vector3d& direction) {
  return kBoxFace_m * std::abs(direction.y()) <= kBoxHalfSize_m &&
         kBoxFace_m * std::abs(direction.z()) <= kBoxHalfSize_m;
}

}  // namespace

PointCloud wall_points(const WallScene& scene) {
  PointCloud points;
  for (int row = 0; row < 41; ++row) {
    for (int column = 0; column < 61; ++column) {
      const Eigen::Vector3d direction = shot(column, row);
      const Eigen::Vector3f point_m =
          (direction * (scene.box && hits_box(direction) ? kBoxFace_m : kWall_m)).cast<float>();
      points.push_back(point_m.x(), point_m.y(), point_m.z());
      if (scene.intensity) points.intensity.push_back(static_cast<float>(column) / 60.0F);
    }
  }
  return points;
}

std::size_t box_points() {
  std::size_t count = 0;
  for (int row = 0; row < 41; ++row)
    for (int column = 0; column < 61; ++column) count += hits_box(shot(column, row)) ? 1 : 0;
  return count;
}

Time wall_time(int number) { return parse_rfc3339("2026-03-01T08:00:00Z") + std::chrono::minutes(number); }

std::string pcd_of(const PointCloud& points, const Pose& world_from_sensor) {
  std::ostringstream out;
  write_scan_pcd(out, points, world_from_sensor);
  return out.str();
}

Pose wall_pose() { return {Eigen::Quaterniond(0.0, 0.0, 0.0, 1.0), {100.0, 200.0, 1.5}}; }

}  // namespace raywatch::testing
