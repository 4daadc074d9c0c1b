#pragma once

#include <string>

#include "core/compare.hpp"

namespace raywatch::bench {

/// A scan with its index, as a comparison takes it.
struct BenchScan {
  PointCloud points;
  PriorIndex index;
  Pose world_from_sensor;
  Time captured_at;
  SensorModel sensor;

  ScanView view() const { return {points, index, world_from_sensor, captured_at, sensor}; }
};

/// One scan and two priors of the same simulated place, one from the same pose and one from another, with thresholds.
struct BenchScene {
  std::string name;
  BenchScan scan, same_pose, other_pose;
  Thresholds thresholds;
};

enum class SceneSize {
  dense,    ///< 512,000 points of a cluttered room; T_a = 1 degree, T_r = 0.1 m
  survey,   ///< 1.4 million points of a mine; T_a = 3 times the resolution, T_r = 0.1 m
  surveys,  ///< 5.6 million points of it
};

/// Made at the first call and kept.
const BenchScene& scene(SceneSize size);

}  // namespace raywatch::bench
