#include "storage/retention.hpp"

#include <doctest/doctest.h>

#include <limits>
#include <string>

#include "core/error.hpp"
#include "storage/alerts.hpp"
#include "storage/baselines.hpp"
#include "storage/events.hpp"
#include "storage/payloads_impl.hpp"
#include "storage/storage_use.hpp"
#include "storage/tracks.hpp"
#include "tests/storage/store_fixture.hpp"

namespace raywatch {
namespace {

constexpr std::size_t kAll = std::numeric_limits<std::size_t>::max();
constexpr std::int64_t kDay_s = 86'400;

/// One scan a day, each received a second after it was taken.
struct DailyScans : StoreFixture {
  std::vector<ScanRecord> scans;

  explicit DailyScans(int days = 10) {
    for (int day = 0; day < days; ++day) {
      scans.push_back(add_scan_with_points(store, sensor, {at_second(day * kDay_s)},
                                           cloud_of(2000, static_cast<std::uint32_t>(day))));
    }
  }

  RetentionPlan plan(const RetentionLimits& limits, std::int64_t now_s, std::size_t most = kAll) {
    const RetentionState state = retention_state(store, site.id, limits, at_second(now_s));
    return store.read([&](const Snapshot& s) { return plan_retention(s, site.id, state, most); });
  }

  std::vector<ScanId> apply(const RetentionPlan& what) {
    const DeletedScans deleted =
        store.write([&](Transaction& t) { return delete_expired(t, site.id, what.expired, at_second(99 * kDay_s)); });
    for (const PayloadRef& payload : deleted.payloads) store.payloads().remove(payload);
    store.give_back_space(deleted.payloads);
    return deleted.scans;
  }

  bool is_there(const ScanRecord& scan) {
    return store.read([&](const Snapshot& s) { return find_scan(s, scan.id).has_value(); });
  }
};

std::vector<ScanId> ids_of(const RetentionPlan& plan) {
  std::vector<ScanId> ids;
  for (const ExpiredScan& scan : plan.expired) ids.push_back(scan.scan);
  return ids;
}

TEST_CASE("a site's own limit wins over that of all sites, and 0 is none") {
  const RetentionLimits common{.max_age_days = 30, .max_bytes = 1000, .min_free_bytes = 0};
  CHECK(limits_in_force({}, common) == RetentionLimits{.max_age_days = 30, .max_bytes = 1000});
  CHECK(limits_in_force({.max_age_days = 7, .max_bytes = 0}, common) == RetentionLimits{.max_age_days = 7});
  CHECK_FALSE(is_on(limits_in_force({}, {})));
}

TEST_CASE_FIXTURE(DailyScans, "without limits nothing is ever planned") {
  CHECK(plan({}, 1000 * kDay_s).expired.empty());
  CHECK(plan({}, 1000 * kDay_s).reached);
}

TEST_CASE_FIXTURE(DailyScans, "by age what was received too long ago goes, the oldest receipt first") {
  // The scans of the days 0 to 3 were received more than 6 days before the 10th.
  const RetentionPlan by_age = plan({.max_age_days = 6}, 10 * kDay_s);
  CHECK(ids_of(by_age) == std::vector{scans[0].id, scans[1].id, scans[2].id, scans[3].id});
  CHECK(by_age.reasons.at(DeletionReason::age) == 4);
  CHECK(by_age.oldest_received_at == scans[0].received_at);
  CHECK(by_age.newest_received_at == scans[3].received_at);
  CHECK(by_age.bytes == scans[0].stored_bytes + scans[1].stored_bytes + scans[2].stored_bytes + scans[3].stored_bytes);
  CHECK(plan({.max_age_days = 6}, 10 * kDay_s, 2).expired.size() == 2);
}

TEST_CASE_FIXTURE(DailyScans, "the age counts from the receipt: what was taken long ago and came today stays") {
  ScanRecord late = sketched_scan(sensor, {at_second(-500 * kDay_s)});
  late.received_at = at_second(10 * kDay_s);
  late = store.write([&](Transaction& t) { return insert_scan(t, late); });
  apply(plan({.max_age_days = 6}, 10 * kDay_s));
  CHECK(is_there(late));
}

TEST_CASE_FIXTURE(DailyScans, "by bytes as much goes as is too much, and the files shrink with it") {
  const std::uint64_t before = store.payloads().use_of(site.id).in_use_bytes;
  const RetentionLimits half{.max_bytes = before / 2};
  // One at a time: pages are not full, so that deleting gives back more than the bytes that a plan counts with.
  for (int turn = 0; turn < 20 && !plan(half, 0).expired.empty(); ++turn) CHECK_FALSE(apply(plan(half, 0, 1)).empty());
  const std::uint64_t after = store.payloads().use_of(site.id).in_use_bytes;
  CHECK(after <= before / 2);
  CHECK(after > before / 4);
  CHECK(payload_bytes_on_disk(store, site.id) <= after + (100 << 10));
  CHECK_FALSE(is_there(scans.front()));
  CHECK(is_there(scans.back()));
  CHECK(same_bits(store.payloads().scan_points(scans.back().payload), cloud_of(2000, 9)));
}

TEST_CASE_FIXTURE(DailyScans, "by free disk as much goes as is missing there") {
  RetentionState state{.in_force = {.min_free_bytes = 1'000'000}, .now = at_second(0)};
  state.free_bytes = 1'000'000 - scans[0].stored_bytes - 1;
  const RetentionPlan found = store.read([&](const Snapshot& s) { return plan_retention(s, site.id, state, kAll); });
  CHECK(ids_of(found) == std::vector{scans[0].id, scans[1].id});
  CHECK(found.reasons.at(DeletionReason::free_disk) == 2);
  state.free_bytes = 0;
  CHECK_FALSE(store.read([&](const Snapshot& s) { return plan_retention(s, site.id, state, kAll); }).reached);
}

TEST_CASE_FIXTURE(DailyScans,
                  "what is pinned, normal, unfinished, named by a job or an anchor stays, and it is said why") {
  store.write([&](Transaction& t) {
    edit_scan(t, scans[0].id, {.pinned = true});
    edit_baseline(t, site.id,
                  {.kind = "learned", .by = "raywatch", .add = {{.scan = scans[1].id, .vantage = scans[1].vantage}}},
                  at_second(9));
    insert_comparison(t, scans[2].id, ExplicitReference{{scans[3].id}}, CompareParameters{}, at_second(9));
    set_registration(t, scans[4].id, {.uncertainty = PoseUncertainty{}});
  });
  const RetentionPlan all = plan({.max_age_days = 1}, 1000 * kDay_s);
  CHECK(ids_of(all) == std::vector{scans[5].id, scans[6].id, scans[7].id, scans[8].id, scans[9].id});
  CHECK(all.kept ==
        std::map<Protection, std::uint64_t>{
            {Protection::pinned, 1}, {Protection::baseline, 1}, {Protection::unfinished, 2}, {Protection::anchor, 1}});
  CHECK(apply(all).size() == 5);
  for (int i = 0; i < 5; ++i) CHECK(is_there(scans[static_cast<std::size_t>(i)]));
}

TEST_CASE_FIXTURE(DailyScans, "what became protected after it was planned is not deleted") {
  const RetentionPlan all = plan({.max_age_days = 1}, 1000 * kDay_s);
  store.write([&](Transaction& t) { edit_scan(t, scans[3].id, {.pinned = true}); });
  CHECK(apply(all).size() == scans.size() - 1);
  CHECK(is_there(scans[3]));
}

/// An alert of a track that the scans 4 and 5 showed; 5 was compared with 2.
struct AlertOfScans : DailyScans {
  AlertId alert;

