#include "core/epoch.hpp"

#include <doctest/doctest.h>
#include <oneapi/tbb/task_arena.h>

#include <set>

#include "core/error.hpp"
#include "core/profile.hpp"
#include "tests/simulator/simulated_scan.hpp"

namespace raywatch {
namespace {

using namespace std::chrono_literals;

const Eigen::Vector3d kHidden_m(4.0, 0.0, 0.5), kOpen_m(0.0, 8.0, 0.5);

/// A hall with a wall across its middle, scanned from both sides of the wall; and perhaps two cubes of 1 m, one of
/// which only the second station can see.
class Night {
 public:
  Night(bool cubes, Time captured_at) {
    simulator::Scene scene;
    scene.add(simulator::Room{{.position_m = {0.0, 0.0, 4.0}}, {15.0, 15.0, 4.0}});
    scene.add(simulator::Box{{.position_m = {0.0, 0.0, 1.5}}, {0.1, 3.0, 1.5}});
    for (const Eigen::Vector3d& at_m : {kHidden_m, kOpen_m}) {
      if (cubes) scene.add(simulator::Box{{.position_m = at_m}, Eigen::Vector3d::Constant(0.5)});
    }
    const simulator::RayCaster world(scene);
    simulator::Scanner scanner = simulator::grid_scanner(
        {.step_rad = simulator::radians(0.8), .highest_elevation_rad = 0.0});  // the ceiling is no ground
    scanner.errors.range_noise_m = 0.01;
    for (const double x_m : {-8.0, 8.0}) {
      simulator::ScanPlan plan = simulator::exact_plan({.position_m = {x_m, 0.3, 3.5}}, scans_.size() + 1);
      plan.captured_at = captured_at + 5min * static_cast<int>(scans_.size());
      scans_.push_back(simulator::take_scan(world, scanner, plan));
    }
    for (const simulator::SimulatedScan& scan : scans_) indexes_.push_back(PriorIndex::build(scan.points, {}));
    for (std::uint32_t k = 0; k < scans_.size(); ++k) {
      epoch.add({scans_[k].points, indexes_[k], scans_[k].true_world_from_sensor, scans_[k].captured_at,
                 estimate_sensor(scans_[k].points, indexes_[k])},
                k);
    }
  }
  Night(const Night&) = delete;

 private:
  std::vector<simulator::SimulatedScan> scans_;
  std::vector<PriorIndex> indexes_;

