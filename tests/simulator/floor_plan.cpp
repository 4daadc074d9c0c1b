#include "tests/simulator/floor_plan.hpp"

#include <algorithm>

namespace raywatch::simulator {

bool FloorPlan::is_free(const Eigen::Vector2d& center_m, double radius_m) const {
  return std::ranges::none_of(
      taken_, [&](const Circle& circle) { return (circle.center_m - center_m).norm() < circle.radius_m + radius_m; });
}

std::optional<Eigen::Vector2d> FloorPlan::find(RandomSequence& random, double radius_m) const {
  constexpr int kTrials = 100;
  for (int i = 0; i < kTrials; ++i) {
    const double x = random.in({area_m_.min().x() + radius_m, area_m_.max().x() - radius_m});
    const double y = random.in({area_m_.min().y() + radius_m, area_m_.max().y() - radius_m});
    if (is_free({x, y}, radius_m)) return Eigen::Vector2d(x, y);
  }
  return std::nullopt;
}

std::optional<Eigen::Vector2d> FloorPlan::take(RandomSequence& random, double radius_m) {
  const auto place_m = find(random, radius_m);
  if (place_m) keep_free(*place_m, radius_m);
  return place_m;
}

}  // namespace raywatch::simulator
