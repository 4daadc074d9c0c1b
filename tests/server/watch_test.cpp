// What a daemon makes of the scans of a place: what is normal, what lasts, and what is told.

#include <doctest/doctest.h>

#include <algorithm>

#include "server/caretaker.hpp"
#include "tests/server/watched_place.hpp"

namespace raywatch {
namespace {

const WatchedScene kBag{.box_y_m = 0.0};

std::size_t count(const std::vector<std::string>& types, const std::string& type) {
  return static_cast<std::size_t>(std::ranges::count(types, type));
}

ZoneRecord zone(SiteId site, const std::string& name, ZoneKind kind, double from_y_m, double to_y_m) {
  return {.zone = {.kind = kind, .prism = {{{3, from_y_m}, {9, from_y_m}, {9, to_y_m}, {3, to_y_m}}, -1.0, 1.0}},
          .site = site,
          .name = name};
}

ZoneId add_zone(WatchedPlace& place, const std::string& name, ZoneKind kind, double from_y_m, double to_y_m) {
  return place.store()
      .write(
          [&](Transaction& t) { return insert_zone(t, zone(place.site(), name, kind, from_y_m, to_y_m), place.now()); })
      .zone.id;
}

TEST_CASE("the first scans of a place are what is normal, and alerts wait meanwhile") {
  WatchedPlace place;
  place.take();
  place.take({.person_y_m = 2.0});  // somebody passes while the place is learned
  place.take();
  CHECK(place.baseline().size() == 3);
  CHECK(place.tracks().empty());
  CHECK_FALSE(place.watching_changes().empty());  // but what was seen is kept
  const ScanId quiet = place.take();
  CHECK(place.role(quiet) == WatchRole::tracked);
  CHECK(place.baseline().size() == 3);
  CHECK(place.tracks().empty());
  CHECK(count(place.events(), "baseline.learned") == 3);
}

TEST_CASE("who passes while the last scan of the learned ones is taken is not missed later") {
  WatchedPlace place;
  place.take();
  place.take();
  place.take({.person_y_m = 2.0});
  for (int i = 0; i < 4; ++i) place.take();
  CHECK(place.alerts().empty());
  CHECK(place.tracks().empty());
}

TEST_CASE("a bag that is left is one alert, however many scans see it, and it resolves when the bag is gone") {
  WatchedPlace place;
  place.learn();
  const ScanId first = place.take(kBag);
  REQUIRE(place.tracks().size() == 1);
  CHECK(place.tracks().front().track.kind == ChangeKind::added);
  CHECK(place.tracks().front().first_scan == first);
  CHECK(place.alerts().empty());

  const ScanId second = place.take(kBag);
  REQUIRE(place.alerts().size() == 1);
  const AlertRecord opened = place.alerts().front();
  CHECK(opened.state == AlertState::open);
  CHECK(opened.scan == second);
  CHECK(opened.rule_name == "anything that lasts");
  CHECK(opened.title.find("added") != std::string::npos);
  for (int i = 0; i < 5; ++i) place.take(kBag);
  CHECK(place.tracks().size() == 1);
  CHECK(place.tracks().front().track.seen == 7);
  CHECK(place.alerts().size() == 1);

  const ScanId without = place.take();
  CHECK(place.tracks().front().track.state == TrackState::gone);
  CHECK(place.tracks().front().ended_scan == without);
  CHECK(place.alerts().front().state == AlertState::resolved);
  const auto history = place.store().read([&](const Snapshot& s) { return alert_history(s, opened.id); });
  REQUIRE(history.size() == 2);
  CHECK(history.back().by == "raywatch");
  CHECK(history.back().scan == without);
  place.take();
  CHECK(place.alerts().size() == 1);
  CHECK(count(place.events(), "track.started") == 1);
  CHECK(count(place.events(), "track.ended") == 1);
  CHECK(count(place.events(), "alert.opened") == 1);
  CHECK(count(place.events(), "alert.resolved") == 1);
}

TEST_CASE("a person who walks through leaves short tracks and raises nothing") {
  WatchedPlace place;
  place.learn();
  for (double y_m = -3.0; y_m <= 3.0; y_m += 1.5) place.take({.person_y_m = y_m});
  place.take();
  CHECK(place.tracks().size() >= 3);
  for (const TrackRecord& record : place.tracks()) {
    CHECK(record.track.state == TrackState::gone);
    CHECK(record.track.seen == 1);
  }
  CHECK(place.alerts().empty());
}

TEST_CASE("a scan that cannot see the place neither ends a track nor confirms it") {
  WatchedPlace place;
  place.learn();
  place.take(kBag);
  place.take({.box_y_m = 0.0, .screen = true});
  CHECK(place.tracks().front().track.state == TrackState::open);
  CHECK(place.tracks().front().track.seen == 1);
  const auto runs =
      place.store().read([&](const Snapshot& s) { return sight_runs(s, place.tracks().front().track.id); });
  REQUIRE(runs.size() == 2);
  CHECK(runs.back().sight == Sight::unseen);
  place.take(kBag);
  // Seen in two scans that could see it: the screen that stood before it for a moment does not count.
  REQUIRE(place.alerts().size() == 1);
  CHECK(place.alerts().front().track == place.tracks().front().track.id);
}

TEST_CASE("an object that is moved is one removed and one added track, linked") {
  WatchedPlace place;
  for (int i = 0; i < 3; ++i) place.take({.box_y_m = -1.5});
  place.take({.box_y_m = 1.5});
  const auto tracks = place.tracks();
  REQUIRE(tracks.size() == 2);
  const auto& removed = tracks[tracks[0].track.kind == ChangeKind::removed ? 0 : 1];
  const auto& added = tracks[tracks[0].track.kind == ChangeKind::removed ? 1 : 0];
  CHECK(removed.track.kind == ChangeKind::removed);
  CHECK(added.track.kind == ChangeKind::added);
  CHECK(removed.moved_to == added.track.id);
  CHECK(added.moved_from == removed.track.id);
}

TEST_CASE("a late scan is history, and moves no track") {
  WatchedPlace place;
  place.learn();
  place.take();
  place.take(kBag);
  place.take(kBag);
  const ScanId late = place.take_at(-std::chrono::seconds(150));  // a scan from before the bag, without it
  CHECK(place.role(late) == WatchRole::late);
  CHECK(place.tracks().front().track.state == TrackState::open);
  CHECK(place.alerts().front().state == AlertState::open);
}

TEST_CASE("in an ignore zone nothing raises an alert, and the changes are stored all the same") {
  WatchedPlace place;
  add_zone(place, "car park", ZoneKind::ignore, -1.0, 1.0);
  place.learn();
  for (int i = 0; i < 4; ++i) place.take(kBag);
  CHECK(place.alerts().empty());
  CHECK(place.tracks().size() == 1);
  CHECK(place.watching_changes().size() == 4);
}

TEST_CASE("a change in a control zone makes the scan suspect: it moves no track, and the system says so") {
  WatchedPlace place;
  add_zone(place, "post", ZoneKind::control, -1.0, 1.0);
  place.learn();
  const ScanId suspect = place.take(kBag);
  CHECK(place.role(suspect) == WatchRole::suspect);
  CHECK(place.tracks().empty());
  REQUIRE(place.alerts().size() == 1);
  CHECK(place.alerts().front().cause == "control-zone");
  place.take(kBag);
  CHECK(place.alerts().size() == 1);
  place.take();
  CHECK(place.alerts().front().state == AlertState::resolved);
}

TEST_CASE("every zone has a coverage for each scan") {
  WatchedPlace place;
  const ZoneId id = add_zone(place, "gate", ZoneKind::alert, -1.0, 1.0);
  place.learn();
  place.take({.screen = true});
  const auto coverage =
      place.store().read([&](const Snapshot& s) { return list_coverage(s, id, {.limit = 10, .cursor = {}}); }).items;
  REQUIRE(coverage.size() == 4);
  CHECK(coverage.back().share > 0.95);
  CHECK(coverage.front().share < 0.2);
}

TEST_CASE("a place that sees much less of a zone than at first is told, until it sees it again") {
  WatchedPlace place;
  add_zone(place, "gate", ZoneKind::ignore, -1.0, 1.0);  // so that nothing else is told
  place.learn();
  for (int i = 0; i < 3; ++i) place.take();
  place.take({.screen = true});
  CHECK(place.alerts().empty());
  place.take({.screen = true});
  place.take({.screen = true});
  const auto dropped = [](const AlertRecord& alert) { return alert.cause == "coverage-dropped"; };
  REQUIRE(std::ranges::count_if(place.alerts(), dropped) == 1);
  place.take();
  const auto alerts = place.alerts();
  CHECK(std::ranges::find_if(alerts, dropped)->state == AlertState::resolved);
}

TEST_CASE("while a silence holds nothing is raised; when it is over, what still lasts is") {
  WatchedPlace place;
  place.learn();
  place.store().write([&](Transaction& t) {
    SilenceRecord silence{.site = place.site(), .by = "guard", .note = "scaffolding"};
    silence.silence = {.from = place.now(), .until = place.now() + std::chrono::minutes(4)};
    insert_silence(t, silence, place.now());
  });
  for (int i = 0; i < 4; ++i) place.take(kBag);
  CHECK(place.alerts().empty());
  place.take(kBag);
  CHECK(place.alerts().size() == 1);
}

TEST_CASE("a bag that one scan misses stays one alert: it comes back") {
  WatchedPlace place;
  place.learn();
  for (const WatchedScene& scene : {kBag, kBag, WatchedScene{}, kBag, kBag}) place.take(scene);
  REQUIRE(place.alerts().size() == 1);
  CHECK(place.alerts().front().state == AlertState::open);
  CHECK(place.tracks().size() == 1);
  CHECK(count(place.events(), "alert.reopened") == 1);
}

TEST_CASE("a snooze ends by itself, and a sensor that falls silent is told once, until a scan comes") {
  WatchedPlace place;
  place.learn();
  place.take(kBag);
  place.take(kBag);
  const AlertId alert = place.alerts().front().id;
  place.store().write([&](Transaction& t) {
    change_alert(t, alert,
                 {.action = "snoozed",
                  .by = "anna",
                  .at = place.now(),
                  .state = AlertState::snoozed,
                  .snoozed_until = place.now() + std::chrono::minutes(1)});
    edit_sensor(t, find_sensor(t, "mast")->id, {.interval_s = std::optional(60.0)});
  });
  Caretaker caretaker(place.store(), {.low_disk_bytes = 0});
  caretaker.look_after(place.now());
  CHECK(place.alerts().front().state == AlertState::snoozed);
  caretaker.look_after(place.now() + std::chrono::minutes(1));
  CHECK(place.alerts().front().state == AlertState::open);
  CHECK(place.alerts().size() == 1);

  caretaker.look_after(place.now() + std::chrono::minutes(3));
  caretaker.look_after(place.now() + std::chrono::minutes(4));
  REQUIRE(place.alerts().size() == 2);
  CHECK(place.alerts().back().cause == "sensor-silent");
  CHECK(place.alerts().back().state == AlertState::open);
  place.take(kBag);
  caretaker.look_after(place.now());
  CHECK(place.alerts().back().state == AlertState::resolved);
  CHECK(place.alerts().front().state == AlertState::open);
}

TEST_CASE("a disk that fills up is told, and that there is room again") {
  WatchedPlace place;
  Caretaker(place.store(), {.low_disk_bytes = std::uint64_t{1} << 62}).look_after(place.now());
  REQUIRE(place.alerts().size() == 1);
  CHECK(place.alerts().front().cause == "disk-low");
  Caretaker(place.store(), {.low_disk_bytes = 0}).look_after(place.now());
  CHECK(place.alerts().front().state == AlertState::resolved);
}

TEST_CASE("what a scan shows against the one before belongs to the same track as what it shows against the baseline") {
  WatchedPlace place;
  place.learn();
  place.take(kBag);
  const auto previous = place.store().read(
      [&](const Snapshot& s) { return list_changes(s, {.site = place.site()}, {.limit = 10, .cursor = {}}); });
  REQUIRE(previous.items.size() == 1);
  CHECK(previous.items.front().track == place.tracks().front().track.id);
}

}  // namespace
}  // namespace raywatch
