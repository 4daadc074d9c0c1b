#include "storage/tracks.hpp"

#include <doctest/doctest.h>
#include <rapidcheck.h>

#include "tests/storage/store_fixture.hpp"

namespace raywatch {
namespace {

TrackRecord track_of(SiteId site, int second) {
  TrackRecord record{.track = begin_track(change_at({1.5, 2.5, 3.5}, ChangeKind::removed),
                                          {Eigen::Vector3f(1, 2, 3), Eigen::Vector3f(4, 5, 6)}, at_second(second)),
                     .site = site,
                     .first_scan = ScanId{3},
                     .last_scan = ScanId{4},
                     .ended_scan = {},
                     .latest_change = ChangeId{9}};
  return record;
}

TEST_CASE_FIXTURE(StoreFixture, "a track comes back as it was put, and as it was brought up to date") {
  TrackRecord record = track_of(site.id, 10);
  record.track.id = store.write([&](Transaction& t) { return insert_track(t, record); });
  const auto found = [&] {
    return store.read([&](const Snapshot& s) { return find_track(s, record.track.id).value(); });
  };
  CHECK(found().track.kind == ChangeKind::removed);
  CHECK(found().track.sample_m == record.track.sample_m);
  CHECK(found().track.anchor_m.min() == record.track.anchor_m.min());
  CHECK(found().track.latest.centroid_m == Eigen::Vector3d(1.5, 2.5, 3.5));
  CHECK(found().first_scan == ScanId{3});
  CHECK(found().latest_change == ChangeId{9});

  for (int i = 0; i < 70; ++i) see_still(record.track, at_second(11 + i));
  miss(record.track, at_second(90));
  record.ended_scan = ScanId{8};
  store.write([&](Transaction& t) { update_track(t, record); });
  CHECK(found().track.recent == record.track.recent);
  CHECK(found().track.remembered == 64);
  CHECK(found().track.state == TrackState::gone);
  CHECK(found().track.ended_at == at_second(90));
  CHECK(found().track.seen == 71);
  CHECK(found().track.absent == 1);
  CHECK(found().ended_scan == ScanId{8});
}

TEST_CASE_FIXTURE(StoreFixture, "tracks are listed by kind, and by the time in which they were seen") {
  TrackRecord early = track_of(site.id, 10), late = track_of(site.id, 50);
  see_still(early.track, at_second(20));
  early.track.kind = early.track.latest.kind = ChangeKind::added;
  for (TrackRecord* each : {&early, &late}) {
    each->track.id = store.write([&](Transaction& t) { return insert_track(t, *each); });
  }
  const auto found = [&](const TrackFilter& filter) {
    std::vector<TrackId> ids;
    store.read([&](const Snapshot& s) {
      for (const TrackRecord& each : list_tracks(s, filter, {}).items) ids.push_back(each.track.id);
    });
    return ids;
  };
  using Ids = std::vector<TrackId>;
  CHECK(found({}) == Ids{late.track.id, early.track.id});
  CHECK(found({.kind = ChangeKind::added}) == Ids{early.track.id});
  CHECK(found({.site = site.id, .state = TrackState::open, .kind = ChangeKind::removed}) == Ids{late.track.id});
  CHECK(found({.from = at_second(20)}) == Ids{late.track.id, early.track.id});
  CHECK(found({.from = at_second(21)}) == Ids{late.track.id});
  CHECK(found({.from = at_second(0), .to = at_second(50)}) == Ids{early.track.id});
}

TEST_CASE_FIXTURE(StoreFixture, "only what later scans may add to is followed") {
  const auto insert = [&](const TrackRecord& record) {
    return store.write([&](Transaction& t) { return insert_track(t, record); });
  };
  TrackRecord open = track_of(site.id, 0), missed = track_of(site.id, 1), over = track_of(site.id, 2);
  miss(missed.track, at_second(5));
  miss(over.track, at_second(5));
  miss(over.track, at_second(6));
  const TrackId first = insert(open), second = insert(missed);
  insert(over);
  store.read([&](const Snapshot& s) {
    const auto followed = followed_tracks(s, site.id);
    REQUIRE(followed.size() == 2);
    CHECK(followed[0].track.id == first);
    CHECK(followed[1].track.id == second);
    CHECK(list_tracks(s, {.site = site.id}, {}).items.size() == 3);
    CHECK(list_tracks(s, {.site = site.id, .state = TrackState::gone}, {}).items.size() == 2);
    CHECK(list_tracks(s, {.state = TrackState::open}, {}).items.size() == 1);
    CHECK(tracks_begun(s, site.id, at_second(1), at_second(1)).size() == 1);
  });
}

TEST_CASE_FIXTURE(StoreFixture,
                  "sights are kept as runs, and come back one by one in the order in which they were seen") {
  CHECK(rc::check([&](const std::vector<std::pair<bool, std::uint8_t>>& seen) {
    store.write([&](Transaction& t) {
      TrackRecord record = track_of(site.id, 0);
      const TrackId track = insert_track(t, record);
      std::vector<std::pair<std::int64_t, Sight>> told;
      int number = 0;
      for (const auto& [second_vantage, what] : seen) {
        WatchedScan scan{.scan = ScanId{++number},
                         .site = site.id,
                         .sensor = sensor.id,
                         .vantage = VantageId{track.value * 2 + (second_vantage ? 1 : 0)},
                         .captured_at = at_second(number)};
        scan.turn = insert_watched_scan(t, scan);
        const Sight sight = std::array{Sight::seen, Sight::absent, Sight::unseen}[what % 3];
        note_sight(t, track, scan, sight);
        if (sight != Sight::unseen) told.emplace_back(scan.turn, sight);
      }
      std::vector<std::pair<std::int64_t, Sight>> found;
      for (const SightOfScan& sight : telling_sights(t, track)) found.emplace_back(sight.turn, sight.sight);
      RC_ASSERT(found == told);
      std::uint64_t scans = 0;
      for (const SightRun& run : sight_runs(t, track)) scans += run.scans;
      RC_ASSERT(scans == seen.size());
    });
  }));
}

TEST_CASE_FIXTURE(StoreFixture, "what was moved is linked on both sides") {
  store.write([&](Transaction& t) {
    const TrackId from = insert_track(t, track_of(site.id, 0)), to = insert_track(t, track_of(site.id, 1));
    link_moved(t, from, to);
    CHECK(find_track(t, from)->moved_to == to);
    CHECK(find_track(t, to)->moved_from == from);
  });
}

TEST_CASE_FIXTURE(StoreFixture, "how far a site and a sensor were tracked is known by the scans that told something") {
  const auto watch = [&](int second, WatchRole role) {
    store.write([&](Transaction& t) {
      insert_watched_scan(t, {.scan = ScanId{second},
                              .site = site.id,
                              .sensor = sensor.id,
                              .captured_at = at_second(second),
                              .role = role});
    });
  };
  CHECK_FALSE(store.read([&](const Snapshot& s) { return tracked_until(s, site.id); }));
  watch(5, WatchRole::tracked);
  watch(9, WatchRole::suspect);
  CHECK(store.read([&](const Snapshot& s) { return tracked_until(s, site.id); }) == at_second(5));
  CHECK(store.read([&](const Snapshot& s) { return tracked_until(s, sensor.id); }) == at_second(5));
  CHECK(store.read([&](const Snapshot& s) { return find_watched_scan(s, ScanId{9})->role; }) == WatchRole::suspect);
}

}  // namespace
}  // namespace raywatch
