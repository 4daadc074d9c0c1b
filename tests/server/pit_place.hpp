#pragma once

#include <algorithm>
#include <map>

#include "server/schedule_clock.hpp"
#include "server/survey_runner.hpp"
#include "storage/alerts.hpp"
#include "storage/payloads.hpp"
#include "storage/sensors.hpp"
#include "storage/survey_series.hpp"
#include "storage/surveys.hpp"
#include "storage/zones.hpp"
#include "tests/simulator/family.hpp"
#include "tests/support/temp_dir.hpp"

namespace raywatch {

inline constexpr std::size_t kStations = 2;
inline const Time kFirst = parse_rfc3339("2026-03-26T02:00:00Z");

inline SurveyDefinition definition_of(ZoneId zone) {
  SurveyDefinition definition{.zones = {zone}, .cell_m = 2.0, .core_spacing_m = 4.0, .density_t_per_m3 = 2.65};
  definition.thresholds = {
      {.figure = SurveyFigure::cut_m3, .zone = zone, .thresholds = {.yellow = 10.0, .orange = 20.0, .red = 1e6}},
      {.figure = SurveyFigure::net_m3, .zone = {}, .thresholds = {.yellow = 1e6}}};
  return definition;
}

/// The site "pit" with the zone "bench", and the schedule "nightly", at 8:00 in Berlin.
class PitPlace {
 public:
  PitPlace() {
    store_.write([&](Transaction& t) {
      site_ = insert_site(t,
                          {.name = "pit",
                           .time_zone = "Europe/Berlin",
                           .profile = Profile::survey,
                           .origin_m = Eigen::Vector3d::Zero()},
                          now_);
      const simulator::TrueGround& ground = timeline_.ground;
      const Eigen::Vector2d low = ground.corner_m;
      const Eigen::Vector2d high = low + ground.cell_m * Eigen::Vector2d(ground.columns, ground.rows);
      ZoneRecord zone{.zone = {.id = {},
                               .kind = ZoneKind::volume,
                               .prism = {{low, {high.x(), low.y()}, high, {low.x(), high.y()}}, -1.0, 40.0}},
                      .site = site_.id,
                      .name = "bench"};
      zone_ = insert_zone(t, zone, now_).zone.id;
      for (const char* name : {"pit-1", "pit-2"}) {
        sensors_[name] = insert_sensor(t, {.name = name, .site = site_.id}, now_).id;
      }
      ScheduleRecord schedule;
      schedule.site = site_.id;
      schedule.name = "nightly";
      schedule.plan = {.cron = "0 8 * * *", .time_zone = "Europe/Berlin", .window = std::chrono::hours(6)};
      schedule.plan.required_sensors = {sensors_["pit-1"], sensors_["pit-2"]};
      schedule.plan.definition = definition_of(zone_);
      schedule.looked_until = now_;
      schedule_ = insert_schedule(t, schedule, now_).id;
    });
  }

  /// The scans of a night arrive, registered as well as `state` says.
  void take_night(std::size_t night, std::size_t stations = kStations,
                  RegistrationState state = RegistrationState::good) {
    for (std::size_t k = 0; k < stations; ++k) {
      const simulator::SimulatedScan scan = take_scan(timeline_, timeline_.moments.at(kStations * night + k));
      ScanRecord record{.site = site_.id, .sensor = sensors_.at(scan.sensor)};
      record.captured_at = record.received_at = scan.captured_at;
      record.points = scan.points.size();
      record.sha256 = std::to_string(night) + "/" + std::to_string(k);
      record.pose = scan.reported_world_from_sensor;
      record.estimated = estimate_sensor(scan.points);
      record.payload = store_.payloads().put_scan(site_.id, scan.captured_at, scan.points,
                                                  make_panorama(scan.points, UsableRange{}));
      store_.write([&](Transaction& t) {
        const ScanId id = insert_scan(t, record).id;
        set_registration(t, id,
                         {.state = state,
                          .correction = {},
                          .residual_m = 0.01,
                          .inliers = 1.0,
                          .against = {},
                          .uncertainty = PoseUncertainty{.position_m = 0.005, .angle_rad = 2e-5}});
        set_scan_state(t, id, ScanState::compared);
      });
    }
  }

