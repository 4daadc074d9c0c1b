#include <doctest/doctest.h>

#include <algorithm>
#include <set>

#include "storage/alerts.hpp"
#include "storage/baselines.hpp"
#include "storage/calendar.hpp"
#include "storage/deletions.hpp"
#include "storage/deliveries.hpp"
#include "storage/epochs.hpp"
#include "storage/events.hpp"
#include "storage/retention.hpp"
#include "storage/rules.hpp"
#include "storage/schedules.hpp"
#include "storage/snapshot.hpp"
#include "storage/sqlite.hpp"
#include "storage/storage_use.hpp"
#include "storage/survey_runs.hpp"
#include "storage/survey_series.hpp"
#include "storage/surveys.hpp"
#include "storage/tracks.hpp"
#include "storage/zones.hpp"
#include "tests/storage/store_fixture.hpp"

namespace raywatch {
namespace {

/// The steps of a plan that read a whole table or sort what they read.
std::vector<std::string> costly_steps(Database& database, const std::string& sql) {
  std::vector<std::string> steps;
  Statement plan(database, "EXPLAIN QUERY PLAN " + sql);
  while (plan.next()) {
    plan.take<int>();
    plan.take<int>();
    plan.take<int>();
    const auto step = plan.take<std::string>();
    // Walking an index in the wanted order, until the page is full, is no full scan.
    const bool walks_table = step.starts_with("SCAN ") && step.find("INDEX") == std::string::npos;
    if (walks_table || step.find("USE TEMP B-TREE") != std::string::npos) steps.push_back(step);
  }
  return steps;
}

std::vector<std::string> statements_of(Database& database) {
  std::vector<std::string> statements;
  for (const std::string& sql : database.cached_statements()) {
    if (sql.starts_with("SELECT")) statements.push_back(sql);
  }
  return statements;
}

template <class Call>
void for_each_filter(unsigned bits, const Call& call) {
  for (unsigned chosen = 0; chosen < 1u << bits; ++chosen) call(chosen);
}

void list_everything(const Snapshot& s, SiteId site, SensorId sensor, VantageId vantage) {
  const Time from = at_second(0), to = at_second(100);
  for_each_filter(5, [&](unsigned bits) {
    ScanFilter filter;
    if (bits & 1 || bits & 16) filter.site = site;
    if (bits & 2) filter.sensor = sensor;
    if (bits & 4) filter.vantage = vantage;
    if (bits & 8) filter.from = from, filter.to = to;
    if (bits & 16) filter.near_m = Eigen::Vector3d::Zero();
    list_scans(s, filter, {});
  });
  for_each_filter(3, [&](unsigned bits) {
    ComparisonFilter filter;
    if (bits & 1) filter.site = site;
    if (bits & 2) filter.scan = ScanId{1};
    if (bits & 4) filter.state = ComparisonState::queued;
    list_comparisons(s, filter, {});
  });
  for_each_filter(4, [&](unsigned bits) {
    ChangeFilter filter;
    if (bits & 1) filter.site = site;
    if (bits & 2) filter.comparison = ComparisonId{1};
    if (bits & 4) filter.kind = ChangeKind::added;
    if (bits & 8) filter.from = from, filter.min_volume_m3 = 1.0;
    list_changes(s, filter, {});
  });
  list_sites(s, {});
  for (const std::optional<SiteId> of : {std::optional<SiteId>(), std::optional(site)}) {
    list_sensors(s, of, {});
    list_vantages(s, of, {});
  }
}

void watch(const Snapshot& s, SiteId site, SensorId sensor) {
  for (const std::optional<SiteId> of : {std::optional<SiteId>(), std::optional(site)}) {
    list_zones(s, of, {});
    list_rules(s, of, {});
    list_silences(s, of, {});
    events_after(s, EventId{}, of, 10);
    for (const std::optional<TrackState> state : {std::optional<TrackState>(), std::optional(TrackState::open)}) {
      list_tracks(s, {.site = of, .state = state}, {});
      list_tracks(s, {.site = of, .state = state, .kind = ChangeKind::added, .from = at_second(0), .to = at_second(9)},
                  {});
    }
    for (const std::optional<AlertState> state : {std::optional<AlertState>(), std::optional(AlertState::open)}) {
      list_alerts(s, {.site = of, .state = state}, {});
    }
  }
  list_coverage(s, ZoneId{1}, {});
  first_coverage(s, ZoneId{1}, VantageId{1}, 3);
  last_coverage(s, ZoneId{1}, VantageId{1}, 2);
  rulebook_of(s, site, at_second(0));
  find_zone(s, site, "gate");
  followed_tracks(s, site);
  tracks_begun(s, site, at_second(0), at_second(1));
  tracked_until(s, site);
  tracked_until(s, sensor);
  find_watched_scan(s, ScanId{1});
  sight_runs(s, TrackId{1});
  changes_of_track(s, TrackId{1}, ScanId{1});
  ChangeFilter of_track;
  of_track.track = TrackId{1};
  list_changes(s, of_track, {});
  counts_between(s, site, at_second(0), at_second(1));
  alerts_of(s, TrackId{1});
  alert_history(s, AlertId{1});
  standing_alert(s, site, "disk", "disk");
  snoozed_until(s, at_second(0));
  last_event(s);
  list_baselines(s, site, {});
  latest_baselines(s, {});
  baseline_entries(s, site, 1);
  baseline_of_vantage(s, site, VantageId{1});
  baseline_patches(s, site);
  is_in_baseline(s, ScanId{1});
}

void tell(const Snapshot& s, SiteId site) {
  list_channels(s, site, {});
  enabled_channels(s);
  find_channel(s, ChannelId{1});
  for_each_filter(3, [&](unsigned bits) {
    DeliveryFilter filter;
    if (bits & 1) filter.channel = ChannelId{1};
    if (bits & 2) filter.state = DeliveryState::pending;
    if (bits & 4) filter.alert = AlertId{1};
    list_deliveries(s, filter, {});
  });
  next_attempt_of(s, ChannelId{1});
  unfinished_deliveries(s);
}

void survey(const Snapshot& s, SiteId site) {
  const std::optional<ScheduleId> none, schedule = ScheduleId{1};
  for (const std::optional<SiteId> of : {std::optional<SiteId>(), std::optional(site)}) {
    list_schedules(s, of, {});
    list_epochs(s, of, {});
    for (const auto& by : {none, schedule}) {
      list_runs(s, {.site = of, .schedule = by}, {});
      list_surveys(s, {.site = of, .schedule = by}, {});
    }
  }
  enabled_schedules(s);
  queued_runs(s);
  unfinished_runs(s, site);
  has_useful_run(s, *schedule, at_second(0));
  for (const auto& by : {none, schedule}) {
    for (const bool accepted : {false, true}) {
      latest_epoch(s, {.site = site, .schedule = by, .until = at_second(0), .accepted = accepted});
    }
    survey_series(s, {.site = site, .schedule = by, .zone = {}}, at_second(0), at_second(1), 10);
  }
  scans_that_surveys_need(s, site);
  is_in_accepted_epoch(s, ScanId{1});
  level_of(s, *schedule, std::nullopt, SurveyFigure::net_m3);
}

void keep(const Snapshot& s, SiteId site) {
  for (const std::optional<SiteId> of : {std::optional<SiteId>(), std::optional(site)}) list_deletions(s, of, {});
  plan_retention(s, site, {.in_force = {.max_age_days = 1}, .now = at_second(1'000'000)}, 100);
  has_old_logs(s, at_second(0));
  growth_of(s, site, at_second(0));
  first_event(s);
}

void ask_for_priors(const Snapshot& s, SiteId site, VantageId vantage) {
  nearest_vantages(s, site, Eigen::Vector3d::Zero(), 2);
  nearest_vantages(s, site, Eigen::Vector3d::Zero(), 64);
  latest_scan(s, vantage, at_second(0), at_second(100));
  find_scan(s, SensorId{1}, at_second(0));
  comparisons_of(s, ScanId{1});
  candidates_of(s, ComparisonId{1});
  sites_with_jobs(s);
}

TEST_CASE_FIXTURE(StoreFixture, "no question to the store reads a whole table or sorts one") {
  VantageId vantage;
  for (int i = 0; i < 5; ++i) {
    vantage = add_scan(store, sensor, {at_second(i), {2.0 * i, 0.0, 0.0}}).vantage;
    add_comparison(store, ScanId{i + 1});
  }
  finish_next_job(store, site.id, {change_at({0.0, 0.0, 0.0})});
  store.read([&](const Snapshot& s) {
    list_everything(s, site.id, sensor.id, vantage);
    ask_for_priors(s, site.id, vantage);
    watch(s, site.id, sensor.id);
    tell(s, site.id);
    survey(s, site.id);
    keep(s, site.id);
    // Sites are few, and each is asked once; counting stops at a limit.
    const std::set<std::string> known{"SCAN sites", "SCAN (subquery-1)"};
    const std::vector<std::string> statements = statements_of(database_of(s));
    CHECK(statements.size() > 60);
    for (const std::string& sql : statements) {
      CAPTURE(sql);
      for (const std::string& step : costly_steps(database_of(s), sql)) {
        CAPTURE(step);
        CHECK(known.contains(step));
      }
    }
  });
}

TEST_CASE_FIXTURE(StoreFixture, "a box goes through the R*Tree, and so do the vantages near a place") {
  add_comparison(store, add_scan(store, sensor, {at_second(0)}).id);
  finish_next_job(store, site.id, {change_at({0.0, 0.0, 0.0})});
  store.read([&](const Snapshot& s) {
    ChangeFilter boxed;
    boxed.site = site.id;
    boxed.box_m = Eigen::AlignedBox3d(Eigen::Vector3d::Zero(), Eigen::Vector3d::Ones());
    list_changes(s, boxed, {});
    ScanFilter near;
    near.site = site.id;
    near.near_m = Eigen::Vector3d::Zero();
    list_scans(s, near, {});
    const std::vector<std::string> statements = statements_of(database_of(s));
    for (const char* tree : {"change_bounds AS b CROSS JOIN", "vantage_places AS p CROSS JOIN"}) {
      const auto sql = std::find_if(statements.begin(), statements.end(),
                                    [&](const std::string& text) { return text.find(tree) != std::string::npos; });
      REQUIRE(sql != statements.end());
      Statement plan(database_of(s), "EXPLAIN QUERY PLAN " + *sql);
      REQUIRE(plan.next());
      plan.take<int>();
      plan.take<int>();
      plan.take<int>();
      // The letters are the constraints that the tree itself applies: eight bounds.
      const auto step = plan.take<std::string>();
      CAPTURE(step);
      CHECK(step.find("VIRTUAL TABLE INDEX 2:") != std::string::npos);
      CHECK(step.substr(step.rfind(':') + 1).size() == 16);
    }
  });
}

}  // namespace
}  // namespace raywatch
