#pragma once

#include "core/compare.hpp"
#include "core/profile.hpp"
#include "tests/simulator/simulated_scan.hpp"
#include "tests/simulator/wall_and_box.hpp"

namespace raywatch {

/// A scan with all that a comparison needs of it.
struct WatchedScan {
  PointCloud points;
  PriorIndex index;
  Time captured_at;

  ScanView view() const { return {points, index, Pose{}, captured_at, estimate_sensor(points, index)}; }
};

/// A wall 10 m away, seen from the origin in steps of one degree, and perhaps a cube of 1 m whose face is at 4.5 m.
inline WatchedScan look_at_wall(bool box, Time captured_at = {}, double box_y_m = 0.0) {
  simulator::WallAndBox layout{.wall_distance_m = 10.0};
  if (box) layout.box_center_m = Eigen::Vector3d(5.0, box_y_m, 0.0);
  const simulator::Scene scene = simulator::wall_and_box(layout);
  PointCloud points = simulator::take_scan(simulator::RayCaster(scene),
                                           simulator::grid_scanner({.lowest_elevation_rad = simulator::radians(-20.0),
                                                                    .highest_elevation_rad = simulator::radians(20.0)}),
                                           simulator::exact_plan({}))
                          .points;
  PriorIndex index = PriorIndex::build(points, {});
  return {std::move(points), std::move(index), captured_at};
}

inline CompareParameters watch_parameters() {
  CompareParameters parameters = default_parameters(Profile::indoor, Grouping::consensus);
  parameters.cluster_distance_m = 0.3;  // a grid of one degree is coarse
  return parameters;
}

}  // namespace raywatch
