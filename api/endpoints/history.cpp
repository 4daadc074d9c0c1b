#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "api/call.hpp"
#include "api/endpoints/endpoints.hpp"
#include "api/lookup.hpp"
#include "api/render.hpp"
#include "core/look.hpp"
#include "core/place_history.hpp"
#include "core/profile.hpp"
#include "core/zone.hpp"
#include "storage/payloads.hpp"

namespace raywatch::endpoints {
namespace {

/// So many scans are looked through at most, the latest ones; and so many places in a box.
constexpr std::size_t kMostScans = 20'000, kPlacesInBox = 27;

/// What is asked: places in the local frame, within a ball.
struct PlaceQuestion {
  std::vector<Eigen::Vector3d> places_m;
  Eigen::Vector3d center_m;
  double radius_m = 0.0;
};

PlaceQuestion question_of(const Eigen::AlignedBox3d& box) {
  const Eigen::Vector3d low = box.min(), high = box.max();
  const Prism prism{
      {{low.x(), low.y()}, {high.x(), low.y()}, {high.x(), high.y()}, {low.x(), high.y()}}, low.z(), high.z()};
  return {lattice_places(prism, kPlacesInBox), box.center(), 0.5 * box.diagonal().norm()};
}

/// What a scan shows of the places, from those of its chunks whose bounds meet the ball.
Presence presence_in(const Payloads& payloads, const ScanRecord& scan, const Site& site, const SensorModel& model,
                     const PlaceQuestion& question) {
  const CompareParameters parameters = default_parameters(site.profile, Grouping::consensus);
  const Thresholds thresholds = look_thresholds(model, parameters);
  const Pose sensor_from_local = local_pose(scan, site).inverse();
  const Eigen::Vector3d center_m = sensor_from_local * question.center_m;
  const double distance_m = center_m.norm();
  if (!(distance_m > 0.0)) return Presence::not_seen;
  const double ball_rad = distance_m > question.radius_m ? std::asin(question.radius_m / distance_m) : std::numbers::pi;
  const double cone_rad = std::min(std::numbers::pi, ball_rad + thresholds.angle_rad);
  std::vector<PointCloud> returns;
  for (PointRun& run : payloads.scan_points_around(scan.payload, {center_m, cone_rad})) {
    returns.push_back(std::move(run.points));
  }
  std::vector<Answer> answers;
  for (const Eigen::Vector3d& place_m : question.places_m) {
    answers.push_back(ask_returns(returns, usable_range(model, parameters), sensor_from_local * place_m, thresholds));
  }
  return presence_of(answers);
}

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
  filter.from = call.query.time("from");
  filter.to = call.query.time("to");
  if (call.query.has("point") == call.query.has("box")) call.query.fail("point", "must be given, or else 'box'");
  if (box_m && (box_m->sizes().array() <= 0.0).any()) call.query.fail("box", "must have some size");
  call.query.finish();

  const HistoryScans read =
      call.services.store.read([&](const Snapshot& snapshot) { return read_scans(snapshot, *site_name, filter); });
  const Eigen::Vector3d origin_m = origin_of(read.site);
  const PlaceQuestion question = point_m ? PlaceQuestion{{*point_m - origin_m}, *point_m - origin_m, 0.0}
                                         : question_of(box_m->translated(-origin_m));
  const Payloads& payloads = call.services.store.payloads();
  std::vector<PlaceSight> sights;
  for (const ScanRecord& scan : read.scans) {
    const SensorModel model = merged(read.known.at(scan.sensor), scan.estimated);
    sights.push_back({scan.id, scan.captured_at, presence_in(payloads, scan, read.site, model, question)});
  }
  Json intervals = Json::array();
  for (const PlaceInterval& interval : intervals_of(sights)) intervals.push_back(render_interval(interval));
  return json_answer({{"site", read.site.name},
                      {"scans", sights.size()},
                      {"complete", sights.size() < kMostScans},
                      {"intervals", std::move(intervals)}});
}

}  // namespace raywatch::endpoints
