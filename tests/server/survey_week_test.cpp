// A week of nightly surveys of a simulated pit, by a clock that is set by hand, right across the change to summer time.

#include <doctest/doctest.h>

#include "tests/server/pit_place.hpp"

namespace raywatch {
namespace {

using namespace std::chrono_literals;

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
