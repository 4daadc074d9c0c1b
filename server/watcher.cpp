#include "server/watcher.hpp"

#include <algorithm>
#include <string>

#include "core/look.hpp"
#include "core/sample_changes.hpp"
#include "core/zone.hpp"
#include "server/system_alerts.hpp"
#include "server/track_keeper.hpp"
#include "storage/baselines.hpp"
#include "storage/zones.hpp"

namespace raywatch {
namespace {

std::vector<Eigen::Vector3d> in_double(const std::vector<Eigen::Vector3f>& points_m) {
  std::vector<Eigen::Vector3d> result;
  for (const Eigen::Vector3f& p : points_m) result.push_back(p.cast<double>());
  return result;
}

/// The first control zone in which something changed.
std::optional<ZoneRecord> disturbed_zone(const Snapshot& snapshot, const WatchedComparison& watched) {
  for (const Zone& zone : zones_of(snapshot, watched.site.id)) {
    if (zone.kind != ZoneKind::control) continue;
    const bool disturbed =
        std::ranges::any_of(watched.changes, [&](const Change& change) { return lies_in(change, zone); });
    if (disturbed) return find_zone(snapshot, zone.id);
  }
  return std::nullopt;
}

/// Raises or settles what the scan itself shows about its sensor.
void report_scan(Transaction& transaction, const WatchedComparison& watched, WatchRole role, Time now) {
  const ScanRecord& scan = watched.scan;
  const std::string name = sensor_name(transaction, scan.sensor);
  const SystemSubject fits{.site = scan.site, .cause = "registration", .subject = name, .sensor = scan.sensor};
  if (role == WatchRole::misplaced) {
    raise_system_alert(transaction, fits,
                       {.severity = Severity::warning,
                        .scan = scan.id,
                        .at = now,
                        .title = "A scan of sensor " + name + " does not fit onto the others: it is not watched by."});
  } else if (role != WatchRole::learning) {
    settle_system_alert(transaction, fits, "A scan fits again.", scan.id, now);
  }
  const SystemSubject stands{.site = scan.site, .cause = "sensor-moved", .subject = name, .sensor = scan.sensor};
  if (scan.registration.state == RegistrationState::moved) {
    raise_system_alert(transaction, stands,
                       {.severity = Severity::warning,
                        .scan = scan.id,
                        .at = now,
                        .title = "Sensor " + name + " was moved or has tilted."});
  } else if (scan.registration.state == RegistrationState::good) {
    settle_system_alert(transaction, stands, "The sensor stands where it is said to.", scan.id, now);
  }
}

/// Told when two scans of a place in a row judge less than half of what its first ones did: it may be covered.
void report_coverage(Transaction& transaction, const WatchedComparison& watched, Time now) {
  constexpr std::size_t kFirst = 3, kLast = 2;
  constexpr double kLeastUsual = 0.1, kDropped = 0.5, kBack = 0.7;
  for (const Zone& zone : zones_of(transaction, watched.site.id)) {
    std::vector<double> first = first_coverage(transaction, zone.id, watched.scan.vantage, kFirst);
    const std::vector<double> last = last_coverage(transaction, zone.id, watched.scan.vantage, kLast);
    if (first.size() < kFirst) continue;
    std::ranges::sort(first);
    const double usual = first[kFirst / 2];
    const std::string name = find_zone(transaction, zone.id)->name;
    const SystemSubject subject{.site = watched.site.id,
                                .cause = "coverage-dropped",
                                .subject = name + " from " + std::to_string(watched.scan.vantage.value),
                                .zone = zone.id,
                                .sensor = watched.scan.sensor};
    if (usual >= kLeastUsual && std::ranges::all_of(last, [&](double share) { return share < kDropped * usual; })) {
      raise_system_alert(
          transaction, subject,
          {.severity = Severity::warning,
           .scan = watched.scan.id,
           .at = now,
           .title = "Sensor " + sensor_name(transaction, watched.scan.sensor) +
                    " sees less than half as much of zone " + name + " as usual: it may be covered or blocked."});
    } else if (last.front() >= kBack * usual) {
      settle_system_alert(transaction, subject, "It sees the zone again.", watched.scan.id, now);
    }
  }
}

void report_control_zones(Transaction& transaction, const WatchedComparison& watched, WatchRole role, Time now) {
  if (role != WatchRole::suspect && role != WatchRole::tracked) return;
  const std::optional<ZoneRecord> disturbed = disturbed_zone(transaction, watched);
  for (const Zone& zone : zones_of(transaction, watched.site.id)) {
    if (zone.kind != ZoneKind::control) continue;
    const std::string name = find_zone(transaction, zone.id)->name;
    const SystemSubject subject{.site = watched.site.id,
                                .cause = "control-zone",
                                .subject = name,
                                .zone = zone.id,
                                .sensor = watched.scan.sensor};
    if (disturbed && disturbed->zone.id == zone.id) {
      raise_system_alert(transaction, subject,
                         {.severity = Severity::warning,
                          .scan = watched.scan.id,
                          .at = now,
                          .title = "Something changed in the control zone " + name +
                                   ": the scan is suspect, and nothing is judged by it."});
    } else if (!disturbed) {
      settle_system_alert(transaction, subject, "Nothing is changed there any more.", watched.scan.id, now);
    }
  }
}

}  // namespace

SiteView Watcher::view_site(const Snapshot& snapshot, SiteId site) const {
  return {followed_tracks(snapshot, site), zones_of(snapshot, site)};
}

Glance Watcher::look(const SiteView& site, const ScanView& scan, std::span<const ScanView> priors,
                     const Comparison& comparison, const CompareParameters& parameters) const {
  Glance glance;
  glance.samples = sample_changes(scan, priors, comparison, config_.sample_points);
  for (const TrackRecord& record : site.tracks) {
    const std::vector<Eigen::Vector3d> places_m = in_double(record.track.sample_m);
    glance.sights[record.track.id] = sight_of(record.track.kind, look_at(scan, places_m, parameters));
  }
  for (const Zone& zone : site.zones) {
    const std::vector<Eigen::Vector3d> places_m = lattice_places(zone.prism, config_.coverage_places);
    glance.coverage.emplace_back(zone.id, judged_share(scan, places_m, parameters));
  }
  return glance;
}

bool Watcher::is_late(const Snapshot& snapshot, const ScanRecord& scan) const {
  const std::optional<Time> of_sensor = tracked_until(snapshot, scan.sensor);
  const std::optional<Time> of_site = tracked_until(snapshot, scan.site);
  return (of_sensor && scan.captured_at <= *of_sensor) ||
         (of_site && between(scan.captured_at, *of_site) > config_.late_tolerance);
}

WatchRole Watcher::role_of(const Snapshot& snapshot, const WatchedComparison& watched) const {
  const ScanRecord& scan = watched.scan;
  if (scan.registration.state == RegistrationState::bad) return WatchRole::misplaced;
  const std::vector<BaselineEntry> entries = baseline_of_vantage(snapshot, scan.site, scan.vantage);
  const bool begins = entries.empty() && watched.testable < config_.learn_below_testable;
  const bool goes_on =
      !entries.empty() && entries.size() < config_.learn_scans &&
      std::ranges::all_of(entries, [](const BaselineEntry& entry) { return entry.origin == BaselineOrigin::learned; });
  if (begins || goes_on) return WatchRole::learning;
  if (is_late(snapshot, scan)) return WatchRole::late;
  return disturbed_zone(snapshot, watched) ? WatchRole::suspect : WatchRole::tracked;
}

void Watcher::learn(Transaction& transaction, const WatchedComparison& watched, WatchRole role, Time now) const {
  const ScanRecord& scan = watched.scan;
  BaselineEdit edit{.by = "raywatch"};
  if (role == WatchRole::learning) {
    edit.kind = "learned";
    edit.note = "among the first scans of its vantage";
    edit.add = {{.scan = scan.id, .vantage = scan.vantage, .origin = BaselineOrigin::learned}};
  } else if (role == WatchRole::tracked && watched.changes.empty() &&
             baseline_of_vantage(transaction, scan.site, scan.vantage).empty()) {
    // What a new place shows beyond what is known is normal only as long as nothing there is not.
    edit.kind = "joined";
    edit.note = "the first scan of its vantage, and nothing in it had changed";
    edit.add = {{.scan = scan.id, .vantage = scan.vantage, .origin = BaselineOrigin::joined}};
  } else {
    return;
  }
  edit_baseline(transaction, scan.site, edit, now);
}

void Watcher::commit(Transaction& transaction, const WatchedComparison& watched, const Glance& glance, Time now) const {
  const ScanRecord& scan = watched.scan;
  WatchedScan turn{.scan = scan.id,
                   .site = scan.site,
                   .sensor = scan.sensor,
                   .vantage = scan.vantage,
                   .captured_at = scan.captured_at,
                   .role = role_of(transaction, watched)};
  learn(transaction, watched, turn.role, now);
  turn.turn = insert_watched_scan(transaction, turn);
  for (const auto& [zone, share] : glance.coverage) {
    if (find_zone(transaction, zone)) insert_coverage(transaction, zone, turn.turn, share);
  }
  report_scan(transaction, watched, turn.role, now);
  report_control_zones(transaction, watched, turn.role, now);
  if (turn.role != WatchRole::tracked) return;
  report_coverage(transaction, watched, now);
  TrackKeeper(transaction, watched, turn, glance, {.moved_within = config_.moved_within, .now = now}).run();
}

}  // namespace raywatch
