#include "core/elevation_model.hpp"

#include <doctest/doctest.h>
#include <oneapi/tbb/task_arena.h>

#include <cstring>
#include <functional>

#include "core/error.hpp"
#include "tests/simulator/random.hpp"
#include "tests/simulator/simulated_scan.hpp"

namespace raywatch {
namespace {

using simulator::RandomSequence;

/// A scan of the ground z = height(x, y) at random places of a square around the origin.
struct GroundScan {
  GroundScan(const std::function<double(double, double)>& height_m, const Pose& pose, int count, std::uint64_t seed) {
    RandomSequence random(seed);
    const Pose sensor_from_world = pose.inverse();
    for (int i = 0; i < count; ++i) {
      const double x = random.in({-10.0, 10.0}), y = random.in({-10.0, 10.0});
      const Eigen::Vector3d p = sensor_from_world * Eigen::Vector3d(x, y, height_m(x, y));
      points.push_back(static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z()));
    }
    index.emplace(PriorIndex::build(points, {}));
    world_from_sensor = pose;
  }
  ScanView view() const { return {points, *index, world_from_sensor, Time{}, sensor, uncertainty}; }

  PointCloud points;
  std::optional<PriorIndex> index;
  Pose world_from_sensor;
  PoseUncertainty uncertainty;
  SensorModel sensor;
};

const Pose kAbove{.position_m = {3.0, -2.0, 15.0}};
const GridLayout kLayout{.origin_m = {-10.0, -10.0}, .cell_m = 1.0, .columns = 20, .rows = 20};

double slanted(double x, double y) { return 2.0 + 0.3 * x - 0.2 * y; }

EpochScans epoch_of_scans(std::initializer_list<const GroundScan*> scans) {
  EpochScans epoch;
  for (const GroundScan* scan : scans) epoch.add(scan->view(), static_cast<std::uint32_t>(epoch.scans.size()));
  return epoch;
}

TEST_CASE("of a slanted plane every cell has the height of its middle and the slope, wherever the returns lie in it") {
  const GroundScan scan(slanted, kAbove, 8000, 1);
  for (const CellHeight height : {CellHeight::mean, CellHeight::median}) {
    const ElevationModel model = make_elevation_model(epoch_of_scans({&scan}), kLayout, {.height = height});
    std::size_t seen = 0;
    for (std::size_t i = 0; i < model.cells.size(); ++i) {
      if (!model.cells[i].seen()) continue;
      ++seen;
      const Eigen::Vector2d at_m = kLayout.center_m(i);
      CHECK(model.cells[i].height_m == doctest::Approx(slanted(at_m.x(), at_m.y())).epsilon(1e-5));
      CHECK((model.cells[i].slope - Eigen::Vector2d(0.3, -0.2)).norm() < 1e-4);
      CHECK(model.cells[i].spread_m < 1e-4);
    }
    CHECK(seen > 380);
  }
}

/// The same scan with noise in its ranges, of which it tells.
GroundScan noisy(const GroundScan& exact, double range_noise_m, std::uint64_t seed) {
  GroundScan scan([](double, double) { return 0.0; }, exact.world_from_sensor, 0, seed);
  RandomSequence random(seed);
  for (std::size_t i = 0; i < exact.points.size(); ++i) {
    const Eigen::Vector3f p = exact.points[i];
    const Eigen::Vector3f q = p * (1.0f + static_cast<float>(range_noise_m * random.normal()) / p.norm());
    scan.points.push_back(q.x(), q.y(), q.z());
  }
  scan.index.emplace(PriorIndex::build(scan.points, {}));
  scan.sensor.range_noise_m = range_noise_m;
  return scan;
}

/// The claimed variance of the heights over how much they scatter, over some models.
double claimed_over_scatter(const std::function<double(double, double)>& height_m, bool tells_noise) {
  double scatter2 = 0.0, claimed2 = 0.0;
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    GroundScan scan = noisy(GroundScan(height_m, kAbove, 6000, seed), 0.05, 100 + seed);
    if (!tells_noise) scan.sensor = {};
    const ElevationModel model = make_elevation_model(epoch_of_scans({&scan}), kLayout, {});
    for (std::size_t i = 0; i < model.cells.size(); ++i) {
      if (!model.cells[i].seen()) continue;
      const Eigen::Vector2d at_m = kLayout.center_m(i);
      scatter2 += std::pow(model.cells[i].height_m - height_m(at_m.x(), at_m.y()), 2.0);
      claimed2 += std::pow(model.cells[i].sigma_m, 2.0);
    }
  }
  return claimed2 / scatter2;
}

TEST_CASE("the standard error of a cell is how far its height scatters") {
  const double ratio = claimed_over_scatter(slanted, true);
  CHECK(ratio > 0.9);
  CHECK(ratio < 1.3);
  // Whose noise is not known may show the shape of the ground, which does not average out.
  CHECK(claimed_over_scatter(slanted, false) > ratio);
}

