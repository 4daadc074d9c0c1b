// Zones, rules, silences, baselines, alerts and events as stored.

#include <doctest/doctest.h>

#include "storage/alerts.hpp"
#include "storage/baselines.hpp"
#include "storage/events.hpp"
#include "storage/local_time.hpp"
#include "storage/migrations.hpp"
#include "storage/rules.hpp"
#include "storage/zones.hpp"
#include "tests/storage/store_fixture.hpp"

namespace raywatch {
namespace {

ZoneRecord gate_of(SiteId site, const std::string& name = "gate") {
  return {.zone = {.kind = ZoneKind::alert, .prism = {{{0, 0}, {4.5, 0}, {0, 3.25}}, -1.0, 2.5}},
          .site = site,
          .name = name};
}

TEST_CASE_FIXTURE(StoreFixture, "a zone comes back as it was put, can be replaced, and its name is the site's own") {
  const ZoneRecord zone = store.write([&](Transaction& t) { return insert_zone(t, gate_of(site.id), at_second(1)); });
  CHECK(zone.zone.prism.polygon_m == gate_of(site.id).zone.prism.polygon_m);
  CHECK(zone.zone.prism.z_max_m == 2.5);
  CHECK_THROWS_AS(store.write([&](Transaction& t) { insert_zone(t, gate_of(site.id), at_second(2)); }), Conflict);
  ZoneRecord moved = zone;
  moved.zone.kind = ZoneKind::ignore;
  moved.zone.prism.z_min_m = 0.0;
  store.write([&](Transaction& t) { replace_zone(t, moved, at_second(3)); });
  const ZoneRecord found = store.read([&](const Snapshot& s) { return find_zone(s, site.id, "gate").value(); });
  CHECK(found.zone.id == zone.zone.id);
  CHECK(found.zone.kind == ZoneKind::ignore);
  CHECK(found.zone.prism.z_min_m == 0.0);
  CHECK(found.created_at == at_second(1));
  CHECK(found.edited_at == at_second(3));
}

TEST_CASE_FIXTURE(StoreFixture, "a rule keeps all that it says, and a zone that a rule looks into stays") {
  const ZoneId zone =
      store.write([&](Transaction& t) { return insert_zone(t, gate_of(site.id), at_second(1)).zone.id; });
  RuleRecord rule{.site = site.id, .name = "night"};
  rule.rule = {
      .zone = zone,
      .added = true,
      .removed = false,
      .min_points = 12,
      .min_volume_m3 = 0.25,
      .min_extent_m = 0.5,
      .persistence = {3, 5, 30.5},
      .severity = Severity::critical,
      .schedule = {{.days = {true, false, true, false, true, false, true}, .from_minute = 1320, .to_minute = 360}},
      .enabled = false,
      .auto_resolve = false};
  const RuleRecord stored = store.write([&](Transaction& t) { return insert_rule(t, rule, at_second(1)); });
  const Rule& back = stored.rule;
  CHECK(back.zone == zone);
  CHECK_FALSE(back.removed);
  CHECK(back.min_points == 12);
  CHECK(back.min_volume_m3 == 0.25);
  CHECK(back.min_extent_m == 0.5);
  CHECK(back.persistence.scans == 3);
  CHECK(back.persistence.of == 5);
  CHECK(back.persistence.seconds == 30.5);
  CHECK(back.severity == Severity::critical);
  REQUIRE(back.schedule.size() == 1);
  CHECK(back.schedule[0].days == rule.rule.schedule[0].days);
  CHECK(back.schedule[0].to_minute == 360);
  CHECK_FALSE(back.enabled);
  CHECK_FALSE(back.auto_resolve);
  CHECK_THROWS_AS(store.write([&](Transaction& t) { delete_zone(t, zone); }), Conflict);
  store.write([&](Transaction& t) {
    delete_rule(t, stored.rule.id);
    delete_zone(t, zone);
  });
  CHECK(store.read([&](const Snapshot& s) { return rules_of(s, site.id); }).empty());
}

TEST_CASE_FIXTURE(StoreFixture, "a rule cannot look into a zone of another site") {
  const SiteId other = add_site(store, "other").id;
  const ZoneId zone = store.write([&](Transaction& t) { return insert_zone(t, gate_of(other), at_second(1)).zone.id; });
  RuleRecord rule{.site = site.id, .name = "night"};
  rule.rule.zone = zone;
  CHECK_THROWS_AS(store.write([&](Transaction& t) { insert_rule(t, rule, at_second(1)); }), NotFound);
}

TEST_CASE_FIXTURE(StoreFixture, "a rulebook holds the silences that are not over") {
  const auto silence = [&](int from, int until) {
    SilenceRecord record{.site = site.id, .by = "anna", .note = "works"};
    record.silence = {.sensor = sensor.id, .from = at_second(from), .until = at_second(until)};
    return store.write([&](Transaction& t) { return insert_silence(t, record, at_second(0)); });
  };
  silence(0, 10);
  const SilenceRecord later = silence(20, 30);
  CHECK(store.read([&](const Snapshot& s) { return rulebook_of(s, site.id, at_second(5)); }).silences.size() == 2);
  CHECK(store.read([&](const Snapshot& s) { return rulebook_of(s, site.id, at_second(10)); }).silences.size() == 1);
  CHECK(later.silence.sensor == sensor.id);
  CHECK(later.note == "works");
  store.write([&](Transaction& t) { delete_silence(t, later.id); });
  CHECK(store.read([&](const Snapshot& s) { return list_silences(s, site.id, {}); }).items.size() == 1);
}

TEST_CASE_FIXTURE(StoreFixture,
                  "every version of a baseline stays readable, and its scans cannot be deleted while they are normal") {
  const ScanRecord first = add_scan(store, sensor, {at_second(0)});
  const ScanRecord second = add_scan(store, sensor, {at_second(1)});
  const Eigen::AlignedBox3d region_m(Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(1, 2, 3));
  const auto edit = [&](const BaselineEdit& what) {
    return store.write([&](Transaction& t) { return edit_baseline(t, site.id, what, at_second(9)); }).version;
  };
  CHECK(edit({.kind = "learned", .by = "raywatch", .add = {{.scan = first.id, .vantage = first.vantage}}}) == 1);
  CHECK(edit({.kind = "accepted",
              .by = "anna",
              .note = "the new bench",
              .add = {{.scan = second.id,
                       .vantage = second.vantage,
                       .origin = BaselineOrigin::accepted,
                       .region_m = region_m}}}) == 2);
  CHECK_THROWS_AS(store.write([&](Transaction& t) { delete_scan(t, first.id); }), Conflict);
  CHECK(edit({.kind = "emptied", .by = "anna", .clear = true}) == 3);

  store.read([&](const Snapshot& s) {
    CHECK(baseline_entries(s, site.id, 1).size() == 1);
    const auto entries = baseline_entries(s, site.id, 2);
    REQUIRE(entries.size() == 2);
    CHECK_FALSE(entries[0].region_m);
    REQUIRE(entries[1].region_m);
    CHECK(entries[1].region_m->max() == region_m.max());
    CHECK(entries[1].origin == BaselineOrigin::accepted);
    CHECK(baseline_entries(s, site.id, 3).empty());
    CHECK(baseline_of_vantage(s, site.id, first.vantage).empty());
    CHECK(baseline_patches(s, site.id).empty());
    const auto versions = list_baselines(s, site.id, {}).items;
    REQUIRE(versions.size() == 3);
    CHECK(versions[1].note == "the new bench");
    CHECK(latest_baselines(s, {}).items.size() == 1);
  });
  CHECK_NOTHROW(store.write([&](Transaction& t) { delete_scan(t, first.id); }));
}

TEST_CASE_FIXTURE(StoreFixture, "every step of an alert is kept, and is an event") {
  const AlertRecord alert = store.write([&](Transaction& t) {
    return open_alert(
        t, {.site = site.id, .title = "a bag", .track = TrackId{5}, .rule = RuleId{7}, .opened_at = at_second(1)},
        "twice in a row");
  });
  store.write([&](Transaction& t) {
    change_alert(t, alert.id,
                 {.action = "acknowledged",
                  .by = "anna",
                  .note = "on my way",
                  .at = at_second(2),
                  .state = AlertState::acknowledged});
    change_alert(t, alert.id,
                 {.action = "snoozed",
                  .by = "anna",
                  .at = at_second(3),
                  .state = AlertState::snoozed,
                  .snoozed_until = at_second(60)});
  });
  store.read([&](const Snapshot& s) {
    const auto history = alert_history(s, alert.id);
    REQUIRE(history.size() == 3);
    CHECK(history[0].action == "opened");
    CHECK(history[1].note == "on my way");
    CHECK(history[1].state == AlertState::acknowledged);
    CHECK(find_alert(s, alert.id)->state == AlertState::snoozed);
    CHECK(snoozed_until(s, at_second(59)).empty());
    CHECK(snoozed_until(s, at_second(60)).size() == 1);
    CHECK(alerts_of(s, TrackId{5}).size() == 1);
    const auto events = events_after(s, EventId{}, site.id, 10);
    REQUIRE(events.size() == 3);
    CHECK(events[2].type == "alert.snoozed");
    CHECK(events[2].alert == alert.id);
    CHECK(events_after(s, events[1].id, site.id, 10).size() == 1);
    CHECK(last_event(s) == events[2].id);
  });
}

TEST_CASE_FIXTURE(StoreFixture, "one alert a track and rule, and one that stands a cause and subject") {
  const AlertRecord of_track{.site = site.id, .track = TrackId{5}, .rule = RuleId{7}};
  const AlertRecord of_system{.site = site.id, .cause = "sensor-silent", .subject = "door"};
  const auto open = [&](const AlertRecord& alert) {
    return store.write([&](Transaction& t) { return open_alert(t, alert, "").id; });
  };
  open(of_track);
  const AlertId silent = open(of_system);
  CHECK_THROWS_AS(open(of_track), StorageError);
  CHECK_THROWS_AS(open(of_system), StorageError);
  store.write([&](Transaction& t) {
    change_alert(t, silent, {.action = "resolved", .by = "raywatch", .state = AlertState::resolved});
  });
  CHECK_NOTHROW(open(of_system));
}

TEST_CASE_FIXTURE(StoreFixture, "what a transaction that fails tells about is no event") {
  try {
    store.write([&](Transaction& t) {
      insert_event(t, {.type = "scan.stored", .site = site.id});
      throw Conflict("no");
    });
  } catch (const Conflict&) {
  }
  CHECK(store.read([&](const Snapshot& s) { return last_event(s); }) == EventId{});
}

TEST_CASE("a site goes with all that was watched there") {
  StoreFixture f;
  f.store.write([&](Transaction& t) {
    insert_rule(t, default_rule(f.site.id, Profile::indoor), at_second(0));
    insert_zone(t, gate_of(f.site.id), at_second(0));
    edit_baseline(t, f.site.id, {.kind = "emptied", .by = "anna"}, at_second(0));
    open_alert(t, {.site = f.site.id, .cause = "disk", .subject = "disk"}, "");
    delete_sensor(t, f.sensor.id);
    delete_site(t, f.site.id);
  });
  CHECK(f.store.read([&](const Snapshot& s) { return list_alerts(s, {}, {}); }).items.empty());
}

TEST_CASE("a store from before there was watching gets a rule for each of its sites") {
  const TempDir directory;
  {
    Database database(directory / "raywatch.db", Database::Access::create);
    Migrations before = metadata_migrations();
    before.steps = before.steps.first(2);
    migrate(database, before, CopyBefore::no);
    database.run("INSERT INTO sites (name, time_zone, profile, created_at) VALUES ('yard', 'UTC', 'outdoor', 0)");
    database.run("INSERT INTO sites (name, time_zone, profile, created_at) VALUES ('mine', 'UTC', 'survey', 0)");
  }
  Store store(options_for(directory.path()));
  store.read([&](const Snapshot& s) {
    for (const auto& [name, profile] : {std::pair("yard", Profile::outdoor), std::pair("mine", Profile::survey)}) {
      const SiteId site = find_site(s, name)->id;
      const auto rules = rules_of(s, site);
      REQUIRE(rules.size() == 1);
      const RuleRecord usual = default_rule(site, profile);
      CHECK(rules[0].name == usual.name);
      CHECK(rules[0].rule.persistence.scans == usual.rule.persistence.scans);
      CHECK(rules[0].rule.persistence.of == usual.rule.persistence.of);
      CHECK(rules[0].rule.persistence.seconds == usual.rule.persistence.seconds);
      CHECK(rules[0].rule.severity == usual.rule.severity);
      CHECK(rules[0].rule.auto_resolve);
    }
  });
}

TEST_CASE("clocks show the time of their zone, also when summer begins") {
  const LocalMoment winter = local_moment(parse_rfc3339("2026-03-29T00:59:59Z"), "Europe/Berlin");
  CHECK(winter.weekday == 6);
  CHECK(winter.second == 1 * 3600 + 59 * 60 + 59);
  CHECK(local_moment(parse_rfc3339("2026-03-29T01:00:00Z"), "Europe/Berlin").second == 3 * 3600);
  CHECK(local_moment(parse_rfc3339("2026-03-29T22:30:00Z"), "Europe/Berlin").weekday == 0);
  CHECK(local_moment(parse_rfc3339("2026-03-29T01:00:00.9Z"), "UTC").second == 3600);
  CHECK_THROWS_AS(local_moment(Time{}, "Mars/Olympus"), InvalidInput);
}

}  // namespace
}  // namespace raywatch
