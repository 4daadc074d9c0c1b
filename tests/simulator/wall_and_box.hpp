#pragma once

#include <optional>

#include "tests/simulator/scene.hpp"

namespace raywatch::simulator {

/// The smallest scene in which something can change: a wall across the x axis and perhaps a box before it. The sensor
/// is meant to stand in the origin.
struct WallAndBox {
  double wall_distance_m = 10.0;
  std::optional<Eigen::Vector3d> box_center_m;
  Eigen::Vector3d box_size_m = Eigen::Vector3d::Ones();
};

/// The state of the box in `wall_and_box`.
inline constexpr StateId kBoxState = 1;

inline Scene wall_and_box(const WallAndBox& layout) {
  Scene scene;
  scene.add(Plane{{layout.wall_distance_m, 0.0, 0.0}, -Eigen::Vector3d::UnitX()});
  if (layout.box_center_m) {
    scene.add(Box{{Eigen::Quaterniond::Identity(), *layout.box_center_m}, 0.5 * layout.box_size_m}, kBoxState);
  }
  return scene;
}

}  // namespace raywatch::simulator