TEST_CASE("where the ground bends within a cell, its standard error is larger, whatever the number of returns") {
  // The foot of a face, across a column of cells.
  const auto foot = [](double x, double) { return std::max(0.0, 3.0 * (x - 0.3)); };
  const GroundScan few(foot, kAbove, 12000, 1), many(foot, kAbove, 120000, 2);
  const std::size_t across = kLayout.cell_at(0.3, 0.5).value(), beyond = kLayout.cell_at(5.5, 0.5).value();
  for (const GroundScan* scan : {&few, &many}) {
    const ElevationModel model = make_elevation_model(epoch_of_scans({scan}), kLayout, {});
    CHECK(model.cells[across].sigma_m > 0.05);
    CHECK(model.cells[beyond].sigma_m < 0.01);
    // The mean over the cell [0, 1]: the integral of 3 (x - 0.3) from 0.3 on.
    CHECK(std::abs(model.cells[across].height_m - 0.5 * 3.0 * 0.7 * 0.7) < 2.0 * model.cells[across].sigma_m);
  }
}

TEST_CASE("a cell that is seen in part was not seen") {
  const GroundScan scan([](double, double) { return 0.0; }, kAbove, 8000, 2);
  GroundScan half([](double, double) { return 0.0; }, kAbove, 0,
                  2);  // nothing beyond x = 0.4, which lies inside of a column of cells
  half.points = {};
  for (std::size_t i = 0; i < scan.points.size(); ++i) {
    const Eigen::Vector3f p = scan.points[i];
    if (p.x() + 3.0f < 0.4f) half.points.push_back(p.x(), p.y(), p.z());
  }
  half.index.emplace(PriorIndex::build(half.points, {}));
  const ElevationModel model = make_elevation_model(epoch_of_scans({&half}), kLayout, {});
  const ElevationModel lenient = make_elevation_model(epoch_of_scans({&half}), kLayout, {.least_quarters = 2});
  const std::size_t cut = kLayout.cell_at(0.2, 0.5).value(), left = kLayout.cell_at(-1.5, 0.5).value();
  CHECK(model.cells[left].seen());
  CHECK_FALSE(model.cells[cut].seen());
  CHECK(lenient.cells[cut].height_m == doctest::Approx(0.0));
  CHECK_FALSE(model.cells[kLayout.cell_at(5.0, 5.0).value()].seen());
}

TEST_CASE("a median does not see what stands in less than half of a cell") {
  const auto with_truck = [](double x, double y) { return x > 0.7 && x < 1.0 && y > 0.0 && y < 1.0 ? 3.0 : 0.0; };
  const GroundScan scan(with_truck, kAbove, 20000, 3);
  const std::size_t cell = kLayout.cell_at(0.5, 0.5).value();
  const auto height_m = [&](CellHeight height) {
    return make_elevation_model(epoch_of_scans({&scan}), kLayout, {.height = height}).cells[cell].height_m;
  };
  CHECK(height_m(CellHeight::mean) > 0.5);
  CHECK(std::abs(height_m(CellHeight::median)) < 1.0);
}

TEST_CASE("moving a station moves the heights by the leverage of its pose times its share") {
  const GroundScan one(slanted, kAbove, 9000, 4), other(slanted, Pose{.position_m = {-8.0, 5.0, 12.0}}, 9000, 5);
  const ElevationModel before = make_elevation_model(epoch_of_scans({&one, &other}), kLayout, {.least_quarters = 1});
  const Eigen::Vector3d shift_m(0.01, -0.02, 0.015), turn(1e-3, -2e-3, 1.5e-3);
  GroundScan moved(slanted, kAbove, 9000, 4);
  moved.world_from_sensor.position_m += shift_m;
  moved.world_from_sensor.orientation = Eigen::AngleAxisd(turn.norm(), turn.normalized());
  const ElevationModel after = make_elevation_model(epoch_of_scans({&moved, &other}), kLayout, {.least_quarters = 1});
  // Quarters weigh alike, so that a station's share of a height is not quite that of the returns: on average it is.
  double moved_m = 0.0, expected_m = 0.0;
  for (std::size_t i = 0; i < before.cells.size(); ++i) {
    if (!before.cells[i].seen() || !after.cells[i].seen()) continue;
    const HeightLeverage leverage = leverage_of(before, 0, i);
    moved_m += std::abs(after.cells[i].height_m - before.cells[i].height_m);
    expected_m += std::abs(leverage.translation.dot(shift_m) + leverage.rotation_m.dot(turn));
    CHECK(before.stations[0].share[i] + before.stations[1].share[i] == doctest::Approx(1.0));
  }
  CHECK(moved_m / expected_m == doctest::Approx(1.0).epsilon(0.05));
}

