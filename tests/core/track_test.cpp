#include "core/track.hpp"

#include <doctest/doctest.h>
#include <rapidcheck.h>

#include <algorithm>

namespace raywatch {
namespace {

using namespace std::chrono_literals;

constexpr Time kStart{std::chrono::sys_days{std::chrono::year{2026} / 3 / 1}};

Change box_at(const Eigen::Vector3d& place_m, const Eigen::Vector3d& size_m = {0.5, 0.5, 0.5},
              ChangeKind kind = ChangeKind::added) {
  Change change{.kind = kind, .centroid_m = place_m, .points = 50};
  change.bounds_m = Eigen::AlignedBox3d(place_m - 0.5 * size_m, place_m + 0.5 * size_m);
  change.box = {place_m, size_m, Eigen::Quaterniond::Identity()};
  change.volume_m3 = size_m.prod();
  return change;
}

Track track_at(const Eigen::Vector3d& place_m) { return begin_track(box_at(place_m), {}, kStart); }

using Placed = std::optional<std::size_t>;

TEST_CASE("a change goes to the track at its place, one elsewhere to none, and one of another kind to none") {
  const std::vector<Track> tracks{track_at({0, 0, 0}), track_at({5, 0, 0})};
  const std::vector<Change> changes{box_at({5.1, 0, 0}), box_at({0.1, 0, 0}), box_at({9, 0, 0}),
                                    box_at({0, 0, 0}, {0.5, 0.5, 0.5}, ChangeKind::removed)};
  CHECK(associate(tracks, changes) == std::vector<Placed>{1, 0, std::nullopt, std::nullopt});
}

TEST_CASE("the sides of one thing that two places see belong to one track") {
  // A crate of one metre: its near face, and from the other side its far face.
  const std::vector<Track> tracks{begin_track(box_at({0.0, 0, 0}, {0.02, 1.0, 1.0}), {}, kStart)};
  CHECK(associate(tracks, std::vector{box_at({1.0, 0, 0}, {0.02, 1.0, 1.0})}) == std::vector<Placed>{0});
}

TEST_CASE("a second thing beside the first is a new one; a fragment that touches it is not") {
  const std::vector<Track> tracks{track_at({0, 0, 0})};
  const std::vector<Change> beside{box_at({0.02, 0, 0}), box_at({0.8, 0, 0})};
  CHECK(associate(tracks, beside) == std::vector<Placed>{0, std::nullopt});
  const std::vector<Change> fragments{box_at({0, 0, 0.2}, {0.5, 0.5, 0.1}), box_at({0, 0, -0.2}, {0.5, 0.5, 0.1})};
  CHECK(associate(tracks, fragments) == std::vector<Placed>{0, 0});
}

TEST_CASE("fragments of a new thing become one track, the largest first") {
  Change shoe = box_at({0, 0, -0.4}, {0.1, 0.1, 0.1}), elsewhere = box_at({5, 0, 0});
  shoe.points = 10;
  elsewhere.points = 60;
  const std::vector<Change> changes{shoe, box_at({0, 0, 0}), elsewhere};
  using Groups = std::vector<std::vector<std::size_t>>;
  CHECK(group_fragments(changes, std::vector<std::size_t>{0, 1, 2}) == Groups{{2}, {1, 0}});
  CHECK(group_fragments(changes, std::vector<std::size_t>{}) == Groups{});
}

TEST_CASE("what moves on leaves its track behind: a track stays where it began") {
  Track track = track_at({0, 0, 0});
  double x_m = 0.0;
  int followed = 0;
  while (associate(std::vector{track}, std::vector{box_at({x_m += 0.1, 0, 0})}).front()) {
    see(track, box_at({x_m, 0, 0}), {}, kStart);
    REQUIRE(++followed < 20);
  }
  CHECK(x_m < 1.2);
}

TEST_CASE("each track takes one change, the nearest pairs first, whatever the order of the lists is") {
  CHECK(rc::check([] {
    const auto places = [](int count) {
      std::vector<Eigen::Vector3d> result;
      for (int i = 0; i < count; ++i) {
        result.emplace_back(*rc::gen::inRange(0, 400) / 100.0, *rc::gen::inRange(0, 400) / 100.0, 1e-4 * i);
      }
      return result;
    };
    std::vector<Track> tracks;
    for (const auto& place_m : places(*rc::gen::inRange(0, 6))) tracks.push_back(track_at(place_m));
    std::vector<Change> changes;
    for (const auto& place_m : places(*rc::gen::inRange(0, 6))) changes.push_back(box_at(place_m, {0.1, 0.1, 0.1}));
    const std::vector<Placed> found = associate(tracks, changes);
    std::vector<Track> tracks_back(tracks.rbegin(), tracks.rend());
    std::vector<Change> changes_back(changes.rbegin(), changes.rend());
    const std::vector<Placed> back = associate(tracks_back, changes_back);
    for (std::size_t c = 0; c < changes.size(); ++c) {
      const Placed mirrored = back[changes.size() - 1 - c];
      RC_ASSERT(found[c].has_value() == mirrored.has_value());
      if (found[c]) RC_ASSERT(*found[c] == tracks.size() - 1 - *mirrored);
    }
  }));
}

TEST_CASE("a discrepancy belongs to no track") {
  Track track = track_at({0, 0, 0});
  track.kind = ChangeKind::discrepancy;
  CHECK_FALSE(
      associate(std::vector{track}, std::vector{box_at({0, 0, 0}, {1, 1, 1}, ChangeKind::discrepancy)}).front());
}

TEST_CASE("a track ends with the first scan that shows it gone, and lives again only if the very next one sees it") {
  Track track = track_at({0, 0, 0});
  see_still(track, kStart + 1min);
  CHECK(track.state == TrackState::open);
  miss(track, kStart + 2min);
  CHECK(track.state == TrackState::gone);
  CHECK(track.ended_at == kStart + 2min);
  REQUIRE(is_followed(track));
  SUBCASE("seen again") {
    see(track, box_at({0, 0, 0}), {}, kStart + 3min);
    CHECK(track.state == TrackState::open);
    CHECK_FALSE(track.ended_at);
    CHECK(track.first_seen_at == kStart);
    CHECK(seen_of_last(track, 4) == 3);
  }
  SUBCASE("absent again: over") {
    miss(track, kStart + 3min);
    CHECK_FALSE(is_followed(track));
    CHECK(track.ended_at == kStart + 2min);
  }
}

TEST_CASE("the last sights are counted as they were, however many there are") {
  CHECK(rc::check([](const std::vector<bool>& sights) {
    Track track = track_at({0, 0, 0});
    std::vector<bool> all{true};
    for (const bool seen : sights) {
      if (!is_followed(track)) break;
      seen ? see_still(track, kStart) : miss(track, kStart);
      all.push_back(seen);
    }
    for (const std::uint32_t of : {1u, 3u, 64u}) {
      const std::size_t count = std::min<std::size_t>(of, all.size());
      RC_ASSERT(seen_of_last(track, of) == static_cast<std::uint32_t>(std::count(
                                               all.end() - static_cast<std::ptrdiff_t>(count), all.end(), true)));
    }
    RC_ASSERT(track.seen + track.absent == all.size());
  }));
}

TEST_CASE("what a scan shows of a place without a change there") {
  const auto answers = [](int free, int supported, int occluded) {
    std::vector<Answer> list(static_cast<std::size_t>(free), Answer::free);
    list.insert(list.end(), static_cast<std::size_t>(supported), Answer::supported);
    list.insert(list.end(), static_cast<std::size_t>(occluded), Answer::occluded);
    return list;
  };
  CHECK(sight_of(ChangeKind::added, answers(9, 1, 0)) == Sight::absent);
  CHECK(sight_of(ChangeKind::removed, answers(9, 1, 0)) == Sight::seen);
  CHECK(sight_of(ChangeKind::added, answers(1, 9, 10)) == Sight::seen);
  CHECK(sight_of(ChangeKind::added, answers(5, 5, 0)) == Sight::unseen);
  CHECK(sight_of(ChangeKind::added, answers(0, 0, 20)) == Sight::unseen);
  CHECK(sight_of(ChangeKind::added, answers(4, 0, 60)) == Sight::unseen);
  CHECK(sight_of(ChangeKind::added, answers(2, 0, 0)) == Sight::unseen);
  CHECK(sight_of(ChangeKind::added, {}) == Sight::unseen);
}

TEST_CASE("a thing that was moved is recognised by its size, and not taken for a person") {
  const OrientedBox crate = box_at({0, 0, 0}, {1.0, 0.6, 0.4}).box;
  CHECK(are_alike(crate, box_at({9, 9, 9}, {1.1, 0.55, 0.4}).box));
  CHECK_FALSE(are_alike(crate, box_at({9, 9, 9}, {2.0, 0.6, 0.4}).box));
  CHECK_FALSE(are_alike(crate, box_at({9, 9, 9}, {0.2, 0.2, 0.2}).box));
  CHECK_FALSE(are_alike(box_at({0, 0, 0}, {1.1, 0.6, 0.5}).box, box_at({0, 0, 0}, {0.5, 0.45, 1.6}).box));
  CHECK(size_difference_m(crate, box_at({9, 9, 9}, {1.1, 0.55, 0.4}).box) == doctest::Approx(0.15));
}

}  // namespace
}  // namespace raywatch
