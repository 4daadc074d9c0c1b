#include "tests/evaluate/testable.hpp"

#include <numbers>

namespace raywatch::evaluation {
double testing_angle_rad(const ScanView& asked) {
  constexpr double kAnglePerSpacing = 1.5;
  constexpr double kFallbackSpacing_rad = std::numbers::pi / 180.0;
  const auto& resolution_rad = asked.sensor.angular_resolution_rad;
  return kAnglePerSpacing * (resolution_rad ? resolution_rad->maxCoeff() : kFallbackSpacing_rad);
}

std::vector<std::uint8_t> testable_points(const ScanView& view, std::span<const ScanView> others) {
  constexpr double kBehind_m = 0.05;
  const std::vector<std::uint8_t> all(view.points.size(), 1);
  std::vector<std::uint8_t> testable(view.points.size(), 0);
  std::vector<Answer> answers(view.points.size());
  for (const ScanView& other : others) {
    ask(other.index, view.points, all, other.world_from_sensor.inverse() * view.world_from_sensor,
        {testing_angle_rad(other), kBehind_m}, answers);
    for (std::size_t i = 0; i < answers.size(); ++i) {
      testable[i] |= answers[i] != Answer::unseen && answers[i] != Answer::occluded;
    }
  }
  return testable;
}

}  // namespace raywatch::evaluation
