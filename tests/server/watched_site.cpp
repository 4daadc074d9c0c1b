#include "tests/server/watched_site.hpp"

#include <algorithm>

#include "core/panorama.hpp"
#include "storage/payloads.hpp"
#include "storage/rules.hpp"
#include "storage/sensors.hpp"

namespace raywatch {
namespace {

/// All of them, page by page, oldest first.
template <class List>
auto oldest_first(const List& list) {
  auto page = list(PageRequest{.limit = 1000});
  auto all = std::move(page.items);
  while (page.next) {
    page = list(PageRequest{.limit = 1000, .cursor = *page.next});
    std::ranges::move(page.items, std::back_inserter(all));
  }
  std::ranges::reverse(all);
  return all;
}

}  // namespace

WatchedSite::WatchedSite(const WatchedSiteConfig& config)
    : store_({.data_dir = folder_.path()}),
      config_(config),
      now_(parse_rfc3339("2026-03-01T08:00:00Z")),
      cache_(config.cache_bytes),
      runner_(store_, cache_, progress_, {.previous_limit = std::chrono::hours(24), .watch = config.watch},
              [this] { return now_; }) {
  site_ = store_.write([&](Transaction& transaction) {
    const SiteId site =
        insert_site(
            transaction,
            {.name = "yard", .time_zone = "UTC", .profile = config.profile, .origin_m = Eigen::Vector3d::Zero()}, now_)
            .id;
    insert_rule(transaction, default_rule(site, config.profile), now_);
    return site;
  });
}

SensorId WatchedSite::sensor_of(const TakenScan& scan) {
  return store_.write([&](Transaction& transaction) {
    if (const auto sensor = find_sensor(transaction, scan.sensor)) return sensor->id;
    Sensor sensor{.name = scan.sensor, .site = site_};
    if (config_.sensors_are_fixed) sensor.pose = scan.world_from_sensor;
    return insert_sensor(transaction, sensor, now_).id;
  });
}

ScanId WatchedSite::put(const TakenScan& scan) {
  ScanRecord record{.site = site_, .sensor = sensor_of(scan)};
  record.pose = scan.world_from_sensor;
  record.captured_at = scan.captured_at;
  record.received_at = now_;
  record.points = scan.points.size();
  record.sha256 = std::to_string(++number_);
  record.estimated = estimate_sensor(scan.points);
  record.payload =
      store_.payloads().put_scan(site_, record.captured_at, scan.points, make_panorama(scan.points, UsableRange{}));
  const ScanId id = store_.write([&](Transaction& transaction) {
    const ScanId stored = insert_scan(transaction, record).id;
    insert_comparison(transaction, stored, PreviousReference{}, config_.parameters, now_);
    insert_comparison(transaction, stored, BaselineReference{}, config_.parameters, now_, Watching::yes);
    return stored;
  });
  run_jobs();
  return id;
}

void WatchedSite::run_jobs() {
  for (;;) {
    const auto job = store_.write([&](Transaction& transaction) { return start_job(transaction, site_); });
    if (!job) return;
    runner_.run(*job, arena_);
  }
}

std::vector<TrackRecord> WatchedSite::tracks() const {
  return oldest_first([this](const PageRequest& page) {
    return store_.read([&](const Snapshot& s) { return list_tracks(s, {.site = site_}, page); });
  });
}

std::vector<AlertRecord> WatchedSite::alerts() const {
  return oldest_first([this](const PageRequest& page) {
    return store_.read([&](const Snapshot& s) { return list_alerts(s, {.site = site_}, page); });
  });
}

}  // namespace raywatch
