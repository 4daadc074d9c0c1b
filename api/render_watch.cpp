#include "api/lookup.hpp"
#include "api/render.hpp"

namespace raywatch {
namespace {

Json render_polygon(const std::vector<Eigen::Vector2d>& polygon_m, const Eigen::Vector3d& origin_m) {
  Json corners = Json::array();
  for (const Eigen::Vector2d& p : polygon_m) corners.push_back({p.x() + origin_m.x(), p.y() + origin_m.y()});
  return corners;
}

Json render_box(const Eigen::AlignedBox3d& box, const Eigen::Vector3d& origin_m) {
  return {{"min", render(Eigen::Vector3d(box.min() + origin_m))},
          {"max", render(Eigen::Vector3d(box.max() + origin_m))}};
}

Json render_schedule(const Schedule& schedule) {
  Json windows = Json::array();
  for (const ScheduleWindow& window : schedule) {
    Json days = Json::array();
    for (std::size_t day = 0; day < window.days.size(); ++day) {
      if (window.days[day]) days.push_back(weekday_name(day));
    }
    windows.push_back({{"days", std::move(days)},
                       {"from", format_minute_of_day(window.from_minute)},
                       {"to", format_minute_of_day(window.to_minute)}});
  }
  return windows;
}

/// The name of a sensor, unless it was deleted.
Json sensor_or_null(const Snapshot& snapshot, const std::optional<SensorId>& id) {
  if (!id) return nullptr;
  const std::optional<Sensor> sensor = find_sensor(snapshot, *id);
  return sensor ? Json(sensor->name) : Json(nullptr);
}

Json site_or_null(const Snapshot& snapshot, const std::optional<SiteId>& id) {
  if (!id) return nullptr;
  const std::optional<Site> site = find_site(snapshot, *id);
  return site ? Json(site->name) : Json(nullptr);
}

}  // namespace

Json render(const Snapshot& snapshot, const ZoneRecord& record) {
  const Site site = site_with(snapshot, record.site);
  const Eigen::Vector3d origin_m = origin_of(site);
  const Prism& prism = record.zone.prism;
  return {{"id", record.zone.id.value},
          {"site", site.name},
          {"name", record.name},
          {"kind", to_string(record.zone.kind)},
          {"polygon_m", render_polygon(prism.polygon_m, origin_m)},
          {"z_min_m", prism.z_min_m + origin_m.z()},
          {"z_max_m", prism.z_max_m + origin_m.z()},
          {"created_at", format_rfc3339(record.created_at)},
          {"edited_at", format_rfc3339(record.edited_at)}};
}

Json render(const ZoneCoverage& coverage) {
  return {{"scan", coverage.scan.value},
          {"vantage", coverage.vantage.value},
          {"captured_at", format_rfc3339(coverage.captured_at)},
          {"share", coverage.share}};
}

Json render_rule_body(const Rule& rule) {
  Json kinds = Json::array();
  if (rule.added) kinds.push_back("added");
  if (rule.removed) kinds.push_back("removed");
  const Persistence& p = rule.persistence;
  return {{"zone", id_or_null(rule.zone)},
          {"kinds", std::move(kinds)},
          {"min_points", rule.min_points},
          {"min_volume_m3", rule.min_volume_m3},
          {"min_extent_m", rule.min_extent_m},
          {"persistence", {{"scans", p.scans}, {"of", p.of}, {"seconds", p.seconds}}},
          {"severity", to_string(rule.severity)},
          {"schedule", render_schedule(rule.schedule)},
          {"enabled", rule.enabled},
          {"auto_resolve", rule.auto_resolve}};
}

Json render(const Snapshot& snapshot, const RuleRecord& record) {
  Json json = {{"id", record.rule.id.value}, {"site", site_with(snapshot, record.site).name}, {"name", record.name}};
  json.update(render_rule_body(record.rule));
  json["created_at"] = format_rfc3339(record.created_at);
  json["edited_at"] = format_rfc3339(record.edited_at);
  return json;
}

Json render(const Snapshot& snapshot, const SilenceRecord& record) {
  return {{"id", record.id.value},
          {"site", site_with(snapshot, record.site).name},
          {"zone", id_or_null(record.silence.zone)},
          {"sensor", sensor_or_null(snapshot, record.silence.sensor)},
          {"from", format_rfc3339(record.silence.from)},
          {"until", format_rfc3339(record.silence.until)},
          {"by", record.by},
          {"note", record.note},
          {"created_at", format_rfc3339(record.created_at)}};
}

Json render(const Snapshot& snapshot, const TrackRecord& record) {
  const Site site = site_with(snapshot, record.site);
  const Track& track = record.track;
  Json json = {{"id", track.id.value},
               {"site", site.name},
               {"state", to_string(track.state)},
               {"first_seen_at", format_rfc3339(track.first_seen_at)},
               {"last_seen_at", format_rfc3339(track.last_seen_at)},
               {"ended_at", render(track.ended_at)},
               {"first_scan", record.first_scan.value},
               {"last_scan", record.last_scan.value},
               {"ended_scan", id_or_null(record.ended_scan)},
               {"seen", track.seen},
               {"absent", track.absent},
               {"latest_change", record.latest_change.value},
               {"moved_from", id_or_null(record.moved_from)},
               {"moved_to", id_or_null(record.moved_to)}};
  json.update(render_figures(track.latest, origin_of(site)));
  return json;
}

Json render(const SightRun& run) {
  return {
      {"sight", to_string(run.sight)},      {"vantage", run.vantage.value},     {"scans", run.scans},
      {"first_scan", run.first_scan.value}, {"last_scan", run.last_scan.value}, {"from", format_rfc3339(run.first_at)},
      {"to", format_rfc3339(run.last_at)}};
}

Json render(const Snapshot& snapshot, const AlertRecord& alert) {
  return {{"id", alert.id.value},
          {"site", site_with(snapshot, alert.site).name},
          {"cause", alert.cause},
          {"title", alert.title},
          {"state", to_string(alert.state)},
          {"severity", to_string(alert.severity)},
          {"track", id_or_null(alert.track)},
          {"rule", id_or_null(alert.rule)},
          {"zone", id_or_null(alert.zone)},
          {"sensor", sensor_or_null(snapshot, alert.sensor)},
          {"scan", id_or_null(alert.scan)},
          {"opened_at", format_rfc3339(alert.opened_at)},
          {"edited_at", format_rfc3339(alert.edited_at)},
          {"snoozed_until", render(alert.snoozed_until)}};
}

Json render(const AlertHistoryStep& step) {
  return {{"at", format_rfc3339(step.at)},  {"by", step.by},
          {"action", step.action},          {"note", step.note},
          {"state", to_string(step.state)}, {"severity", to_string(step.severity)},
          {"scan", id_or_null(step.scan)}};
}

Json render(const Snapshot& snapshot, const BaselineVersion& version) {
  const Site site = site_with(snapshot, version.site);
  Json entries = Json::array();
  for (const BaselineEntry& entry : baseline_entries(snapshot, version.site, version.version)) {
    entries.push_back({{"scan", entry.scan.value},
                       {"vantage", entry.vantage.value},
                       {"origin", to_string(entry.origin)},
                       {"region_m", entry.region_m ? render_box(*entry.region_m, origin_of(site)) : Json(nullptr)}});
  }
  return {{"site", site.name},
          {"version", version.version},
          {"kind", version.kind},
          {"made_at", format_rfc3339(version.made_at)},
          {"by", version.by},
          {"note", version.note},
          {"entries", std::move(entries)}};
}

Json render(const Snapshot& snapshot, const Event& event) {
  return {{"id", event.id.value},
          {"at", format_rfc3339(event.at)},
          {"type", event.type},
          {"site", site_or_null(snapshot, event.site)},
          {"scan", id_or_null(event.scan)},
          {"comparison", id_or_null(event.comparison)},
          {"track", id_or_null(event.track)},
          {"alert", id_or_null(event.alert)},
          {"zone", id_or_null(event.zone)},
          {"rule", id_or_null(event.rule)},
          {"sensor", sensor_or_null(snapshot, event.sensor)},
          {"text", event.text}};
}

Json render(const Snapshot& snapshot, const DeletionRecord& deletion) {
  return {{"id", deletion.id},
          {"at", format_rfc3339(deletion.at)},
          {"what", deletion.what},
          {"reason", to_string(deletion.reason)},
          {"site", site_or_null(snapshot, deletion.site)},
          {"sensor", sensor_or_null(snapshot, deletion.sensor)},
          {"scan", id_or_null(deletion.scan)},
          {"captured_at", render(deletion.captured_at)},
          {"received_at", render(deletion.received_at)},
          {"records", deletion.records},
          {"bytes", deletion.bytes}};
}

}  // namespace raywatch
