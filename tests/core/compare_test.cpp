// Comparing scans: what is reported, what is not, and the laws that hold for any scene.

#include "core/compare.hpp"

#include <doctest/doctest.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/task_arena.h>
#include <rapidcheck.h>

#include <algorithm>
#include <memory>
#include <random>

#include "core/error.hpp"
#include "core/profile.hpp"
#include "tests/simulator/scanner.hpp"
#include "tests/simulator/simulated_scan.hpp"
#include "tests/simulator/wall_and_box.hpp"

namespace raywatch {
namespace {

using namespace simulator;
using namespace std::chrono_literals;

constexpr Time kStart{std::chrono::sys_days{std::chrono::year{2026} / 3 / 1}};

/// A scan with all that a comparison needs of it.
struct Taken {
  PointCloud points;
  Pose world_from_sensor;
  Time captured_at;
  SensorModel sensor;
  PriorIndex index;

  ScanView view() const { return {points, index, world_from_sensor, captured_at, sensor}; }
};

Taken taken(PointCloud points, const Pose& world_from_sensor, Time captured_at) {
  PriorIndex index = PriorIndex::build(points, {});
  SensorModel sensor = estimate_sensor(points, index);
  return {std::move(points), world_from_sensor, captured_at, sensor, std::move(index)};
}

Taken scan_of(const Scene& scene, const Pose& world_from_sensor, Time captured_at, std::uint64_t seed = 1,
              double step_deg = 1.0) {
  Scanner scanner = grid_scanner({.step_rad = radians(step_deg)});
  scanner.errors.range_noise_m = 0.01;
  return taken(take_scan(RayCaster(scene), scanner, exact_plan(world_from_sensor, seed)).points, world_from_sensor,
               captured_at);
}

constexpr double kBoxX = 6.0;

/// A room of 20 m x 16 m x 6 m; perhaps with a box at (6, 0), one metre wide, 4 m high, so that its top is out of
/// sight, standing on the floor 3 m below the sensor.
Scene room(bool with_box) {
  Scene scene;
  scene.add(Room{Pose{}, {10.0, 8.0, 3.0}});
  if (with_box) scene.add(Box{{Eigen::Quaterniond::Identity(), {kBoxX, 0.0, -1.0}}, Eigen::Vector3d(0.5, 0.5, 2.0)}, 1);
  return scene;
}

Pose from(double x, double y) { return {Eigen::Quaterniond::Identity(), {x, y, 0.0}}; }

CompareParameters parameters(Grouping grouping) {
  CompareParameters result = default_parameters(Profile::indoor, grouping);
  result.cluster_distance_m = 0.5;  // a grid of one degree is coarse
  result.cluster_min_points = 25;
  return result;
}

std::vector<ScanView> views(const std::vector<Taken>& scans) {
  std::vector<ScanView> result;
  for (const Taken& scan : scans) result.push_back(scan.view());
  return result;
}

Comparison compared(const Taken& scan, const std::vector<Taken>& priors, const CompareParameters& with) {
  return compare(scan.view(), views(priors), with);
}

std::size_t count(const Comparison& comparison, PointClass point_class) {
  return comparison.counts[static_cast<std::size_t>(point_class)];
}

template <class... T>
std::vector<Taken> list(T&&... scans) {
  std::vector<Taken> result;
  (result.push_back(std::forward<T>(scans)), ...);
  return result;
}

const Grouping kBoth[] = {Grouping::union_, Grouping::consensus};

TEST_CASE("a box that appeared is one added change, where it stands and no larger than it is") {
  for (const Grouping grouping : kBoth) {
    const auto comparison = compared(scan_of(room(true), from(0, 0), kStart + 1h, 2),
                                     list(scan_of(room(false), from(0.5, 0.3), kStart)), parameters(grouping));
    REQUIRE(comparison.changes.size() == 1);
    const Change& change = comparison.changes.front();
    CHECK(change.kind == ChangeKind::added);
    CHECK(change.points == count(comparison, PointClass::added));
    CHECK(change.centroid_m.x() == doctest::Approx(kBoxX - 0.5).epsilon(0.05));
    CHECK(std::abs(change.centroid_m.y()) < 0.1);
    CHECK(change.box.size_m.head<2>().maxCoeff() < 1.1);
    CHECK(change.box.size_m.z() < 4.1);
    CHECK(change.volume_m3 == doctest::Approx(change.box.size_m.prod()));
    CHECK(change.confidence.value > 0.9);
    CHECK(count(comparison, PointClass::removed) == 0);
    CHECK(comparison.testable > 0.9);
  }
}

TEST_CASE("a box that is gone is one removed change, made of the prior's points") {
  for (const Grouping grouping : kBoth) {
    const auto comparison = compared(scan_of(room(false), from(0, 0), kStart + 1h, 2),
                                     list(scan_of(room(true), from(0.5, 0.3), kStart)), parameters(grouping));
    REQUIRE(comparison.changes.size() == 1);
    CHECK(comparison.changes.front().kind == ChangeKind::removed);
    CHECK(count(comparison, PointClass::added) == 0);
    CHECK(comparison.prior_points.size() == count(comparison, PointClass::removed));
    CHECK(comparison.priors.front().removed == comparison.prior_points.size());
    for (const PriorPoint& point : comparison.prior_points) CHECK(point.change == 0);
  }
}

TEST_CASE("a prior that is later turns the meaning around: what is free in it was removed afterwards") {
  const auto comparison =
      compared(scan_of(room(true), from(0, 0), kStart), list(scan_of(room(false), from(0.5, 0.3), kStart + 1h, 2)),
               parameters(Grouping::union_));
  REQUIRE(comparison.changes.size() == 1);
  CHECK(comparison.changes.front().kind == ChangeKind::removed);
  CHECK(comparison.prior_points.empty());
}

TEST_CASE("contemporary scans that disagree give a discrepancy, at exactly the tolerance too") {
  CompareParameters with = parameters(Grouping::union_);
  with.contemporary_tolerance = 10s;
  const auto kind_after = [&](Duration age) {
    const auto comparison = compared(scan_of(room(true), from(0, 0), kStart + age, 2),
                                     list(scan_of(room(false), from(0.5, 0.3), kStart)), with);
    REQUIRE(comparison.changes.size() == 1);
    return comparison.changes.front().kind;
  };
  CHECK(kind_after(10s) == ChangeKind::discrepancy);
  CHECK(kind_after(-10s) == ChangeKind::discrepancy);
  CHECK(kind_after(10s + 1ns) == ChangeKind::added);
  CHECK(kind_after(-10s - 1ns) == ChangeKind::removed);
}

TEST_CASE("what a prior could not see behind an obstacle is occluded, never changed") {
  // The prior stands behind a wide screen and sees nothing of the far half of the room.
  Scene screened = room(false);
  screened.add(Box{{Eigen::Quaterniond::Identity(), {2.0, 0.0, 0.0}}, Eigen::Vector3d(0.05, 7.9, 2.9)});
  const auto comparison = compared(scan_of(room(true), from(4.0, 0), kStart + 1h, 2),
                                   list(scan_of(screened, from(0, 0), kStart)), parameters(Grouping::union_));
  for (const Change& change : comparison.changes) CHECK(change.kind != ChangeKind::added);
  CHECK(count(comparison, PointClass::occluded) > comparison.classes.size() / 4);
  CHECK(comparison.testable < 0.7);
}

TEST_CASE("a scan against itself has no change") {
  for (const Grouping grouping : kBoth) {
    CompareParameters with = parameters(grouping);
    with.clustering = false;
    with.contemporary_tolerance = Duration::zero();
    for (const double angle_deg : {0.5, 1.0, 3.0}) {
      with.angle_rad = radians(angle_deg);
      const Taken scan = scan_of(room(true), from(1, 2), kStart);
      const auto comparison = compared(scan, list(scan_of(room(true), from(1, 2), kStart)), with);
      CHECK(count(comparison, PointClass::unchanged) == comparison.classes.size());
      CHECK(comparison.prior_points.empty());
    }
  }
}

TEST_CASE("without priors every valid point is unseen and nothing is testable") {
  PointCloud points = scan_of(room(true), from(0, 0), kStart).points;
  points.push_back(0, 0, 0);
  points.push_back(std::nanf(""), 0, 0);
  const auto comparison = compared(taken(points, from(0, 0), kStart), {}, parameters(Grouping::consensus));
  CHECK(count(comparison, PointClass::unseen) == points.size() - 2);
  CHECK(count(comparison, PointClass::invalid) == 2);
  CHECK(comparison.testable == 0.0);
  CHECK(comparison.changes.empty());
}

TEST_CASE(
    "union asks no further once a prior says free; consensus lets support by a contemporary prior speak against it") {
  // The second prior, of the same time as the first, has the box.
  const auto priors = [] {
    return list(scan_of(room(false), from(0.5, 0.3), kStart), scan_of(room(true), from(0.2, -0.4), kStart, 3));
  };
  const Taken scan = scan_of(room(true), from(0, 0), kStart + 1h, 2);
  CHECK(count(compared(scan, priors(), parameters(Grouping::union_)), PointClass::added) > 0);
  CHECK(count(compared(scan, priors(), parameters(Grouping::consensus)), PointClass::added) == 0);
}

TEST_CASE("in a consensus the newest prior that can test the point decides") {
  const Taken scan = scan_of(room(true), from(0, 0), kStart + 3h, 2);
  // The box came between the two priors: what an older scan saw is no longer news.
  CHECK(compared(scan,
                 list(scan_of(room(false), from(0.5, 0.3), kStart), scan_of(room(true), from(0.2, 0), kStart + 2h)),
                 parameters(Grouping::consensus))
            .changes.empty());
  // It went and came back: the older support does not hide that.
  CHECK(compared(scan,
                 list(scan_of(room(true), from(0.5, 0.3), kStart), scan_of(room(false), from(0.2, 0), kStart + 2h)),
                 parameters(Grouping::consensus))
            .changes.size() == 1);
}

TEST_CASE("in a consensus what was already gone in a newer prior is not removed again") {
  const Taken scan = scan_of(room(false), from(0, 0), kStart + 3h, 2);
  CHECK(compared(scan,
                 list(scan_of(room(true), from(0.5, 0.3), kStart), scan_of(room(false), from(0.2, 0), kStart + 2h)),
                 parameters(Grouping::consensus))
            .changes.empty());
}

TEST_CASE("several priors' returns of one removed thing are one change") {
  const auto comparison =
      compared(scan_of(room(false), from(0, 0), kStart + 1h, 2),
               list(scan_of(room(true), from(0.5, 0.3), kStart), scan_of(room(true), from(0, 1), kStart)),
               parameters(Grouping::consensus));
  REQUIRE(comparison.changes.size() == 1);
  CHECK(comparison.priors[0].removed > 0);
  CHECK(comparison.priors[1].removed > 0);
  // That both show it says that it was there: hardly any of their points, at its edges, disagrees.
  const Confidence& confidence = comparison.changes.front().confidence;
  CHECK(confidence.value > 0.99);
  CHECK(confidence.free < 0.01);
  CHECK(confidence.supported > 0.6);
}

TEST_CASE("clusters of at most the least number of points are noise and count as unchanged") {
  CompareParameters with = parameters(Grouping::union_);
  const Taken scan = scan_of(room(true), from(0, 0), kStart + 1h, 2);
  const auto prior = [] { return list(scan_of(room(false), from(0.5, 0.3), kStart)); };
  const std::size_t points = compared(scan, prior(), with).changes.at(0).points;
  with.cluster_min_points = points;
  CHECK(compared(scan, prior(), with).changes.empty());
  CHECK(count(compared(scan, prior(), with), PointClass::added) == 0);
  with.cluster_min_points = points - 1;
  CHECK(compared(scan, prior(), with).changes.size() == 1);
  with.clustering = false;
  const auto bare = compared(scan, prior(), with);
  CHECK(bare.changes.empty());
  CHECK(count(bare, PointClass::added) >= points);
}

TEST_CASE(
    "without an angular threshold it follows the sensor, and one below the spacing of the shots gives a warning") {
  CompareParameters with = parameters(Grouping::union_);
  const Taken scan = scan_of(room(true), from(0, 0), kStart + 1h, 2);
  const auto prior = list(scan_of(room(false), from(0.5, 0.3), kStart));
  CHECK(compared(scan, prior, with).priors.front().angle_rad == doctest::Approx(radians(1.5)).epsilon(0.1));
  CHECK(compared(scan, prior, with).warnings.empty());
  with.angle_rad = radians(0.2);
  const auto comparison = compared(scan, prior, with);
  REQUIRE(comparison.warnings.size() == 2);
  CHECK(comparison.warnings.back().find("below the spacing of the shots of prior 0") != std::string::npos);
}

TEST_CASE("what is earlier is earlier, also by more than a duration reaches") {
  const Time long_ago = parse_rfc3339("1690-01-01T00:00:00Z");
  for (const Grouping grouping : kBoth) {
    const auto appeared = compared(scan_of(room(true), from(0, 0), kStart, 2),
                                   list(scan_of(room(false), from(0.5, 0.3), long_ago)), parameters(grouping));
    CHECK(count(appeared, PointClass::added) > 0);
    CHECK(count(appeared, PointClass::removed) == 0);
    const auto later = compared(scan_of(room(true), from(0, 0), long_ago, 2),
                                list(scan_of(room(false), from(0.5, 0.3), kStart)), parameters(grouping));
    CHECK(count(later, PointClass::removed) > 0);
    CHECK(count(later, PointClass::added) == 0);
  }
}

TEST_CASE("a parameter out of its range is refused by name") {
  const Taken scan = scan_of(room(false), from(0, 0), kStart);
  CompareParameters with;
  with.cluster_distance_m = 0.0;
  with.range_m = -1.0;
  try {
    compared(scan, {}, with);
    FAIL("accepted");
  } catch (const InvalidInput& error) {
    REQUIRE(error.fields().size() == 2);
    CHECK(error.fields()[0].field == "range_m");
    CHECK(error.fields()[1].field == "cluster_distance_m");
    CHECK(std::string(error.what()) ==
          "A parameter of the comparison is out of its range: range_m must be 0 or more; "
          "cluster_distance_m must be above 0");
  }
}

/// Everything of a comparison that a caller can see, as numbers, in the order of the scan.
std::vector<double> everything(const Comparison& comparison) {
  std::vector<double> all;
  for (std::size_t i = 0; i < comparison.classes.size(); ++i) {
    all.push_back(static_cast<double>(comparison.classes[i]));
    all.push_back(comparison.free[i]);
    all.push_back(comparison.supported[i]);
    all.push_back(comparison.change_of[i]);
  }
  for (const PriorPoint& p : comparison.prior_points) {
    all.insert(all.end(), {static_cast<double>(p.prior), static_cast<double>(p.index), static_cast<double>(p.change)});
  }
  for (const Change& c : comparison.changes) {
    all.insert(all.end(), {c.centroid_m.x(), c.centroid_m.y(), c.centroid_m.z(), c.volume_m3, c.confidence.value});
    all.insert(all.end(), {c.box.center_m.x(), c.box.size_m.x(), c.box.size_m.y(), c.box.size_m.z()});
  }
  return all;
}

/// A room in which some boxes differ between the priors and the scan, placed by a seed.
struct RandomRoom {
  Scene before, after;
};

RandomRoom random_room(std::uint32_t seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  RandomRoom rooms{room(false), room(false)};
  for (StateId state = 1; state <= 6; ++state) {
    const Box box{{Eigen::Quaterniond(Eigen::AngleAxisd(3.0 * unit(random), Eigen::Vector3d::UnitZ())),
                   {8.0 * unit(random), 6.0 * unit(random), 2.0 * unit(random)}},
                  Eigen::Vector3d(0.4, 0.3, 0.5)};
    if (state % 3 != 1) rooms.before.add(box, state);
    if (state % 3 != 2) rooms.after.add(box, state);
  }
  return rooms;
}

TEST_CASE("the result is the same, byte for byte, with 1 thread and with 8") {
  const tbb::global_control eight(tbb::global_control::max_allowed_parallelism, 8);
  const RandomRoom rooms = random_room(5);
  const Taken scan = scan_of(rooms.after, from(0, 0), kStart + 1h, 9);
  const auto priors = list(scan_of(rooms.before, from(2, 1), kStart), scan_of(rooms.before, from(-2, 1), kStart));
  for (const Grouping grouping : kBoth) {
    const auto with_threads = [&](int threads) {
      tbb::task_arena arena(threads);
      return arena.execute([&] { return everything(compared(scan, priors, parameters(grouping))); });
    };
    CHECK(with_threads(1) == with_threads(8));
  }
}

/// Few points, so that a law can be tried on many scenes.
Taken coarse_scan(const Scene& scene, const Pose& world_from_sensor, Time captured_at, std::uint64_t seed = 1) {
  return scan_of(scene, world_from_sensor, captured_at, seed, 3.0);
}

bool order_of_points_changes_nothing(std::uint32_t seed) {
  const RandomRoom rooms = random_room(seed);
  const Taken scan = coarse_scan(rooms.after, from(0, 0), kStart + 1h, seed);
  const auto priors = list(coarse_scan(rooms.before, from(2, 1), kStart, seed + 1));
  std::vector<std::size_t> order(scan.points.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::shuffle(order.begin(), order.end(), std::mt19937(seed));
  PointCloud points;
  for (const std::size_t i : order) points.push_back(scan.points.x_m[i], scan.points.y_m[i], scan.points.z_m[i]);
  Taken shuffled = taken(std::move(points), scan.world_from_sensor, scan.captured_at);
  const auto straight = compared(scan, priors, parameters(Grouping::consensus));
  const auto mixed = compared(shuffled, priors, parameters(Grouping::consensus));
  for (std::size_t i = 0; i < order.size(); ++i) {
    if (mixed.classes[i] != straight.classes[order[i]]) return false;
  }
  return mixed.counts == straight.counts;
}

TEST_CASE("the order of the points changes nothing") {
  CHECK(rc::check([] { RC_ASSERT(order_of_points_changes_nothing(*rc::gen::arbitrary<std::uint32_t>())); }));
}

TEST_CASE("the order of the points changes nothing of clusters of which only some points are looked at") {
  for (const std::uint32_t seed : {249041, 249423}) CHECK(order_of_points_changes_nothing(seed));
}

TEST_CASE("the order of the priors changes nothing") {
  CHECK(rc::check([] {
    const auto seed = *rc::gen::arbitrary<std::uint32_t>();
    const RandomRoom rooms = random_room(seed);
    const Taken scan = coarse_scan(rooms.after, from(0, 0), kStart + 1h, seed);
    const auto grouping = *rc::gen::elementOf(std::vector<Grouping>(std::begin(kBoth), std::end(kBoth)));
    const auto a = compared(
        scan, list(coarse_scan(rooms.before, from(2, 1), kStart), coarse_scan(rooms.before, from(-2, 1), kStart)),
        parameters(grouping));
    const auto b = compared(
        scan, list(coarse_scan(rooms.before, from(-2, 1), kStart), coarse_scan(rooms.before, from(2, 1), kStart)),
        parameters(grouping));
    RC_ASSERT(a.classes == b.classes);
    RC_ASSERT(a.free == b.free);
    RC_ASSERT(a.counts == b.counts);
    RC_ASSERT(a.changes.size() == b.changes.size());
  }));
}

TEST_CASE("adding priors to union never removes a change of a point") {
  CHECK(rc::check([] {
    const auto seed = *rc::gen::arbitrary<std::uint32_t>();
    const RandomRoom rooms = random_room(seed);
    const Taken scan = coarse_scan(rooms.after, from(0, 0), kStart + 1h, seed);
    CompareParameters with = parameters(Grouping::union_);
    with.clustering = false;
    const auto one = compared(scan, list(coarse_scan(rooms.before, from(2, 1), kStart)), with);
    const auto two = compared(
        scan, list(coarse_scan(rooms.before, from(2, 1), kStart), coarse_scan(rooms.after, from(-2, 1), kStart)), with);
    for (std::size_t i = 0; i < one.classes.size(); ++i) {
      if (one.classes[i] == PointClass::added) RC_ASSERT(two.classes[i] == PointClass::added);
    }
  }));
}

TEST_CASE("a common rigid motion of the world changes nothing") {
  CHECK(rc::check([] {
    const auto seed = *rc::gen::arbitrary<std::uint32_t>();
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    const RandomRoom rooms = random_room(seed);
    const Pose moved_from_world{Eigen::Quaterniond(unit(random), unit(random), unit(random), unit(random)).normalized(),
                                1000.0 * Eigen::Vector3d(unit(random), unit(random), unit(random))};
    const auto grouping = *rc::gen::elementOf(std::vector<Grouping>(std::begin(kBoth), std::end(kBoth)));
    CompareParameters with = parameters(grouping);
    with.clustering = grouping == Grouping::consensus;
    const auto classes = [&](const Pose& motion) {
      Taken scan = coarse_scan(rooms.after, from(0, 0), kStart + 1h, seed);
      auto priors = list(coarse_scan(rooms.before, from(2, 1), kStart), coarse_scan(rooms.before, from(-2, 1), kStart));
      scan.world_from_sensor = motion * scan.world_from_sensor;
      for (Taken& prior : priors) prior.world_from_sensor = motion * prior.world_from_sensor;
      return compared(scan, priors, with).classes;
    };
    const auto here = classes(Pose{}), there = classes(moved_from_world);
    std::size_t differing = 0;
    for (std::size_t i = 0; i < here.size(); ++i) differing += here[i] != there[i];
    RC_ASSERT(differing <= here.size() / 10000);  // within rounding of a threshold
  }));
}

}  // namespace
}  // namespace raywatch