  AlertOfScans() {
    for (const int i : {4, 5}) add_comparison(store, scans[static_cast<std::size_t>(i)].id);
    finish_next_job(store, site.id, {change_at({1.0, 0.0, 0.0})});
    store.write([&](Transaction& t) {
      const Job job = start_job(t, site.id).value();
      ComparisonResult result;
      result.changes = {change_at({1.0, 0.0, 0.0})};
      result.priors = {{.scan = scans[2].id, .vantage = scans[2].vantage}};
      const ChangeId change = finish_job(t, job, result, at_second(1)).value().front();
      TrackRecord record{.track = begin_track(change_at({1.0, 0.0, 0.0}), {}, scans[4].captured_at), .site = site.id};
      record.first_scan = scans[4].id;
      record.last_scan = scans[5].id;
      record.latest_change = change;
      const TrackId track = insert_track(t, record);
      for (std::int64_t id = 1; id <= change.value; ++id) set_track(t, ChangeId{id}, track);
      alert = open_alert(t,
                         {.site = site.id,
                          .title = "a bag",
                          .track = track,
                          .rule = RuleId{1},
                          .scan = scans[5].id,
                          .opened_at = at_second(2)},
                         "")
                  .id;
    });
  }
};

TEST_CASE_FIXTURE(AlertOfScans, "scans behind an alert that stands stay with their priors, until it is resolved") {
  for (const AlertState state : {AlertState::open, AlertState::acknowledged, AlertState::snoozed}) {
    store.write([&](Transaction& t) {
      change_alert(t, alert, {.action = "changed", .by = "anna", .at = at_second(3), .state = state});
    });
    const RetentionPlan all = plan({.max_age_days = 1}, 1000 * kDay_s);
    CHECK(all.kept == std::map<Protection, std::uint64_t>{{Protection::alert, 2}, {Protection::evidence, 1}});
    CHECK(all.expired.size() == scans.size() - 3);
  }
  store.write([&](Transaction& t) {
    change_alert(t, alert, {.action = "resolved", .by = "anna", .at = at_second(4), .state = AlertState::resolved});
  });
  CHECK(plan({.max_age_days = 1}, 1000 * kDay_s).expired.size() == scans.size());
}

TEST_CASE_FIXTURE(AlertOfScans, "what other comparisons, tracks and alerts say about deleted scans stays") {
  store.write([&](Transaction& t) {
    edit_scan(t, scans[5].id, {.pinned = true});
    change_alert(t, alert, {.action = "resolved", .by = "anna", .at = at_second(4), .state = AlertState::resolved});
  });
  apply(plan({.max_age_days = 1}, 1000 * kDay_s));
  store.read([&](const Snapshot& s) {
    CHECK_FALSE(find_scan(s, scans[2].id));
    const std::vector<ComparisonRecord> comparisons = comparisons_of(s, scans[5].id);
    REQUIRE(comparisons.size() == 1);
    CHECK(comparisons[0].changes == 1);
    REQUIRE(comparisons[0].priors.size() == 1);
    CHECK(comparisons[0].priors[0].scan == scans[2].id);
    const AlertRecord kept = find_alert(s, alert).value();
    const TrackRecord track = find_track(s, kept.track.value()).value();
    CHECK(track.first_scan == scans[4].id);
    CHECK(track.track.latest.points == change_at({}).points);
    CHECK(list_comparisons(s, {.scan = scans[4].id}, {}).items.empty());
  });
}

TEST_CASE_FIXTURE(DailyScans, "every deletion is recorded, with an event of its own") {
  apply(plan({.max_age_days = 8}, 10 * kDay_s));
  store.read([&](const Snapshot& s) {
    const auto records = list_deletions(s, site.id, {}).items;
    REQUIRE(records.size() == 2);
    CHECK(records[1].what == "scan");
    CHECK(records[1].reason == DeletionReason::age);
    CHECK(records[1].scan == scans[0].id);
    CHECK(records[1].sensor == sensor.id);
    CHECK(records[1].captured_at == scans[0].captured_at);
    CHECK(records[1].received_at == scans[0].received_at);
    CHECK(records[1].bytes == scans[0].stored_bytes);
    CHECK(records[1].at == at_second(99 * kDay_s));
    std::size_t events = 0;
    for (const Event& event : events_after(s, {}, {}, 100)) events += event.type == "scan.deleted" ? 1 : 0;
    CHECK(events == 2);
    CHECK(list_deletions(s, SiteId{77}, {}).items.empty());
  });
}

TEST_CASE_FIXTURE(StoreFixture, "old events go, in order and but for the latest, and one record a day says so") {
  const auto happen = [&](std::int64_t second) {
    return store.write([&](Transaction& t) { return insert_event(t, {.at = at_second(second), .type = "test"}); });
  };
  const EventId first = happen(0);
  for (int i = 1; i < 10; ++i) happen(i);
  const auto prune = [&](std::int64_t horizon_s) {
    return store.write(
        [&](Transaction& t) { return prune_logs(t, at_second(horizon_s), at_second(horizon_s + 400 * kDay_s)); });
  };
  CHECK(prune(0) == 0);
  CHECK_FALSE(store.read([&](const Snapshot& s) { return has_old_logs(s, at_second(0)); }));
  CHECK(prune(4) == 4);
  CHECK(store.read([](const Snapshot& s) { return first_event(s); }).value == first.value + 4);
  CHECK(prune(1000) == 5);
  CHECK(store.read([](const Snapshot& s) { return first_event(s) == last_event(s); }));
  const auto records = store.read([](const Snapshot& s) { return list_deletions(s, std::nullopt, {}); }).items;
  REQUIRE(records.size() == 1);
  CHECK(records[0].what == "events");
  CHECK(records[0].records == 9);
}

TEST_CASE_FIXTURE(DailyScans, "growth is told from what was received in the last days") {
  const Time now = scans.back().received_at;
  const Growth growth = store.read([&](const Snapshot& s) { return growth_of(s, site.id, now).value(); });
  CHECK(growth.scans == 8);  // of the days 2 to 9
  CHECK(growth.since == scans[2].received_at);
  std::uint64_t bytes = 0;
  for (std::size_t i = 2; i < scans.size(); ++i) bytes += scans[i].stored_bytes;
  CHECK(growth.bytes == bytes);
  CHECK_FALSE(store.read([&](const Snapshot& s) { return growth_of(s, site.id, now + std::chrono::days(30)); }));
  // What came within minutes tells no rate: a day has to be measured.
  const Site young = add_site(store, "young");
  const Sensor eye = add_sensor(store, "eye", young.id);
  for (const int second : {0, 60}) add_scan(store, eye, {.captured_at = at_second(second)});
  const auto growth_at = [&](std::int64_t second) {
    return store.read([&](const Snapshot& s) { return growth_of(s, young.id, at_second(second)); });
  };
  CHECK_FALSE(growth_at(kDay_s));
  CHECK(growth_at(kDay_s + 1));
}

TEST_CASE_FIXTURE(DailyScans, "while the store is copied deletions wait, and it is known that they do") {
  {
    const DeletionHold copying(store.payloads().impl());
    CHECK(store.payloads().deletions_wait());
    apply(plan({.max_age_days = 8}, 10 * kDay_s));
    CHECK(same_bits(store.payloads().scan_points(scans[0].payload), cloud_of(2000, 0)));
  }
  CHECK_FALSE(store.payloads().deletions_wait());
  CHECK_THROWS_AS(store.payloads().scan_points(scans[0].payload), NotFound);
}

}  // namespace
}  // namespace raywatch
