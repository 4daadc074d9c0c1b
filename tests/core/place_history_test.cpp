#include "core/place_history.hpp"

#include <doctest/doctest.h>
#include <rapidcheck.h>

#include "core/look.hpp"
#include "tests/core/watch_scene.hpp"

namespace raywatch {
namespace {

std::vector<PlaceSight> sights(const std::string& text) {
  std::vector<PlaceSight> list;
  for (const char c : text) {
    const auto number = static_cast<std::int64_t>(list.size()) + 1;
    list.push_back({ScanId{number}, Time(std::chrono::minutes(number)),
                    c == 'f'   ? Presence::free
                    : c == 'o' ? Presence::occupied
                               : Presence::not_seen});
  }
  return list;
}

TEST_CASE("free until, occupied since, and not seen in three scans between") {
  const auto intervals = intervals_of(sights("fff---ooo"));
  REQUIRE(intervals.size() == 3);
  CHECK(intervals[0].presence == Presence::free);
  CHECK(intervals[0].last_scan == ScanId{3});
  CHECK(intervals[1].presence == Presence::not_seen);
  CHECK(intervals[1].scans == 3);
  CHECK(intervals[2].presence == Presence::occupied);
  CHECK(intervals[2].first_scan == ScanId{7});
  CHECK(intervals[2].from == Time(std::chrono::minutes(7)));
}

TEST_CASE("what is not seen between two sights of the same belongs to their interval") {
  const auto intervals = intervals_of(sights("-f--f-f-"));
  REQUIRE(intervals.size() == 3);
  CHECK(intervals[1].scans == 3);
  CHECK(intervals[1].not_seen == 3);
  CHECK(intervals[1].to == Time(std::chrono::minutes(7)));
  CHECK(intervals_of({}).empty());
}

TEST_CASE("intervals count every scan once, follow each other in time, and differ from their neighbours") {
  CHECK(rc::check([](const std::vector<std::uint8_t>& choices) {
    std::string text;
    for (const std::uint8_t choice : choices) text += "fo-"[choice % 3];
    const auto list = sights(text);
    const auto intervals = intervals_of(list);
    std::uint64_t scans = 0;
    for (std::size_t i = 0; i < intervals.size(); ++i) {
      scans += intervals[i].scans + intervals[i].not_seen;
      RC_ASSERT(intervals[i].from <= intervals[i].to);
      if (i == 0) continue;
      RC_ASSERT(intervals[i - 1].to < intervals[i].from);
      RC_ASSERT(intervals[i - 1].presence != intervals[i].presence);
    }
    RC_ASSERT(scans == list.size());
  }));
}

TEST_CASE("without an index the answer is the one that the index gives") {
  const WatchedScan scan = look_at_wall(true);
  const CompareParameters parameters = watch_parameters();
  const ScanView view = scan.view();
  CHECK(rc::check([&] {
    const auto coordinate_m = [](int from, int to) { return *rc::gen::inRange(from, to) / 100.0; };
    const Eigen::Vector3d place_m(coordinate_m(100, 1200), coordinate_m(-400, 400), coordinate_m(-300, 300));
    const Answer asked = look_at(view, std::vector{place_m}, parameters).front();
    const std::vector<PointCloud> returns{scan.points};
    // Rounding to single precision may decide at a threshold.
    const Eigen::Vector3d rounded_m = place_m.cast<float>().cast<double>();
    RC_ASSERT(ask_returns(returns, {}, rounded_m, look_thresholds(view.sensor, parameters)) == asked);
  }));
}

TEST_CASE("a box is occupied when any of its places is, and free when most are") {
  using enum Answer;
  CHECK(presence_of(std::vector{free, supported, unseen}) == Presence::occupied);
  CHECK(presence_of(std::vector{free, free, unseen, occluded}) == Presence::free);
  CHECK(presence_of(std::vector{free, unseen, occluded}) == Presence::not_seen);
  CHECK(presence_of({}) == Presence::not_seen);
}

}  // namespace
}  // namespace raywatch
