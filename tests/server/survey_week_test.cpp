// A week of nightly surveys of a simulated pit, by a clock that is set by hand, right across the change to summer time.

#include <doctest/doctest.h>

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
namespace {

using namespace std::chrono_literals;

constexpr std::size_t kStations = 2;
const Time kFirst = parse_rfc3339("2026-03-26T02:00:00Z");

SurveyDefinition definition_of(ZoneId zone) {
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
      schedule.plan = {.cron = "0 8 * * *", .time_zone = "Europe/Berlin", .window = 6h};
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
    for (; now_ < moment; now_ = std::min<Time>(moment, now_ + 17min)) work();
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
  Time now_ = kFirst - 12h;
  ScheduleClock clock_{store_};
  SurveyRunner runner_{store_, cache_, "1.2.3", [this] { return now_; }};
  tbb::task_arena arena_{2};
  Site site_;
  ZoneId zone_;
  ScheduleId schedule_;
  std::map<std::string, SensorId> sensors_;
};

TEST_CASE(
    "a week: volumes hold the truth, nights without scans and bad ones are told until one is good, levels are raised "
    "once") {
  PitPlace pit;
  const std::size_t missing = 3, partial = 5;
  for (std::size_t night = 0; night < 7; ++night) {
    const Time taken = kFirst + night * 24h;
    pit.go_to(taken);
    if (night != missing) pit.take_night(night, night == partial ? 1 : kStations);
    pit.go_to(taken + 8h);
  }
  const std::vector<RunRecord> runs = pit.runs();
  REQUIRE(runs.size() == 7);
  std::vector<RunState> states;
  for (const RunRecord& run : runs) states.push_back(run.state);
  using enum RunState;
  CHECK(states == std::vector{done, done, done, no_scans, done, no_scans, done});
  // 8:00 in Berlin, before and after the clocks go forward.
  CHECK(runs[2].due_at == parse_rfc3339("2026-03-28T07:00:00Z"));
  CHECK(runs[3].due_at == parse_rfc3339("2026-03-29T06:00:00Z"));
  CHECK_FALSE(runs[0].survey);
  CHECK(runs[partial].why.find("pit-2") != std::string::npos);

  const std::map<std::size_t, std::size_t> earlier{{1, 0}, {2, 1}, {4, 2}, {6, 4}};
  for (const auto& [night, before] : earlier) {
    CAPTURE(night);
    INFO(runs[night].why);
    REQUIRE(runs[night].survey);
    const SurveyResult survey = pit.survey(*runs[night].survey);
    const ZoneVolumes& bench = survey.zones.front().volumes;
    const double seen_m3 =
        pit.true_net_m3(before, night, [&](std::size_t cell) { return survey.difference[cell].seen(); });
    CHECK(bench.net.low_m3() <= seen_m3);
    CHECK(bench.net.high_m3() >= seen_m3);
    const double whole_m3 = pit.true_net_m3(before, night, [](std::size_t) { return true; });
    CHECK(bench.whole().low_m3 <= whole_m3);
    CHECK(bench.whole().high_m3 >= whole_m3);
    CHECK(bench.seen_share() > 0.2);
    CHECK_FALSE(survey.before.empty());
    CHECK(survey.after.front().uncertainty.position_m > 0.0);
    CHECK_FALSE(runs[night].log.empty());
  }
  const auto resolved = AlertState::resolved;
  using Alerts = std::vector<std::pair<std::string, AlertState>>;
  CHECK(pit.alerts() ==
        Alerts{{"survey-level", AlertState::open}, {"survey-missing", resolved}, {"survey-missing", resolved}});
  const auto cuts = pit.store().read(
      [&](const Snapshot& s) { return survey_series(s, pit.cut_of_bench(), Time::min(), Time::max(), 100); });
  REQUIRE(cuts.size() == 4);
  CHECK(std::ranges::all_of(cuts, [](const SeriesValue& cut) { return cut.level == Level::orange; }));
}

TEST_CASE("a night that is badly registered is refused, told, and never compared with") {
  PitPlace pit;
  for (std::size_t night = 0; night < 3; ++night) {
    pit.go_to(kFirst + night * 24h);
    pit.take_night(night, kStations, night == 1 ? RegistrationState::bad : RegistrationState::good);
    pit.go_to(kFirst + night * 24h + 8h);
    if (night == 1) CHECK(pit.alerts().back() == std::pair{std::string("survey-refused"), AlertState::open});
  }
  const std::vector<RunRecord> runs = pit.runs();
  REQUIRE(runs.size() == 3);
  CHECK(runs[1].state == RunState::refused);
  CHECK(runs[1].why.find("does not fit onto the earlier ones") != std::string::npos);
  INFO(runs[2].why);
  CHECK(runs[2].state == RunState::done);
  CHECK(runs[2].reference == runs[0].epoch);
  for (const auto& [cause, state] : pit.alerts()) {
    if (cause == "survey-refused") CHECK(state == AlertState::resolved);
  }
  const auto refused = pit.store().read([&](const Snapshot& s) { return find_epoch(s, runs[1].epoch.value()); });
  CHECK(refused->state == EpochState::refused);
}

}  // namespace
}  // namespace raywatch