TEST_CASE("scans of one station share its error, those of two have one each") {
  GroundScan scan(slanted, kAbove, 9000, 6);
  scan.uncertainty = {.position_m = 0.01, .angle_rad = 0.0};
  EpochScans shared, apart;
  for (std::uint32_t k = 0; k < 2; ++k) {
    shared.add(scan.view(), 7);
    apart.add(scan.view(), k);
  }
  const ElevationModel one = make_elevation_model(shared, kLayout, {}), two = make_elevation_model(apart, kLayout, {});
  CHECK(one.stations.size() == 1);
  CHECK(two.stations.size() == 2);
  // A plane without noise: the level of detection is that of the pose errors, 1 cm each, along (-slope, 1).
  const std::size_t cell = kLayout.cell_at(0.5, 0.5).value();
  const double up = std::sqrt(1.0 + 0.3 * 0.3 + 0.2 * 0.2);
  CHECK(difference_of(one, one)[cell].lod95_m == doctest::Approx(1.96 * 0.01 * up * std::sqrt(2.0)).epsilon(0.01));
  CHECK(difference_of(two, two)[cell].lod95_m == doctest::Approx(1.96 * 0.01 * up).epsilon(0.01));
}

/// Ground at 0 with a wall of 3 m, 10 m away, seen from a height of 5 m.
struct WalledScan {
  WalledScan() {
    simulator::Scene scene;
    scene.add(simulator::Plane{{0, 0, 0}, {0, 0, 1}});
    scene.add(simulator::Box{{.position_m = {10.0, 0.0, 1.5}}, {0.25, 30.0, 1.5}});
    const simulator::Scanner scanner = simulator::grid_scanner({.step_rad = simulator::radians(0.5),
                                                                .lowest_elevation_rad = simulator::radians(-60.0),
                                                                .highest_elevation_rad = simulator::radians(-3.0)});
    const Pose pose{.position_m = {0.0, 0.0, 5.0}};
    points = simulator::take_scan(simulator::RayCaster(scene), scanner, simulator::exact_plan(pose)).points;
    index.emplace(PriorIndex::build(points, {}));
    epoch.add({points, *index, pose, Time{}, estimate_sensor(points, *index)}, 0);
  }
  PointCloud points;
  std::optional<PriorIndex> index;
  EpochScans epoch;
};

TEST_CASE("behind a wall the ground is not seen, but lies below the rays that pass over it") {
  const WalledScan scan;
  const GridLayout layout{.origin_m = {0.0, -4.0}, .cell_m = 1.0, .columns = 40, .rows = 8};
  const ElevationModel model = make_elevation_model(scan.epoch, layout, {});
  const ElevationCell& front = model.cells[layout.cell_at(6.5, 0.5).value()];
  const ElevationCell& hidden = model.cells[layout.cell_at(14.5, 0.5).value()];
  const ElevationCell& beyond = model.cells[layout.cell_at(29.5, 0.5).value()];
  CHECK(front.height_m == doctest::Approx(0.0).epsilon(1e-3));
  CHECK_FALSE(hidden.seen());
  // The ray over the top of the wall falls by 2 m in 10.25 m: at 14 m it is at 2.27 m, and the next one a little
  // higher.
  CHECK(hidden.ceiling_m >= 5.0 - 2.0 * 14.0 / 9.75);
  CHECK(hidden.ceiling_m < 2.9);
  CHECK(beyond.ceiling_m < 1.0);
  for (const ElevationCell& cell : model.cells) CHECK(cell.ceiling_m > 0.0);
}

TEST_CASE("one thread and eight give the same bytes") {
  const GroundScan one(slanted, kAbove, 9000, 7), other(slanted, Pose{.position_m = {-8.0, 5.0, 12.0}}, 9000, 8);
  const auto run = [&](int threads) {
    tbb::task_arena arena(threads);
    return arena.execute([&] {
      return make_elevation_model(epoch_of_scans({&one, &other}), kLayout, {.height = CellHeight::median});
    });
  };
  const ElevationModel first = run(1), second = run(8);
  for (std::size_t i = 0; i < first.cells.size(); ++i) {
    CHECK(std::memcmp(&first.cells[i].height_m, &second.cells[i].height_m, sizeof(double)) == 0);
    CHECK(std::memcmp(&first.cells[i].ceiling_m, &second.cells[i].ceiling_m, sizeof(double)) == 0);
  }
}

TEST_CASE("layouts have their corners at multiples of the cell, and a cell of a sensible size") {
  const GridLayout layout = layout_over({Eigen::Vector2d(-3.1, 0.2), Eigen::Vector2d(4.9, 1.0)}, 0.5);
  CHECK(layout == GridLayout{.origin_m = {-3.5, 0.0}, .cell_m = 0.5, .columns = 17, .rows = 2});
  CHECK(layout.cell_at(-3.5, 0.0) == 0u);
  CHECK(layout.cell_at(4.99, 0.99) == 33u);
  CHECK_FALSE(layout.cell_at(5.0, 0.5));
  CHECK_THROWS_AS(layout_over({Eigen::Vector2d(0, 0), Eigen::Vector2d(1e5, 1e5)}, 1.0), InvalidInput);
  CHECK_THROWS_AS(layout_over({Eigen::Vector2d(0, 0), Eigen::Vector2d(1, 1)}, 0.0), InvalidInput);
}

}  // namespace
}  // namespace raywatch