 public:
  EpochScans epoch;
};

CompareParameters parameters_of_test() {
  CompareParameters parameters = default_parameters(Profile::indoor, Grouping::consensus);
  parameters.contemporary_tolerance = 1h;
  parameters.cluster_distance_m = 0.3;
  return parameters;
}

const Change* change_at(const EpochComparison& comparison, const Eigen::Vector3d& place_m) {
  for (const Change& change : comparison.changes) {
    if ((change.centroid_m - place_m).norm() < 1.0) return &change;
  }
  return nullptr;
}

/// The scans of an epoch that have points of a change.
std::set<std::size_t> showing(const std::vector<EpochPoints>& scans, std::ptrdiff_t change) {
  std::set<std::size_t> found;
  for (std::size_t k = 0; k < scans.size(); ++k) {
    if (std::ranges::count(scans[k].change_of, static_cast<std::int32_t>(change)) > 0) found.insert(k);
  }
  return found;
}

const Night& empty_hall() {
  static const Night night(false, Time{} + 24h);
  return night;
}
const Night& filled_hall() {
  static const Night night(true, Time{} + 48h);
  return night;
}

TEST_CASE("what only one station can see is found, and what both see is one change") {
  const EpochComparison found = compare_epochs({empty_hall().epoch, filled_hall().epoch}, parameters_of_test());
  REQUIRE(found.changes.size() == 2);
  const Change* hidden = change_at(found, kHidden_m);
  const Change* open = change_at(found, kOpen_m);
  REQUIRE(hidden);
  REQUIRE(open);
  CHECK(hidden->kind == ChangeKind::added);
  CHECK(showing(found.after, hidden - found.changes.data()) == std::set<std::size_t>{1});
  CHECK(showing(found.after, open - found.changes.data()) == std::set<std::size_t>{0, 1});
  CHECK(showing(found.before, hidden - found.changes.data()).empty());
  CHECK(hidden->confidence.value > 0.9);
  CHECK(hidden->confidence.free <= 1.0);
  CHECK(found.testable_after > 0.9);
}

TEST_CASE("what was taken away is removed from the points of the earlier epoch") {
  const Night later(false, Time{} + 72h);
  const EpochComparison found = compare_epochs({filled_hall().epoch, later.epoch}, parameters_of_test());
  REQUIRE(found.changes.size() == 2);
  for (const Eigen::Vector3d& place_m : {kHidden_m, kOpen_m}) {
    const Change* change = change_at(found, place_m);
    REQUIRE(change);
    CHECK(change->kind == ChangeKind::removed);
    CHECK(showing(found.after, change - found.changes.data()).empty());
  }
  CHECK(std::ranges::count(found.before[1].classes, PointClass::removed) ==
        std::ranges::count_if(found.before[1].change_of, [](std::int32_t change) { return change >= 0; }));
}

TEST_CASE("an epoch compared with its like has no change") {
  const Night again(false, Time{} + 72h);
  const EpochComparison found = compare_epochs({empty_hall().epoch, again.epoch}, parameters_of_test());
  CHECK(found.changes.empty());
  for (const EpochPoints& scan : found.after) CHECK(std::ranges::count(scan.classes, PointClass::added) == 0);
}

TEST_CASE("each change has the volume between the grounds over that part of its footprint that both epochs saw") {
  const EpochPair epochs{empty_hall().epoch, filled_hall().epoch};
  const EpochComparison found = compare_epochs(epochs, parameters_of_test());
  const GridLayout layout = layout_over({Eigen::Vector2d(-10, -10), Eigen::Vector2d(10, 10)}, 0.25);
  const ElevationModel before = make_elevation_model(epochs.before, layout, {.least_quarters = 2});
  const ElevationModel after = make_elevation_model(epochs.after, layout, {.least_quarters = 2});
  const std::vector<FootprintVolume> volumes = volumes_of_changes(epochs, found, before, after);
  REQUIRE(volumes.size() == found.changes.size());
  for (const FootprintVolume& volume : volumes) {
    // The cubes are 1 m high; cells across their sides are lower.
    CHECK(volume.net.value_m3 > 0.45 * volume.seen_area_m2);
    CHECK(volume.net.value_m3 < 1.1 * volume.seen_area_m2);
    CHECK(volume.seen_area_m2 > 0.25);
    CHECK(volume.area_m2 < 2.5);
  }
}

TEST_CASE("one thread and eight give the same result") {
  const auto run = [](int threads) {
    tbb::task_arena arena(threads);
    return arena.execute([] {
      return compare_epochs({empty_hall().epoch, filled_hall().epoch}, parameters_of_test());
    });
  };
  const EpochComparison one = run(1), eight = run(8);
  REQUIRE(one.changes.size() == eight.changes.size());
  for (std::size_t i = 0; i < one.changes.size(); ++i) {
    CHECK((one.changes[i].centroid_m.array() == eight.changes[i].centroid_m.array()).all());
  }
  for (std::size_t k = 0; k < one.after.size(); ++k) {
    CHECK(one.after[k].classes == eight.after[k].classes);
    CHECK(one.after[k].change_of == eight.after[k].change_of);
    CHECK(one.before[k].classes == eight.before[k].classes);
  }
}

TEST_CASE("epochs that are empty or not apart in time are refused") {
  const EpochScans nothing;
  CHECK_THROWS_AS(compare_epochs({nothing, filled_hall().epoch}, parameters_of_test()), InvalidInput);
  CHECK_THROWS_AS(compare_epochs({filled_hall().epoch, empty_hall().epoch}, parameters_of_test()), InvalidInput);
  CHECK_THROWS_AS(compare_epochs({empty_hall().epoch, empty_hall().epoch}, parameters_of_test()), InvalidInput);
}

}  // namespace
}  // namespace raywatch
