#include "server/survey_alerts.hpp"

#include <doctest/doctest.h>

#include <algorithm>

#include "storage/alerts.hpp"
#include "storage/survey_series.hpp"
#include "tests/storage/sample_survey.hpp"
#include "tests/storage/store_fixture.hpp"

namespace raywatch {
namespace {

/// A schedule whose surveys have a net volume of 10 m3 times their number in the zone 3.
struct JudgedSchedule : StoreFixture {
  ScheduleRecord schedule;

  JudgedSchedule() {
    schedule.site = site.id;
    schedule.name = "nightly";
    schedule.plan = {.cron = "@daily", .time_zone = "UTC"};
    schedule = store.write([&](Transaction& t) { return insert_schedule(t, schedule, at_second(0)); });
  }
  void judge(int number) {
    SurveyResult result = sample_survey(number, ZoneId{3});
    const LevelThresholds thresholds{.yellow = 20.0, .orange = 40.0, .red = 60.0, .clear_after = 1};
    result.definition.thresholds = {{.figure = SurveyFigure::net_m3, .zone = ZoneId{3}, .thresholds = thresholds}};
    store.write([&](Transaction& t) {
      SurveyRecord survey;
      survey.site = site.id;
      survey.schedule = schedule.id;
      survey = insert_survey(t, survey, result);
      judge_levels(t, schedule, survey, result, at_second(++now_s_));
    });
  }
  void report(RunState state) {
    store.write([&](Transaction& t) {
      report_run(t, schedule, {.state = state, .why = "because", .log = {}}, at_second(++now_s_));
    });
  }
  std::vector<AlertRecord> alerts() {
    auto page = store.read([&](const Snapshot& s) { return list_alerts(s, {.site = site.id, .state = {}}, {}); });
    std::ranges::reverse(page.items);
    return page.items;
  }
  std::vector<std::string> steps(AlertId alert) {
    std::vector<std::string> actions;
    for (const AlertHistoryStep& step : store.read([&](const Snapshot& s) { return alert_history(s, alert); })) {
      actions.push_back(step.action);
    }
    return actions;
  }

 private:
  int now_s_ = 0;
};

using Steps = std::vector<std::string>;

TEST_CASE("a level opens one alert, raises and lowers it, and resolves it at green, each once") {
  JudgedSchedule place;
  place.judge(1);
  CHECK(place.alerts().empty());
  for (const int number : {3, 3, 7, 7, 5, 5}) place.judge(number);
  REQUIRE(place.alerts().size() == 1);
  const AlertRecord standing = place.alerts().front();
  CHECK(standing.cause == "survey-level");
  CHECK(standing.severity == Severity::warning);
  CHECK(standing.zone == ZoneId{3});
  CHECK(standing.title == "Survey \"nightly\", bench: net_m3 is 30 m3, level yellow.");
  CHECK(place.steps(standing.id) == Steps{"opened", "raised", "lowered"});
  place.judge(1);
  CHECK(place.alerts().front().state == AlertState::resolved);
  place.judge(-9);  // what falls is as bad as what rises
  REQUIRE(place.alerts().size() == 2);
  CHECK(place.alerts().back().severity == Severity::critical);
}

TEST_CASE("between a level and what clears it nothing changes") {
  JudgedSchedule place;
  place.judge(4);
  place.judge(4);
  const SeriesKey key{.site = place.site.id, .schedule = place.schedule.id, .zone = ZoneId{3}};
  const auto values =
      place.store.read([&](const Snapshot& s) { return survey_series(s, key, Time::min(), Time::max(), 10); });
  REQUIRE(values.size() == 2);
  CHECK(values.back().level == Level::orange);
  CHECK(place.alerts().size() == 1);
}

TEST_CASE("nights that brought nothing are told once for each reason, until one is good") {
  JudgedSchedule place;
  for (const RunState state : {RunState::no_scans, RunState::no_scans, RunState::refused, RunState::failed}) {
    place.report(state);
  }
  const std::vector<AlertRecord> alerts = place.alerts();
  REQUIRE(alerts.size() == 3);
  CHECK(alerts[0].cause == "survey-missing");
  CHECK(alerts[0].title == "Survey \"nightly\" brought no result: because");
  CHECK(alerts[1].cause == "survey-refused");
  CHECK(alerts[2].cause == "survey-failed");
  place.report(RunState::done);
  CHECK(std::ranges::all_of(place.alerts(), [](const AlertRecord& a) { return a.state == AlertState::resolved; }));
  place.report(RunState::no_scans);
  CHECK(place.alerts().size() == 4);
}

}  // namespace
}  // namespace raywatch
