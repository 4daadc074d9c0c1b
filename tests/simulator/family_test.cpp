#include "tests/simulator/family.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <set>

#include "core/error.hpp"

using namespace raywatch;
using namespace raywatch::simulator;

namespace {

FamilyOptions sparse(Family family, std::uint64_t seed, bool hard) {
  return {.seed = seed,
          .hard = hard,
          .density = family == Family::mine ? 0.01 : 0.05,
          .scans = family == Family::mine ? 4 : 9};
}

std::size_t truly_changed(const SimulatedScan& scan, const SimulatedScan& other) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < scan.points.size(); ++i) count += is_truly_changed(scan, i, other) ? 1U : 0U;
  return count;
}

/// Whether some scan shows a state that some other scan of the story has not.
bool tells_of_change(const std::vector<SimulatedScan>& scans) {
  return std::ranges::any_of(scans, [&](const SimulatedScan& scan) {
    return std::ranges::any_of(scans, [&](const SimulatedScan& other) { return truly_changed(scan, other) > 0; });
  });
}

}  // namespace

TEST_CASE("every family tells a consistent story of change") {
  for (const Family family : kFamilies) {
    for (const bool hard : {false, true}) {
      CAPTURE(std::string(to_string(family)));
      CAPTURE(hard);
      const Timeline timeline = make_timeline(family, sparse(family, 2, hard));
      std::vector<SimulatedScan> scans;
      for (const Moment& moment : timeline.moments) scans.push_back(take_scan(timeline, moment));
      REQUIRE(scans.size() >= 4);
      CHECK(std::ranges::is_sorted(scans, {}, &SimulatedScan::captured_at));
      CHECK(tells_of_change(scans));
      for (const SimulatedScan& scan : scans) {
        CHECK_FALSE(scan.sensor.empty());
        CHECK(scan.points.size() > 200);
        CHECK(std::ranges::is_sorted(scan.present));
        REQUIRE(scan.labels.size() == scan.points.size());
        for (const StateId label : scan.labels) {
          const bool is_state = label != kBackground && label != kNoSurface;
          if (is_state) REQUIRE(std::ranges::binary_search(scan.present, label));
        }
        const double off_m =
            (scan.true_world_from_sensor.position_m - scan.reported_world_from_sensor.position_m).norm();
        CHECK((off_m > 0.0) == hard);
        CHECK(off_m < 0.06);
      }
      for (const ObjectState& object : timeline.objects) {
        CHECK(object.volume_m3 > 0.0);
        CHECK_FALSE(object.box.isEmpty());
      }
    }
  }
}

TEST_CASE("every labelled return lies on its object, seen from where the scan was truly taken") {
  // Five standard deviations of the range noise, beams across edges, and slopes between the cells of the ground.
  constexpr double kOff_m = 0.25;
  for (const Family family : kFamilies) {
    CAPTURE(std::string(to_string(family)));
    const Timeline timeline = make_timeline(family, sparse(family, 3, true));
    for (const Moment& moment : timeline.moments) {
      const SimulatedScan scan = take_scan(timeline, moment);
      for (std::size_t i = 0; i < scan.points.size(); ++i) {
        if (scan.labels[i] == kBackground || scan.labels[i] == kNoSurface) continue;
        const Eigen::Vector3d place_m = scan.true_world_from_sensor * scan.points[i].cast<double>();
        REQUIRE(timeline.object(scan.labels[i]).box.exteriorDistance(place_m) < kOff_m);
      }
    }
  }
}

TEST_CASE("the same seed gives the same scans, another one another place") {
  const auto scans = [](std::uint64_t seed) {
    return simulate(Family::lab, {.seed = seed, .hard = true, .density = 0.02, .scans = 2});
  };
  const auto first = scans(4);
  const auto again = scans(4);
  const auto other = scans(5);
  CHECK(first[1].points.x_m == again[1].points.x_m);
  CHECK(first[1].labels == again[1].labels);
  CHECK(first[1].points.x_m != other[1].points.x_m);
}

TEST_CASE("no two states of a story ever have the same place") {
  for (const Family family : {Family::sim, Family::lab, Family::carpark, Family::yard}) {
    CAPTURE(std::string(to_string(family)));
    const Timeline timeline = make_timeline(family, {.seed = 6, .hard = true, .scans = 40});
    for (const ObjectState& a : timeline.objects) {
      for (const ObjectState& b : timeline.objects) {
        if (a.id < b.id) CHECK((a.box.center() - b.box.center()).head<2>().norm() > 0.3);
      }
    }
  }
}

TEST_CASE("the stream is quiet for four scans, then a bag appears, a crate vanishes and a person passes") {
  const Timeline timeline = make_timeline(Family::stream, {.seed = 1});
  const auto kinds_at = [&](std::size_t moment) {
    std::multiset<std::string> kinds;
    for (const StateId id : timeline.moments.at(moment).present) kinds.insert(timeline.object(id).kind);
    return kinds;
  };
  const std::size_t crates = kinds_at(0).count("crate");
  CHECK(crates >= 3);
  for (std::size_t i = 0; i < 4; ++i) {
    CHECK(timeline.moments[i].present == timeline.moments[0].present);
    CHECK(kinds_at(i).count("bag") == 0);
  }
  CHECK(kinds_at(4).count("bag") == 1);
  CHECK(kinds_at(6).count("crate") == crates - 1);
  CHECK(kinds_at(7).count("person") == 1);
  CHECK(kinds_at(10).count("person") == 0);
  CHECK(timeline.moments[1].plan.captured_at - timeline.moments[0].plan.captured_at == std::chrono::seconds(30));
  CHECK(timeline.scanners.size() == 1);
}

TEST_CASE("the box of the lab is 14 x 17 x 40 cm and stands at four places in turn") {
  const Timeline timeline = make_timeline(Family::lab, {.seed = 3, .scans = 15});
  REQUIRE(timeline.objects.size() == 4);
  for (const ObjectState& object : timeline.objects) CHECK(object.volume_m3 == doctest::Approx(0.14 * 0.17 * 0.40));
  CHECK(timeline.moments[0].present == timeline.moments[2].present);
  CHECK(timeline.moments[0].present != timeline.moments[3].present);
  CHECK(timeline.moments[0].present == timeline.moments[12].present);
}

TEST_CASE("an unknown family is refused with the known ones") {
  CHECK(parse_family("yard") == Family::yard);
  CHECK_THROWS_WITH_AS(parse_family("yrad"),
                       "unknown family \"yrad\"; known are sim, lab, carpark, yard, mine, pit, stream", InvalidInput);
}
