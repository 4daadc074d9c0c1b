#include "storage/surveys.hpp"

#include <doctest/doctest.h>
#include <unistd.h>

#include <random>
#include <set>

#include "core/error.hpp"
#include "storage/epochs.hpp"
#include "storage/retention.hpp"
#include "storage/schedules.hpp"
#include "storage/survey_codec.hpp"
#include "storage/survey_json.hpp"
#include "storage/survey_runs.hpp"
#include "storage/survey_series.hpp"
#include "storage/sweep.hpp"
#include "tests/storage/killed_child.hpp"
#include "tests/storage/sample_survey.hpp"
#include "tests/storage/store_fixture.hpp"

namespace raywatch {
namespace {

using namespace std::chrono_literals;

SurveyResult through_codec(const SurveyResult& survey) {
  ModelDecoder decoder;
  for (const auto& block : encode_models(survey)) decoder.add(block);
  SurveyResult read;
  decoder.finish(read);
  return read;
}

ScheduleRecord nightly(SiteId site, const std::string& name = "nightly") {
  ScheduleRecord schedule;
  schedule.site = site;
  schedule.name = name;
  schedule.plan = {.cron = "0 5 * * *", .time_zone = "Europe/Berlin", .window = 6h, .catch_up = CatchUp::all};
  schedule.plan.required_vantages = {VantageId{1}};
  schedule.looked_until = at_second(0);
  return schedule;
}

RunRecord run_at(SiteId site, std::optional<ScheduleId> schedule, std::int64_t seconds) {
  RunRecord run;
  run.site = site;
  run.schedule = schedule;
  run.due_at = run.to = at_second(seconds);
  run.from = at_second(seconds - 50);
  return run;
}

EpochRecord epoch_at(SiteId site, std::optional<ScheduleId> schedule, std::int64_t seconds, std::vector<ScanId> scans) {
  EpochRecord epoch;
  epoch.site = site;
  epoch.schedule = schedule;
  epoch.name = "night";
  epoch.from = at_second(seconds - 50);
  epoch.to = at_second(seconds);
  epoch.scans = std::move(scans);
  return epoch;
}

struct SurveyStore : StoreFixture {
  ScheduleRecord add_schedule(const SurveyReference& reference = {}) {
    ScheduleRecord schedule = nightly(site.id);
    schedule.plan.definition.reference = reference;
    return store.write([&](Transaction& t) { return insert_schedule(t, schedule, at_second(0)); });
  }
  EpochRecord add_epoch(std::optional<ScheduleId> schedule, std::int64_t seconds, std::vector<ScanId> scans = {}) {
    return store.write(
        [&](Transaction& t) { return insert_epoch(t, epoch_at(site.id, schedule, seconds, scans), at_second(0)); });
  }
  SurveyRecord add_survey(const SurveyResult& result, std::int64_t seconds, std::optional<ScheduleId> schedule) {
    SurveyRecord survey;
    survey.site = site.id;
    survey.schedule = schedule;
    survey.after_at = at_second(seconds);
    survey.models = put_survey(store.payloads(), site.id, survey.after_at, result);
    return store.write([&](Transaction& t) { return insert_survey(t, survey, result); });
  }
  std::vector<ScanId> protected_ids() {
    const auto all = store.read([&](const Snapshot& s) { return protected_scans(s, site.id); });
    std::vector<ScanId> ids;
    for (const auto& [scan, why] : all) {
      if (why == Protection::survey) ids.push_back(scan);
    }
    std::ranges::sort(ids);
    return ids;
  }
};

TEST_CASE("what a survey found comes back as it was stored") {
  SurveyStore place;
  const SurveyResult survey = sample_survey(2, ZoneId{3});
  const SurveyRecord stored = place.add_survey(survey, 100, std::nullopt);
  place.store.read([&](const Snapshot& s) {
    const SurveyResult read = survey_result(s, stored.id);
    CHECK(definition_json(read.definition) == definition_json(survey.definition));
    CHECK(result_json(read) == result_json(survey));
    CHECK(std::isnan(read.zones.front().volumes.unseen.low_m3));  // not bounded
    CHECK(read.zones.front().volumes.unseen.high_m3 == 5.0);
    CHECK(read.before.front().world_from_sensor.position_m == survey.before.front().world_from_sensor.position_m);
    CHECK(read.definition.reference.days == 7);
    CHECK(changes_json(survey_changes(s, stored.id)) == changes_json(survey.changes));
    const Page<SurveyChange> first = survey_changes(s, stored.id, {.limit = 2, .cursor = {}});
    CHECK(first.items.size() == 2);
    const Page<SurveyChange> rest = survey_changes(s, stored.id, {.limit = 2, .cursor = first.next});
    CHECK(rest.items.size() == 1);
    CHECK_FALSE(rest.next);
    const Page<ListedSurvey> listed = list_surveys(s, {.site = place.site.id}, {});
    REQUIRE(listed.items.size() == 1);
    CHECK(listed.items[0].site == place.site.name);
    CHECK(listed.items[0].result.total.volumes.net.value_m3 ==
          survey_result(s, listed.items[0].record.id).total.volumes.net.value_m3);
    CHECK(list_surveys(s, {.site = {}, .schedule = ScheduleId{9}}, {}).items.empty());
  });
}

TEST_CASE("models and points survive their encoding") {
  const SurveyResult survey = sample_survey(3);
  const SurveyResult read = through_codec(survey);
  CHECK(read.before_model.layout == survey.before_model.layout);
  CHECK(read.before_model.cells[0].height_m == 1.5);
  CHECK(read.before_model.cells[0].slope == Eigen::Vector2d(0.5, -0.5));
  CHECK(read.before_model.cells[0].count == 12);
  CHECK(read.after_model.cells[0].height_m == 4.5);
  CHECK_FALSE(read.after_model.cells[1].seen());
  CHECK(std::isinf(read.after_model.cells[1].ceiling_m));
  CHECK(read.difference[0].rise_m == 3.0);
  CHECK(read.before_points.front().classes == survey.before_points.front().classes);
  CHECK(read.after_points.front().change_of == survey.after_points.front().change_of);
}

TEST_CASE("models that are cut short or damaged are refused") {
  auto blocks = encode_models(sample_survey(1));
  REQUIRE(blocks.size() == 1);
  SurveyResult read;
  ModelDecoder nothing;
  CHECK_THROWS_AS(nothing.finish(read), CorruptData);
  blocks[0][20] ^= 1;
  ModelDecoder damaged;
  CHECK_THROWS_AS(damaged.add(blocks[0]), CorruptData);
}

TEST_CASE("a schedule comes back as it was stored, and its name is its own") {
  SurveyStore place;
  const ScheduleRecord made = place.add_schedule({.policy = ReferencePolicy::days_ago, .epoch = {}, .days = 2});
  CHECK(made.plan.required_vantages == std::vector<VantageId>{VantageId{1}});
  CHECK(made.plan.window == 6h);
  CHECK(made.plan.catch_up == CatchUp::all);
  CHECK_THROWS_AS(place.add_schedule(), Conflict);
  ScheduleRecord changed = made;
  changed.enabled = false;
  place.store.write([&](Transaction& t) { replace_schedule(t, changed, at_second(5)); });
  place.store.read([&](const Snapshot& s) {
    CHECK(enabled_schedules(s).empty());
    CHECK(list_schedules(s, place.site.id, {}).items.size() == 1);
    CHECK(find_schedule(s, made.id)->edited_at == at_second(5));
  });
  place.store.write([&](Transaction& t) { delete_schedule(t, made.id); });
  place.store.read([&](const Snapshot& s) { CHECK_FALSE(find_schedule(s, made.id)); });
}

TEST_CASE("runs are queued by due time, begun once, put back after a stop, and given up after many") {
  SurveyStore place;
  Store& store = place.store;
  const ScheduleRecord schedule = place.add_schedule();
  const auto add = [&](std::int64_t seconds) {
    return store.write(
        [&](Transaction& t) { return insert_run(t, run_at(place.site.id, schedule.id, seconds), at_second(0)); });
  };
  const RunRecord late = add(200), early = add(100);
  store.read([&](const Snapshot& s) {
    const std::vector<RunRecord> queued = queued_runs(s);
    REQUIRE(queued.size() == 2);
    CHECK(queued.front().id == early.id);
    CHECK(has_useful_run(s, schedule.id, at_second(200)));
    CHECK_FALSE(has_useful_run(s, schedule.id, at_second(300)));
  });
  CHECK_THROWS_AS(store.write([&](Transaction& t) { delete_schedule(t, schedule.id); }), Conflict);
  const auto start = [&](RunId id) {
    return store.write([&](Transaction& t) { return start_run(t, id, at_second(1)); });
  };
  CHECK(start(early.id)->attempts == 1);
  CHECK_FALSE(start(early.id));
  for (int stop = 0; stop < 6; ++stop) {
    store.write([&](Transaction& t) { requeue_running_runs(t, at_second(2)); });
    start(early.id);
  }
  store.read([&](const Snapshot& s) { CHECK(find_run(s, early.id)->state == RunState::failed); });
  REQUIRE(start(late.id));
  const RunEnd end{.state = RunState::no_scans, .why = "no scans", .log = {{at_second(3), "looked"}}};
  CHECK(store.write([&](Transaction& t) { return finish_run(t, late.id, end, at_second(3)); }));
  CHECK_FALSE(store.write([&](Transaction& t) { return finish_run(t, late.id, end, at_second(3)); }));
  store.read([&](const Snapshot& s) {
    CHECK(find_run(s, late.id)->log.front().text == "looked");
    CHECK_FALSE(has_useful_run(s, schedule.id, at_second(200)));
    CHECK(list_runs(s, {.site = {}, .schedule = schedule.id}, {}).items.size() == 2);
    CHECK(list_runs(s, {.site = place.site.id}, {}).items.size() == 2);
    CHECK(unfinished_runs(s, place.site.id).empty());
  });
}

TEST_CASE("the latest epoch is found by schedule, by time, and by acceptance; a refused one never") {
  SurveyStore place;
  const ScheduleId schedule = place.add_schedule().id;
  const EpochRecord first = place.add_epoch(schedule, 100), second = place.add_epoch(schedule, 200);
  place.add_epoch(std::nullopt, 250);
  EpochRecord bad = epoch_at(place.site.id, schedule, 300, {});
  bad.state = EpochState::refused;
  const EpochId refused = place.store.write([&](Transaction& t) { return insert_epoch(t, bad, at_second(0)).id; });
  const auto latest = [&](const EpochSearch& search) {
    return place.store.read([&](const Snapshot& s) { return latest_epoch(s, search); });
  };
  CHECK(latest({.site = place.site.id, .schedule = schedule, .until = at_second(400)})->id == second.id);
  CHECK(latest({.site = place.site.id, .schedule = schedule, .until = at_second(199)})->id == first.id);
  CHECK_FALSE(latest({.site = place.site.id, .schedule = schedule, .until = at_second(400), .accepted = true}));
  CHECK_FALSE(latest({.site = place.site.id, .schedule = schedule, .until = at_second(199), .from = at_second(150)}));
  const EpochAcceptance by{"anna", "checked", at_second(500)};
  place.store.write([&](Transaction& t) { accept_epoch(t, first.id, by); });
  CHECK(latest({.site = place.site.id, .schedule = {}, .until = at_second(400), .accepted = true})->accepted->by ==
        "anna");
  CHECK_THROWS_AS(place.store.write([&](Transaction& t) { accept_epoch(t, refused, by); }), Conflict);
  place.store.read([&](const Snapshot& s) {
    const Page<EpochRecord> page = list_epochs(s, place.site.id, {.limit = 3, .cursor = {}});
    CHECK(page.items.front().id == refused);
    CHECK(list_epochs(s, place.site.id, {.limit = 3, .cursor = page.next}).items.front().id == first.id);
  });
}

TEST_CASE("an epoch has the latest scans of each vantage, of the sensors that are asked for") {
  SurveyStore place;
  const Sensor other = add_sensor(place.store, "mast", place.site.id);
  for (int i = 0; i < 6; ++i) add_scan(place.store, place.sensor, {at_second(10 + i)});
  add_scan(place.store, other, {at_second(12), {5.0, 0.0, 0.0}});
  add_scan(place.store, other, {at_second(90), {5.0, 0.0, 0.0}});
  const auto window = [&](std::vector<SensorId> sensors) {
    return place.store.read([&](const Snapshot& s) {
      return scans_of_window(s, {place.site.id, at_second(10), at_second(90), std::move(sensors)});
    });
  };
  const std::vector<ScanRecord> all = window({});
  CHECK(all.size() == kMostScansOfVantage + 1);
  CHECK(std::ranges::is_sorted(all, {}, &ScanRecord::captured_at));
  CHECK(all.back().captured_at == at_second(15));
  CHECK(window({other.id}).size() == 1);
}

TEST_CASE("retention keeps the scans of accepted epochs, of what comes next, and of runs that are not finished") {
  SurveyStore place;
  const ScheduleId schedule = place.add_schedule().id;
  std::vector<ScanId> scans;
  for (int i = 0; i < 6; ++i) scans.push_back(add_scan(place.store, place.sensor, {at_second(100 * i)}).id);
  const EpochRecord old = place.add_epoch(schedule, 101, {scans[1]});
  place.add_epoch(schedule, 201, {scans[2]});
  place.add_epoch(schedule, 301, {scans[3]});
  CHECK(place.protected_ids() == std::vector<ScanId>{scans[3]});
  place.store.write([&](Transaction& t) { accept_epoch(t, old.id, {"anna", "", at_second(0)}); });
  CHECK(place.protected_ids() == std::vector<ScanId>{scans[1], scans[3]});
  CHECK_THROWS_AS(place.store.write([&](Transaction& t) { return delete_scan(t, scans[1]); }), Conflict);
  place.store.write([&](Transaction& t) { insert_run(t, run_at(place.site.id, schedule, 401), at_second(0)); });
  CHECK(place.protected_ids() == std::vector<ScanId>{scans[1], scans[3], scans[4]});
}

TEST_CASE("an epoch that a schedule or a run needs is not deleted") {
  SurveyStore place;
  const EpochRecord fixed = place.add_epoch(std::nullopt, 100), given = place.add_epoch(std::nullopt, 200);
  place.add_schedule({.policy = ReferencePolicy::fixed, .epoch = fixed.id, .days = 0});
  RunRecord run = run_at(place.site.id, std::nullopt, 200);
  run.epoch = given.id;
  place.store.write([&](Transaction& t) { insert_run(t, run, at_second(0)); });
  for (const EpochId id : {fixed.id, given.id}) {
    CHECK_THROWS_AS(place.store.write([&](Transaction& t) { delete_epoch(t, id); }), Conflict);
  }
  const EpochRecord free = place.add_epoch(std::nullopt, 300);
  place.store.write([&](Transaction& t) { delete_epoch(t, free.id); });
  place.store.read([&](const Snapshot& s) { CHECK_FALSE(find_epoch(s, free.id)); });
}

TEST_CASE("a series has the values of its zone and schedule in the order of time, with their levels") {
  SurveyStore place;
  const ScheduleId schedule = place.add_schedule().id;
  std::vector<SurveyId> surveys;
  for (const int number : {3, 1, 2}) {
    surveys.push_back(place.add_survey(sample_survey(number, ZoneId{3}), number, schedule).id);
  }
  place.add_survey(sample_survey(9, ZoneId{3}), 9, std::nullopt);
  const FigureThresholds judged{.figure = SurveyFigure::net_m3, .zone = ZoneId{3}, .thresholds = {}};
  const LevelState red{.level = Level::red, .pending = Level::orange, .count = 1};
  place.store.write([&](Transaction& t) { set_level(t, schedule, judged, red, surveys[0]); });
  place.store.read([&](const Snapshot& s) {
    const SeriesKey key{.site = place.site.id, .schedule = schedule, .zone = ZoneId{3}};
    const std::vector<SeriesValue> values = survey_series(s, key, at_second(0), at_second(100), 100);
    REQUIRE(values.size() == 3);
    CHECK(values[0].figure.value == 10.0);
    CHECK(*values[0].figure.low == doctest::Approx(10.0 - 9.8));
    CHECK(values[2].survey == surveys[0]);
    CHECK(values[2].level == Level::red);
    CHECK_FALSE(values[1].level);
    CHECK(survey_series(s, key, at_second(2), at_second(3), 100).size() == 1);
    CHECK(survey_series(s, key, at_second(0), at_second(100), 2).front().figure.value == 20.0);
    CHECK(
        survey_series(s, {.site = place.site.id, .schedule = {}, .zone = {}}, at_second(0), at_second(100), 9).size() ==
        1);
    CHECK(level_of(s, schedule, ZoneId{3}, SurveyFigure::net_m3) == red);
    CHECK(level_of(s, schedule, ZoneId{4}, SurveyFigure::net_m3) == LevelState{});
  });
}

/// Makes surveys until it is killed, as the runner does: payload first, then one transaction.
[[noreturn]] void work(const std::filesystem::path& data_dir, int pipe) {
  Store store(options_for(data_dir));
  const SiteId site = store.read([](const Snapshot& s) { return find_site(s, "hall").value().id; });
  store.write([](Transaction& t) { requeue_running_runs(t, at_second(0)); });
  for (;;) {
    const auto queued = store.read([](const Snapshot& s) { return queued_runs(s); });
    const RunId id = queued.empty() ? store.write([&](Transaction& t) {
      return insert_run(t, run_at(site, std::nullopt, 100), at_second(0)).id;
    })
                                    : queued.front().id;
    store.write([&](Transaction& t) { start_run(t, id, at_second(1)); });
    const SurveyResult result = sample_survey(static_cast<int>(id.value));
    SurveyRecord survey;
    survey.site = site;
    survey.run = id;
    survey.models = put_survey(store.payloads(), site, at_second(1), result);
    store.write([&](Transaction& t) {
      RunEnd end;
      end.epoch = insert_epoch(t, epoch_at(site, std::nullopt, 100, {}), at_second(1)).id;
      end.survey = insert_survey(t, survey, result).id;
      finish_run(t, id, end, at_second(2));
    });
    if (write(pipe, &id.value, sizeof id.value) != sizeof id.value) _exit(1);
  }
}

TEST_CASE("after any kill in the middle of surveys each is there whole or not at all, and goes on") {
  const TempDir directory;
  {
    Store store(options_for(directory.path()));
    add_site(store, "hall");
  }
  std::mt19937 random(20260101);
  std::set<std::int64_t> reported;
  for (int round = 0; round < 12; ++round) {
    const int reports = std::uniform_int_distribution(0, 4)(random);
    const auto spins = std::uniform_int_distribution<std::uint64_t>(0, 3'000'000)(random);
    const auto work_on = [&](int pipe) { work(directory.path(), pipe); };
    for (const std::int64_t run : reports_until_killed<std::int64_t>(work_on, {.reports = reports, .spins = spins})) {
      CHECK(reported.insert(run).second);  // none is made twice
    }
    Store store(options_for(directory.path()));
    CHECK(store.open_report().warnings.empty());
    const auto surveys =
        store.read([](const Snapshot& s) { return list_surveys(s, {}, {.limit = 1000, .cursor = {}}); });
    std::set<std::int64_t> made;
    for (const ListedSurvey& listed : surveys.items) {
      const SurveyRecord& survey = listed.record;
      CHECK(made.insert(survey.run.value).second);
      SurveyResult read;
      read_models(store.payloads(), survey.models, read);
      CHECK(read.difference[0].rise_m == static_cast<double>(survey.run.value));
      const auto run = store.read([&](const Snapshot& s) { return find_run(s, survey.run); });
      CHECK(run->state == RunState::done);
      CHECK(run->survey == survey.id);
    }
    CHECK(std::ranges::includes(made, reported));
    CHECK(stored_payloads(store) == made.size());
    CHECK(
        store.read([](const Snapshot& s) { return list_epochs(s, {}, {.limit = 1000, .cursor = {}}); }).items.size() ==
        made.size());
  }
  CHECK(reported.size() > 5);
}

}  // namespace
}  // namespace raywatch
