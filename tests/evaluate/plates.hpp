#pragma once

#include <chrono>
#include <vector>

#include "tests/simulator/scene.hpp"
#include "tests/simulator/simulated_scan.hpp"

/// The smallest places in which every cause of an error can be shown.
namespace raywatch::evaluation {

/// The state of what came.
inline constexpr simulator::StateId kCame = 1;

/// A plate of 1 cm that stands across the x axis.
struct Plate {
  double x_m;
  double side_m;
  simulator::StateId state = simulator::kBackground;
};

/// A wall at 10 m with plates before it, seen from the origin with a shot every degree.
inline simulator::SimulatedScan scan_of(const std::vector<Plate>& plates, int minute, double step_deg = 1.0) {
  simulator::Scene scene;
  scene.add(simulator::Plane{{10.0, 0.0, 0.0}, -Eigen::Vector3d::UnitX()});
  for (const Plate& plate : plates) {
    const Eigen::Vector3d half_m(0.005, 0.5 * plate.side_m, 0.5 * plate.side_m);
    scene.add(simulator::Box{{Eigen::Quaterniond::Identity(), {plate.x_m + 0.005, 0.0, 0.0}}, half_m}, plate.state);
  }
  const simulator::Scanner scanner = simulator::grid_scanner({.step_rad = simulator::radians(step_deg),
                                                              .lowest_elevation_rad = simulator::radians(-20.0),
                                                              .highest_elevation_rad = simulator::radians(20.0)});
  simulator::SimulatedScan scan = take_scan(simulator::RayCaster(scene), scanner, simulator::exact_plan({}));
  scan.captured_at = Time{} + std::chrono::minutes(minute);
  return scan;
}

}  // namespace raywatch::evaluation
