#include <doctest/doctest.h>

#include <algorithm>

#include "storage/acceptance.hpp"
#include "tests/server/watched_site.hpp"
#include "tests/simulator/simulated_scan.hpp"
#include "tests/simulator/wall_and_box.hpp"

using namespace raywatch;
using namespace raywatch::simulator;

namespace {

/// Two fixed sensors before one wall, 4 m apart; a box of one metre may stand between them and it.
class TwoVantages {
 public:
  TwoVantages() : site_({.parameters = parameters(), .sensors_are_fixed = true}) {}

  void take(const std::string& sensor, bool box) {
    WallAndBox layout{.wall_distance_m = 10.0};
    if (box) layout.box_center_m = Eigen::Vector3d(6.0, 2.0, 0.0);
    Scanner scanner = grid_scanner({.lowest_elevation_rad = radians(-20.0), .highest_elevation_rad = radians(20.0)});
    scanner.max_range_m = 20.0;
    scanner.errors.range_noise_m = 0.005;
    const Pose pose{Eigen::Quaterniond::Identity(), {0.0, sensor == "east" ? 0.0 : 4.0, 0.0}};
    const auto seed = static_cast<std::uint64_t>(++number_);
    site_.put({.sensor = sensor,
               .points = take_scan(RayCaster(wall_and_box(layout)), scanner, exact_plan(pose, seed)).points,
               .world_from_sensor = pose,
               .captured_at = site_.now()});
    site_.set_now(site_.now() + std::chrono::minutes(1));
  }
  void take(const std::string& sensor, bool box, int times) {
    for (int i = 0; i < times; ++i) take(sensor, box);
  }

  std::size_t standing_alerts(ChangeKind kind) const {
    std::size_t count = 0;
    const std::vector<TrackRecord> tracks = site_.tracks();
    for (const AlertRecord& alert : site_.alerts()) {
      if (alert.state == AlertState::resolved || !alert.track) continue;
      const auto track = std::ranges::find(tracks, *alert.track, [](const TrackRecord& t) { return t.track.id; });
      count += track != tracks.end() && track->track.kind == kind ? 1 : 0;
    }
    return count;
  }

  WatchedSite& site() { return site_; }

 private:
  static CompareParameters parameters() {
    CompareParameters result = default_parameters(Profile::indoor, Grouping::consensus);
    result.cluster_distance_m = 0.3;  // steps of one degree are coarse
    return result;
  }

  WatchedSite site_;
  int number_ = 0;
};

}  // namespace

TEST_CASE("what was accepted from one vantage is normal for another, and its theft is told from there too") {
  TwoVantages place;
  for (int i = 0; i < 3; ++i) {
    place.take("east", false);
    place.take("west", false);
  }
  place.take("east", true, 3);
  REQUIRE(place.standing_alerts(ChangeKind::added) == 1);

  place.site().store().write([&](Transaction& transaction) {
    accept_track(transaction, place.site().tracks().back().track.id, {.by = "ann", .note = "ours", .at = {}});
  });
  place.take("west", true, 3);  // it never saw the box when that was accepted, and its own normal scans show none
  CHECK(place.standing_alerts(ChangeKind::added) == 0);

  place.take("west", false, 3);
  CHECK(place.standing_alerts(ChangeKind::removed) == 1);
}
