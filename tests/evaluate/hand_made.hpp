#pragma once

#include <chrono>
#include <initializer_list>
#include <string>
#include <vector>

#include "tests/simulator/simulated_scan.hpp"

/// Scans with labels but no geometry, for tests of how labels are scored.
namespace raywatch::evaluation {

struct HandMade {
  std::vector<simulator::StateId> labels;
  std::vector<simulator::StateId> present;
  int minute = 0;
  double x_m = 0.0;  ///< of the sensor
};

inline simulator::SimulatedScan hand_made_scan(const HandMade& given) {
  simulator::SimulatedScan scan;
  scan.labels = given.labels;
  scan.present = given.present;
  for (std::size_t i = 0; i < given.labels.size(); ++i) scan.points.push_back(static_cast<float>(i + 1), 0.0f, 0.0f);
  scan.captured_at = Time{} + std::chrono::minutes(given.minute);
  scan.reported_world_from_sensor.position_m.x() = given.x_m;
  return scan;
}

/// `count` times each label.
inline std::vector<simulator::StateId> repeated(std::initializer_list<std::pair<simulator::StateId, int>> runs) {
  std::vector<simulator::StateId> labels;
  for (const auto& [label, count] : runs) labels.insert(labels.end(), static_cast<std::size_t>(count), label);
  return labels;
}

}  // namespace raywatch::evaluation
