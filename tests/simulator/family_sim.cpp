#include "tests/simulator/floor_plan.hpp"
#include "tests/simulator/story.hpp"

namespace raywatch::simulator {
namespace {

constexpr double kHalfRoom_m = 50.0;
constexpr std::size_t kPoses = 4;

std::vector<Lookout> lookouts(RandomSequence& random) {
  std::vector<Lookout> result;
  for (const double x : {-25.0, 25.0}) {
    for (const double y : {-25.0, 25.0}) {
      const double height_m = random.in({8.0, 20.0});
      const double yaw_rad = random.in({-std::numbers::pi, std::numbers::pi});
      result.push_back({.sensor = "sim-" + std::to_string(result.size() + 1),
                        .nominal_world_from_sensor = Viewpoint{{x, y, height_m}, yaw_rad}.pose()});
    }
  }
  return result;
}

/// A box of 4 to 12 m with room around it, or nothing when the floor is full.
std::optional<Shapes> another_box(RandomSequence& random, FloorPlan& floor) {
  const double length_m = random.in({4.0, 12.0});
  const double width_m = random.in({4.0, 12.0});
  const Eigen::Vector3d size_m(length_m, width_m, random.in({4.0, 12.0}));
  const auto place_m = floor.take(random, 0.5 * size_m.head<2>().norm());
  if (!place_m) return std::nullopt;
  return placed(box(size_m), {{place_m->x(), place_m->y(), 0.0}, random.in({0.0, std::numbers::pi})});
}

}  // namespace

Timeline sim_timeline(const FamilyOptions& options) {
  RandomSequence random(options.seed);
  Timeline timeline;
  timeline.scanners = {grid_scanner({.step_rad = 2.0 * std::numbers::pi / steps_at_density(360, options.density)})};
  const Eigen::Vector3d center_m(0.0, 0.0, kHalfRoom_m);
  timeline.background = {Room{{Eigen::Quaterniond::Identity(), center_m}, Eigen::Vector3d::Constant(kHalfRoom_m)}};

  const std::vector<Lookout> views = lookouts(random);
  const Eigen::Vector2d corner_m = Eigen::Vector2d::Constant(kHalfRoom_m - 1.0);
  FloorPlan floor({-corner_m, corner_m});
  for (const Lookout& view : views) floor.keep_free(view.nominal_world_from_sensor.position_m.head<2>(), 4.0);
  const int furniture = options.hard ? 12 : 4;
  for (int i = 0; i < furniture; ++i) {
    if (const auto shapes = another_box(random, floor)) append(timeline, *shapes);
  }

  std::vector<StateId> present;
  const auto add_box = [&] {
    const std::string name = "box " + std::to_string(timeline.objects.size() + 1);
    if (const auto shapes = another_box(random, floor)) present.push_back(add_object(timeline, {name, "box", *shapes}));
  };
  add_box();
  add_box();
  const std::uint32_t scans = options.scans.value_or(2 * kPoses);
  for (std::uint32_t i = 0; i < scans; ++i) {
    if (i > 0 && i % kPoses == 0) {
      // Each epoch one box goes and two come, or only one while there is plenty.
      if (!present.empty()) present.erase(present.begin() + static_cast<std::ptrdiff_t>(random.below(present.size())));
      add_box();
      if (present.size() < 4) add_box();
    }
    const Duration since_start =
        std::chrono::hours(1) * (i / kPoses) + options.interval.value_or(std::chrono::minutes(1)) * (i % kPoses);
    append_scan(timeline, options,
                {.lookout = views[i % kPoses], .captured_at = start_of(options) + since_start, .present = present});
  }
  return timeline;
}

}  // namespace raywatch::simulator
