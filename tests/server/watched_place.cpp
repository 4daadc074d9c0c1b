#include "tests/server/watched_place.hpp"

#include <algorithm>

#include "core/profile.hpp"
#include "storage/events.hpp"
#include "tests/simulator/simulated_scan.hpp"
#include "tests/simulator/wall_and_box.hpp"

namespace raywatch {
namespace {

using namespace simulator;

Scene scene_of(const WatchedScene& state) {
  WallAndBox layout{.wall_distance_m = 10.0};
  if (state.box_y_m) layout.box_center_m = Eigen::Vector3d(5.0, *state.box_y_m, 0.0);
  Scene scene = wall_and_box(layout);
  if (state.person_y_m) {
    scene.add(Box{{Eigen::Quaterniond::Identity(), {7.0, *state.person_y_m, 0.0}}, {0.3, 0.3, 0.9}}, 2);
  }
  if (state.screen) scene.add(Box{{Eigen::Quaterniond::Identity(), {2.5, 0.0, 0.0}}, {0.05, 0.6, 0.6}}, 3);
  return scene;
}

PointCloud points_of(const WatchedScene& state, int number) {
  Scanner scanner = grid_scanner({.lowest_elevation_rad = radians(-20.0), .highest_elevation_rad = radians(20.0)});
  scanner.max_range_m = 20.0;
  scanner.errors.range_noise_m = 0.005;
  return take_scan(RayCaster(scene_of(state)), scanner, exact_plan({}, static_cast<std::uint64_t>(number))).points;
}

CompareParameters parameters() {
  CompareParameters result = default_parameters(Profile::indoor, Grouping::consensus);
  result.cluster_distance_m = 0.3;  // steps of one degree are coarse
  return result;
}

}  // namespace

WatchedPlace::WatchedPlace(const WatchConfig& watch) : watched_({.watch = watch, .parameters = parameters()}) {}

ScanId WatchedPlace::take(const WatchedScene& scene, const std::string& sensor) {
  const ScanId id = take_at({}, scene, sensor);
  watched_.set_now(now() + std::chrono::minutes(1));
  return id;
}

ScanId WatchedPlace::take_at(Duration offset, const WatchedScene& scene, const std::string& sensor) {
  return watched_.put({.sensor = sensor,
                       .points = points_of(scene, ++number_),
                       .world_from_sensor = {},
                       .captured_at = now() + offset});
}

std::vector<BaselineEntry> WatchedPlace::baseline() const {
  return store().read([&](const Snapshot& s) -> std::vector<BaselineEntry> {
    const auto latest = latest_baseline(s, site());
    if (!latest) return {};
    return baseline_entries(s, site(), latest->version);
  });
}

std::vector<std::string> WatchedPlace::events() const {
  std::vector<std::string> types;
  for (const Event& event : store().read([&](const Snapshot& s) { return events_after(s, {}, site(), 100'000); })) {
    types.push_back(event.type);
  }
  return types;
}

WatchRole WatchedPlace::role(ScanId scan) const {
  return store().read([&](const Snapshot& s) { return find_watched_scan(s, scan).value().role; });
}

std::vector<ChangeRecord> WatchedPlace::watching_changes() const {
  return store()
      .read([&](const Snapshot& s) {
        return list_changes(s, {.site = site(), .watching = true}, {.limit = 1000, .cursor = {}});
      })
      .items;
}

}  // namespace raywatch
