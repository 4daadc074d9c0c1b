#include <algorithm>
#include <map>

#include "api/call.hpp"
#include "api/endpoints/endpoints.hpp"
#include "api/lookup.hpp"
#include "api/render.hpp"
#include "storage/place_sights.hpp"

namespace raywatch::endpoints {
namespace {

/// So many scans are looked through at most, the latest ones.
constexpr std::size_t kMostScans = 20'000;

/// The latest scans of a time range, oldest first.
std::vector<ScanRecord> scans_of(const Snapshot& snapshot, const ScanFilter& filter) {
  PageRequest page{.limit = 1000, .cursor = {}};
  std::vector<ScanRecord> scans;
  do {
    Page<ScanRecord> next = list_scans(snapshot, filter, page);
    scans.insert(scans.end(), next.items.begin(), next.items.end());
    page.cursor = next.next;
  } while (page.cursor && scans.size() < kMostScans);
  std::ranges::reverse(scans);
  return scans;
}

/// The scans, and what is known of each one's sensor.
struct HistoryScans {
  Site site;
  std::vector<ScanRecord> scans;
  std::map<SensorId, SensorModel> known;
};

HistoryScans read_scans(const Snapshot& snapshot, const std::string& site_name, ScanFilter filter) {
  HistoryScans read{.site = site_named(snapshot, site_name), .scans = {}, .known = {}};
  filter.site = read.site.id;
  read.scans = scans_of(snapshot, filter);
  for (const ScanRecord& scan : read.scans) {
    if (!read.known.contains(scan.sensor)) read.known[scan.sensor] = find_sensor(snapshot, scan.sensor).value().known;
  }
  return read;
}

Json render_interval(const PlaceInterval& interval) {
  return {{"state", to_string(interval.presence)}, {"from", format_rfc3339(interval.from)},
          {"to", format_rfc3339(interval.to)},     {"first_scan", interval.first_scan.value},
          {"last_scan", interval.last_scan.value}, {"scans", interval.scans},
          {"not_seen", interval.not_seen}};
}

}  // namespace

HttpAnswer get_history(Call& call) {
  call.query.require("site");
  const auto site_name = call.query.text("site");
  const auto point_m = call.query.vector3("point");
  const auto box_m = call.query.box("box");
  ScanFilter filter;
  const TimeRange range = call.query.time_range();
  filter.from = range.from;
  filter.to = range.to;
  if (call.query.has("point") == call.query.has("box")) {
    call.query.fail("point",
                    call.query.has("box") ? "give 'point' or 'box', not both" : "must be given, or else 'box'");
  }
  if (box_m && (box_m->sizes().array() <= 0.0).any()) call.query.fail("box", "must have some size");
  call.query.finish();

  const HistoryScans read =
      call.services.store.read([&](const Snapshot& snapshot) { return read_scans(snapshot, *site_name, filter); });
  const Eigen::Vector3d origin_m = origin_of(read.site);
  const PlaceQuestion question = point_m ? question_at(*point_m - origin_m) : question_in(box_m->translated(-origin_m));
  const std::vector<PlaceSight> sights =
      sights_of(call.services.store.payloads(), read.site, read.scans, read.known, question);
  Json intervals = Json::array();
  for (const PlaceInterval& interval : intervals_of(sights)) intervals.push_back(render_interval(interval));
  return json_answer({{"site", read.site.name},
                      {"scans", sights.size()},
                      {"complete", sights.size() < kMostScans},
                      {"intervals", std::move(intervals)}});
}

}  // namespace raywatch::endpoints
