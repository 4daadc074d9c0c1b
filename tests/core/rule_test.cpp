#include "core/rule.hpp"

#include <doctest/doctest.h>
#include <rapidcheck.h>

#include <map>

#include "core/error.hpp"

namespace raywatch {
namespace {

using namespace std::chrono_literals;

constexpr Time kStart{std::chrono::sys_days{std::chrono::year{2026} / 3 / 1}};
constexpr SensorId kMast{1}, kGate{2};

Change bag(ChangeKind kind = ChangeKind::added) {
  Change change{.kind = kind, .centroid_m = {5, 5, 0.2}, .volume_m3 = 0.03, .points = 50};
  change.bounds_m = Eigen::AlignedBox3d(Eigen::Vector3d(4.8, 4.8, 0.0), Eigen::Vector3d(5.2, 5.2, 0.4));
  change.box = {change.centroid_m, {0.4, 0.4, 0.4}, Eigen::Quaterniond::Identity()};
  return change;
}

/// A bag that was seen once a minute, so many times.
Track bag_seen(int times) {
  Track track = begin_track(bag(), {}, kStart);
  track.id = TrackId{1};
  for (int i = 1; i < times; ++i) see_still(track, kStart + i * 1min);
  return track;
}

Zone zone(std::int64_t id, ZoneKind kind, double from_m, double to_m) {
  return {ZoneId{id}, kind, {{{from_m, from_m}, {to_m, from_m}, {to_m, to_m}, {from_m, to_m}}, -1.0, 3.0}};
}

Rule rule(std::uint32_t scans = 2, std::uint32_t of = 3, double seconds = 0.0) {
  return {.id = RuleId{1}, .persistence = {scans, of, seconds}};
}

JudgedScan scan_at(Time at, SensorId sensor = kMast) { return {.at = at, .local = {}, .sensor = sensor}; }

bool raised(const Rule& by, const Track& track, const Rulebook& book = {}) {
  return raises(by, track, scan_at(track.last_told_at), book);
}

TEST_CASE("a change must last: in scans that could see it, and in time") {
  CHECK_FALSE(raised(rule(2, 3), bag_seen(1)));
  CHECK(raised(rule(2, 3), bag_seen(2)));
  CHECK_FALSE(raised(rule(2, 3, 61.0), bag_seen(2)));
  CHECK(raised(rule(2, 3, 60.0), bag_seen(2)));
  Track flickering = bag_seen(2);
  miss(flickering, kStart + 2min);
  see_still(flickering, kStart + 3min);
  CHECK_FALSE(raised(rule(3, 3), flickering));
  CHECK(raised(rule(3, 4), flickering));
}

TEST_CASE("a rule asks for kinds and sizes") {
  Rule by = rule(1, 1);
  by.min_points = 50, by.min_volume_m3 = 0.03, by.min_extent_m = 0.4;
  CHECK(raised(by, bag_seen(1)));
  for (const auto& change : std::vector<std::function<void(Rule&)>>{
           [](Rule& r) { r.min_points = 51; }, [](Rule& r) { r.min_volume_m3 = 0.031; },
           [](Rule& r) { r.min_extent_m = 0.41; }, [](Rule& r) { r.added = false; }, [](Rule& r) { r.enabled = false; },
           [](Rule& r) { r.zone = ZoneId{9}; }}) {
    Rule stricter = by;
    change(stricter);
    CHECK_FALSE(raised(stricter, bag_seen(1)));
  }
}

TEST_CASE("a rule of a zone looks into it only, and an ignore zone beats it") {
  Rule by = rule(1, 1);
  by.zone = ZoneId{1};
  CHECK(raised(by, bag_seen(1), {.zones = {zone(1, ZoneKind::alert, 0.0, 6.0)}}));
  CHECK_FALSE(raised(by, bag_seen(1), {.zones = {zone(1, ZoneKind::alert, 0.0, 4.0)}}));
  CHECK_FALSE(
      raised(by, bag_seen(1), {.zones = {zone(1, ZoneKind::alert, 0.0, 6.0), zone(2, ZoneKind::ignore, 4.0, 6.0)}}));
  CHECK(raised(by, bag_seen(1), {.zones = {zone(1, ZoneKind::alert, 0.0, 6.0), zone(2, ZoneKind::ignore, 6.0, 8.0)}}));
}

TEST_CASE("a rule holds within its hours") {
  Rule by = rule(1, 1);
  by.schedule = {{.from_minute = 22 * 60, .to_minute = 6 * 60}};
  CHECK(raises(by, bag_seen(1), {.at = kStart, .local = {.weekday = 0, .second = 23 * 3600}}, {}));
  CHECK_FALSE(raises(by, bag_seen(1), {.at = kStart, .local = {.weekday = 0, .second = 12 * 3600}}, {}));
}

TEST_CASE("a silence of a zone, of a sensor or of everything holds from its beginning until before its end") {
  const Zone near = zone(1, ZoneKind::alert, 4.0, 6.0), far = zone(2, ZoneKind::alert, 8.0, 9.0);
  const auto silent = [&](const Silence& silence, Time at) {
    return !raises(rule(1, 1), bag_seen(1), scan_at(at), {.zones = {near, far}, .silences = {silence}});
  };
  const Silence all{.from = kStart, .until = kStart + 1h};
  CHECK(silent(all, kStart));
  CHECK_FALSE(silent(all, kStart - 1ns));
  CHECK_FALSE(silent(all, kStart + 1h));
  CHECK(silent({.zone = near.id, .from = kStart, .until = kStart + 1h}, kStart));
  CHECK_FALSE(silent({.zone = far.id, .from = kStart, .until = kStart + 1h}, kStart));
  CHECK(silent({.sensor = kMast, .from = kStart, .until = kStart + 1h}, kStart));
  CHECK_FALSE(silent({.sensor = kGate, .from = kStart, .until = kStart + 1h}, kStart));
}

StandingAlert standing(AlertState state, Severity severity = Severity::warning) {
  return {.id = AlertId{7}, .track = TrackId{1}, .rule = RuleId{1}, .state = state, .severity = severity};
}

std::vector<AlertStep> judged(const Track& track, Sight sight, const std::vector<StandingAlert>& alerts,
                              const Rule& by = rule(1, 1)) {
  return judge(scan_at(track.last_told_at), std::vector<TrackSight>{{track, sight}}, {.rules = {by}}, alerts);
}

TEST_CASE("a track raises one alert by a rule, whatever state that alert is in") {
  const Track track = bag_seen(3);
  REQUIRE(judged(track, Sight::seen, {}).size() == 1);
  CHECK(judged(track, Sight::seen, {}).front().kind == AlertStep::Kind::open);
  for (const AlertState state :
       {AlertState::open, AlertState::acknowledged, AlertState::snoozed, AlertState::resolved}) {
    CHECK(judged(track, Sight::seen, {standing(state)}).empty());
  }
}

TEST_CASE("an alert resolves when its change is gone, unless an operator is to do that, and comes back with it") {
  Track track = bag_seen(3);
  miss(track, kStart + 3min);
  const auto steps = judged(track, Sight::absent, {standing(AlertState::acknowledged)});
  REQUIRE(steps.size() == 1);
  CHECK(steps.front().kind == AlertStep::Kind::resolve);
  CHECK(steps.front().alert == AlertId{7});
  StandingAlert manual = standing(AlertState::open);
  manual.auto_resolve = false;
  CHECK(judged(track, Sight::absent, {manual}).empty());

  see_still(track, kStart + 4min);
  StandingAlert resolved = standing(AlertState::resolved);
  resolved.resolved_as_gone = true;
  const auto back = judged(track, Sight::seen, {resolved});
  REQUIRE(back.size() == 1);
  CHECK(back.front().kind == AlertStep::Kind::reopen);
}

TEST_CASE("severity rises with the rule and never falls") {
  Rule by = rule(1, 1);
  by.severity = Severity::critical;
  const auto steps = judged(bag_seen(1), Sight::seen, {standing(AlertState::acknowledged)}, by);
  REQUIRE(steps.size() == 1);
  CHECK(steps.front().kind == AlertStep::Kind::raise);
  CHECK(steps.front().severity == Severity::critical);
  by.severity = Severity::info;
  CHECK(judged(bag_seen(1), Sight::seen, {standing(AlertState::open)}, by).empty());
}

TEST_CASE("over any history there is at most one alert that stands, opened when its condition first held") {
  CHECK(rc::check([](const std::vector<bool>& sights) {
    const Rule by = rule(2, 3);
    Track track = begin_track(bag(), {}, kStart);
    track.id = TrackId{1};
    std::vector<StandingAlert> alerts;
    Time at = kStart;
    for (const bool seen : sights) {
      if (!is_followed(track)) break;
      at += 1min;
      seen ? see_still(track, at) : miss(track, at);
      const auto steps = judged(track, seen ? Sight::seen : Sight::absent, alerts, by);
      RC_ASSERT(steps.size() <= 1);
      if (steps.empty()) continue;
      switch (steps.front().kind) {
        case AlertStep::Kind::open:
          RC_ASSERT(alerts.empty());
          alerts.push_back(standing(AlertState::open));
          break;
        case AlertStep::Kind::reopen:
          RC_ASSERT(alerts.front().resolved_as_gone);
          alerts.front() = standing(AlertState::open);
          break;
        case AlertStep::Kind::resolve:
          RC_ASSERT(alerts.front().state == AlertState::open);
          alerts.front().state = AlertState::resolved;
          alerts.front().resolved_as_gone = true;
          break;
        case AlertStep::Kind::raise:
          RC_FAIL("the severity did not change");
      }
      RC_ASSERT(alerts.empty() || (alerts.front().state == AlertState::open) == seen || !raised(by, track));
    }
  }));
}

TEST_CASE("a rule that cannot work is refused by name") {
  const auto complaint = [](Rule by) {
    try {
      check_rule(by);
    } catch (const InvalidInput& error) {
      return error.fields().front().field;
    }
    return std::string("none");
  };
  CHECK(complaint(rule(3, 5, 30.0)) == "none");
  CHECK(complaint(rule(4, 3)) == "persistence.scans");
  CHECK(complaint(rule(0, 3)) == "persistence.scans");
  CHECK(complaint(rule(1, 65)) == "persistence.of");
  CHECK(complaint(rule(1, 1, -1.0)) == "persistence.seconds");
  Rule nothing = rule();
  nothing.added = nothing.removed = false;
  CHECK(complaint(nothing) == "kinds");
}

}  // namespace
}  // namespace raywatch
