#pragma once

#include <cstddef>
#include <string>

#include "core/point_cloud.hpp"
#include "core/pose.hpp"
#include "core/time.hpp"

namespace raywatch::testing {

/// What stands in front of the wall.
struct WallScene {
  bool box = false;
  bool intensity = false;
};

/// A wall 10 m before the sensor, seen in steps of one degree, 61 columns of 41 rows; the box shows it a square of 1 m
/// at 4.5 m. Sensor frame.
PointCloud wall_points(const WallScene& scene);
inline constexpr std::size_t kWallPoints = 61 * 41;
/// How many of the points lie on the box.
std::size_t box_points();

/// The scan number `number`, one a minute from 2026-03-01T08:00:00Z.
Time wall_time(int number);

std::string pcd_of(const PointCloud& points, const Pose& world_from_sensor);

/// The pose of the tests' sensor: not the identity, which a PCD cannot tell from "none".
Pose wall_pose();

}  // namespace raywatch::testing
