#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/point_cloud.hpp"
#include "core/pose.hpp"
#include "core/time.hpp"
#include "tests/simulator/ray_caster.hpp"
#include "tests/simulator/scanner.hpp"

namespace raywatch::simulator {

/// A scan together with what no real scan has: the truth.
struct SimulatedScan {
  PointCloud points;  ///< sensor frame
  Pose true_world_from_sensor;
  Pose reported_world_from_sensor;
  Time captured_at;
  std::string sensor;
  std::vector<StateId> labels;   ///< one per point
  std::vector<StateId> present;  ///< the states that existed, ascending
};

/// From where and when a scan is taken. `seed` decides every error of this scan.
struct ScanPlan {
  Pose true_world_from_sensor;
  Pose reported_world_from_sensor;
  Time captured_at;
  std::string sensor;
  std::uint64_t seed = 0;
};

/// A plan without registration error.
ScanPlan exact_plan(const Pose& world_from_sensor, std::uint64_t seed = 0);

/// Shoots every direction of the scanner, in parallel inside the caller's arena. The result depends on the arguments
/// only, not on the number of threads.
///
/// A beam with divergence is traced as five rays. Where they hit several surfaces, the return stands on the nearer one
/// (four rays or more), or in between, weighted by the numbers of rays; surfaces too far apart to be mixed give the
/// one with more rays.
SimulatedScan take_scan(const RayCaster& world, const Scanner& scanner, const ScanPlan& plan);

/// The truth about point `i` of `scan`: whether what it shows was not there when `other` was taken.
bool is_truly_changed(const SimulatedScan& scan, std::size_t i, const SimulatedScan& other);

}  // namespace raywatch::simulator