  /// The clock goes on, minute by minute where it matters.
  void go_to(Time moment) {
    for (; now_ < moment; now_ = std::min<Time>(moment, now_ + std::chrono::minutes(17))) work();
    work();
  }

  std::vector<RunRecord> runs() {
    auto page = store_.read([&](const Snapshot& s) { return list_runs(s, {.site = {}, .schedule = schedule_}, {}); });
    std::ranges::reverse(page.items);
    return page.items;
  }
  std::vector<std::pair<std::string, AlertState>> alerts() {
    auto page = store_.read([&](const Snapshot& s) { return list_alerts(s, {.site = site_.id, .state = {}}, {}); });
    std::ranges::reverse(page.items);
    std::vector<std::pair<std::string, AlertState>> result;
    for (const AlertRecord& alert : page.items) result.emplace_back(alert.cause, alert.state);
    return result;
  }
  SurveyResult survey(SurveyId id) {
    SurveyResult result = store_.read([&](const Snapshot& s) { return survey_result(s, id); });
    const auto record = store_.read([&](const Snapshot& s) { return find_survey(s, id).value(); });
    read_models(store_.payloads(), record.models, result);
    return result;
  }
  /// The true net, over cells that `counts` chooses.
  template <class Counts>
  double true_net_m3(std::size_t before, std::size_t after, Counts counts) const {
    const simulator::TrueGround& ground = timeline_.ground;
    double net_m3 = 0.0;
    for (std::size_t cell = 0; cell < ground.mean_height_m[before].size(); ++cell) {
      if (!counts(cell)) continue;
      const double rise_m = ground.mean_height_m[after][cell] - ground.mean_height_m[before][cell];
      net_m3 += ground.cell_m * ground.cell_m * rise_m;
    }
    return net_m3;
  }
  Store& store() { return store_; }
  IndexCache& cache() { return cache_; }
  tbb::task_arena& arena() { return arena_; }
  /// A run by hand, which waits, between the epochs of two nights.
  RunId add_run(std::size_t before, std::size_t after) {
    return store_.write([&](Transaction& t) {
      const auto add_epoch = [&](std::size_t night) {
        EpochRecord epoch;
        epoch.site = site_.id;
        epoch.name = "night " + std::to_string(night);
        epoch.from = kFirst + night * std::chrono::hours(24);
        epoch.to = epoch.from + std::chrono::hours(6);
        for (const ScanRecord& scan : scans_of_window(t, {site_.id, epoch.from, epoch.to}))
          epoch.scans.push_back(scan.id);
        return insert_epoch(t, epoch, now_);
      };
      RunRecord run;
      run.site = site_.id;
      run.definition = {.zones = {zone_}, .cell_m = 2.0, .core_spacing_m = 8.0};
      run.reference = add_epoch(before).id;
      const EpochRecord surveyed = add_epoch(after);
      run.epoch = surveyed.id;
      run.from = surveyed.from;
      run.to = run.due_at = surveyed.to;
      return insert_run(t, run, now_).id;
    });
  }
  SeriesKey cut_of_bench() const {
    return {.site = site_.id, .schedule = schedule_, .zone = zone_, .figure = SurveyFigure::cut_m3};
  }

 private:
  void work() {
    clock_.look(now_);
    while (runner_.run_next(arena_)) {
    }
  }

  simulator::Timeline timeline_ = make_timeline(simulator::Family::pit, {.seed = 3, .density = 0.5, .start = kFirst});
  TempDir folder_;
  Store store_{{.data_dir = folder_.path(), .readers = 2, .min_free_bytes = 0}};
  IndexCache cache_{std::uint64_t{1} << 28};
  Time now_ = kFirst - std::chrono::hours(12);
  ScheduleClock clock_{store_};
  SurveyRunner runner_{store_, cache_, "1.2.3", [this] { return now_; }};
  tbb::task_arena arena_{2};
  Site site_;
  ZoneId zone_;
  ScheduleId schedule_;
  std::map<std::string, SensorId> sensors_;
};

}  // namespace raywatch
