#include "tests/server/watched_place.hpp"

#include <algorithm>

#include "core/panorama.hpp"
#include "core/profile.hpp"
#include "storage/events.hpp"
#include "storage/payloads.hpp"
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

WatchedPlace::WatchedPlace(const WatchConfig& watch)
    : store_({.data_dir = folder_.path()}),
      runner_(store_, cache_, progress_, {.previous_limit = std::chrono::hours(24), .watch = watch},
              [this] { return now(); }) {
  site_ = store_.write([&](Transaction& transaction) {
    const SiteId site =
        insert_site(transaction, {.name = "yard", .time_zone = "UTC", .origin_m = Eigen::Vector3d::Zero()}, now()).id;
    insert_rule(transaction, default_rule(site, Profile::indoor), now());
    return site;
  });
}

Time WatchedPlace::now() const { return parse_rfc3339("2026-03-01T08:00:00Z") + std::chrono::minutes(minute_); }

SensorId WatchedPlace::sensor_named(const std::string& name) {
  return store_.write([&](Transaction& transaction) {
    if (const auto sensor = find_sensor(transaction, name)) return sensor->id;
    return insert_sensor(transaction, {.name = name, .site = site_}, now()).id;
  });
}

ScanId WatchedPlace::take(const WatchedScene& scene, const std::string& sensor) {
  const ScanId id = take_at({}, scene, sensor);
  ++minute_;
  return id;
}

ScanId WatchedPlace::take_at(Duration offset, const WatchedScene& scene, const std::string& sensor) {
  const PointCloud points = points_of(scene, ++number_);
  ScanRecord record{.site = site_, .sensor = sensor_named(sensor)};
  record.captured_at = now() + offset;
  record.received_at = now();
  record.points = points.size();
  record.sha256 = std::to_string(number_);
  record.estimated = estimate_sensor(points);
  record.payload = store_.payloads().put_scan(site_, record.captured_at, points, make_panorama(points, UsableRange{}));
  const ScanId id = store_.write([&](Transaction& transaction) {
    const ScanId scan = insert_scan(transaction, record).id;
    insert_comparison(transaction, scan, PreviousReference{}, parameters(), now());
    insert_comparison(transaction, scan, BaselineReference{}, parameters(), now(), Watching::yes);
    return scan;
  });
  run_jobs();
  return id;
}

void WatchedPlace::run_jobs() {
  for (;;) {
    const auto job = store_.write([&](Transaction& transaction) { return start_job(transaction, site_); });
    if (!job) return;
    runner_.run(*job, arena_);
  }
}

std::vector<TrackRecord> WatchedPlace::tracks() const {
  auto page = store_.read([&](const Snapshot& s) { return list_tracks(s, {.site = site_}, {.limit = 1000}); });
  std::ranges::reverse(page.items);
  return std::move(page.items);
}

std::vector<AlertRecord> WatchedPlace::alerts() const {
  auto page = store_.read([&](const Snapshot& s) { return list_alerts(s, {.site = site_}, {.limit = 1000}); });
  std::ranges::reverse(page.items);
  return std::move(page.items);
}

std::vector<BaselineEntry> WatchedPlace::baseline() const {
  return store_.read([&](const Snapshot& s) -> std::vector<BaselineEntry> {
    const auto latest = latest_baseline(s, site_);
    if (!latest) return {};
    return baseline_entries(s, site_, latest->version);
  });
}

std::vector<std::string> WatchedPlace::events() const {
  std::vector<std::string> types;
  for (const Event& event : store_.read([&](const Snapshot& s) { return events_after(s, {}, site_, 100'000); })) {
    types.push_back(event.type);
  }
  return types;
}

WatchRole WatchedPlace::role(ScanId scan) const {
  return store_.read([&](const Snapshot& s) { return find_watched_scan(s, scan).value().role; });
}

std::vector<ChangeRecord> WatchedPlace::watching_changes() const {
  return store_
      .read([&](const Snapshot& s) {
        return list_changes(s, {.site = site_, .watching = true}, {.limit = 1000, .cursor = {}});
      })
      .items;
}

}  // namespace raywatch
