#include "tests/simulator/simulated_scan.hpp"

#include <doctest/doctest.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "tests/simulator/things.hpp"
#include "tests/simulator/wall_and_box.hpp"

using namespace raywatch;
using namespace raywatch::simulator;

namespace {

const ScannerErrors kEverything{.range_noise_m = 0.02,
                                .angular_noise_rad = 5e-4,
                                .beam_divergence_rad = 3e-3,
                                .dropout_share = 0.05,
                                .self_return_share = 0.03};

SimulatedScan scan_inside_sphere(const ScannerErrors& errors, std::uint64_t seed) {
  Scene scene;
  scene.add(Sphere{{0, 0, 0}, 10.0});
  Scanner scanner = grid_scanner({.step_rad = radians(1.0)});
  scanner.errors = errors;
  return take_scan(RayCaster(scene), scanner, exact_plan({}, seed));
}

bool same_bytes(const std::vector<float>& a, const std::vector<float>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(float)) == 0;
}

}  // namespace

TEST_CASE("a scan of a wall and a box labels the box and nothing else") {
  const Scene scene = wall_and_box({.box_center_m = Eigen::Vector3d(5.0, 0.0, 0.0)});
  const RayCaster world(scene);
  const SimulatedScan scan = take_scan(world, grid_scanner({}), exact_plan({}));

  REQUIRE(scan.labels.size() == scan.points.size());
  std::size_t on_box = 0;
  for (std::size_t i = 0; i < scan.points.size(); ++i) {
    const Eigen::Vector3f point = scan.points[i];
    const bool in_box = point.x() < 6.0F;
    CHECK(scan.labels[i] == (in_box ? kBoxState : kBackground));
    CHECK(point.x() == doctest::Approx(in_box ? 4.5 : 10.0).epsilon(1e-6));
    on_box += in_box ? 1U : 0U;
  }
  // Half a metre at 4.5 m is 6.34 degrees: 13 columns, and 13 rows in each of them.
  CHECK(on_box == 13 * 13);
  CHECK(scan.present == std::vector<StateId>{kBoxState});
}

TEST_CASE("points are in the frame of the sensor") {
  const Scene scene = wall_and_box({.wall_distance_m = 10.0});
  const Pose world_from_sensor{Eigen::Quaterniond(Eigen::AngleAxisd(0.4, Eigen::Vector3d(1, 2, 3).normalized())),
                               {3.0, -2.0, 1.0}};
  const SimulatedScan scan = take_scan(RayCaster(scene), grid_scanner({}), exact_plan(world_from_sensor));
  REQUIRE(scan.points.size() > 20'000);
  for (std::size_t i = 0; i < scan.points.size(); i += 17) {
    const Eigen::Vector3d world_m = world_from_sensor * scan.points[i].cast<double>();
    // float32 keeps 24 bits of ranges that grow without bound towards the horizon of the wall.
    CHECK(std::abs(world_m.x() - 10.0) < 1e-6 * (10.0 + world_m.norm()));
  }
}

TEST_CASE("truth is asymmetric: a state counts as changed where the other scan's world lacks it") {
  const Scene with = wall_and_box({.box_center_m = Eigen::Vector3d(5.0, 0.0, 0.0)});
  const Scene without = wall_and_box({});
  const SimulatedScan a = take_scan(RayCaster(with), grid_scanner({}), exact_plan({}));
  const SimulatedScan b = take_scan(RayCaster(without), grid_scanner({}), exact_plan({}));
  const auto changed = [](const SimulatedScan& scan, const SimulatedScan& other) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < scan.points.size(); ++i) count += is_truly_changed(scan, i, other) ? 1U : 0U;
    return count;
  };
  CHECK(changed(a, b) == 13 * 13);
  CHECK(changed(b, a) == 0);
  CHECK(changed(a, a) == 0);
}

TEST_CASE("range noise has the given standard deviation and no bias") {
  const SimulatedScan scan = scan_inside_sphere({.range_noise_m = 0.02}, 3);
  double sum_m = 0.0;
  double squares_m2 = 0.0;
  for (std::size_t i = 0; i < scan.points.size(); ++i) {
    const double error_m = scan.points[i].cast<double>().norm() - 10.0;
    sum_m += error_m;
    squares_m2 += error_m * error_m;
  }
  const auto count = static_cast<double>(scan.points.size());
  CHECK(count == 360 * 181);
  CHECK(std::abs(sum_m / count) < 4.0 * 0.02 / std::sqrt(count));
  CHECK(std::sqrt(squares_m2 / count) == doctest::Approx(0.02).epsilon(0.02));
}

TEST_CASE("angular noise moves the true ray and leaves the reported direction") {
  // On a wall seen at 45 degrees a small angle e changes the range r by r * e.
  Scene scene;
  scene.add(Plane{{10.0, 0.0, 0.0}, -Eigen::Vector3d::UnitX()});
  Scanner scanner;
  scanner.azimuths_rad.assign(20'000, radians(45.0));
  scanner.elevations_rad = {0.0};
  scanner.errors.angular_noise_rad = 1e-3;
  const SimulatedScan scan = take_scan(RayCaster(scene), scanner, exact_plan({}, 9));
  const double range_m = 10.0 * std::sqrt(2.0);
  double squares_m2 = 0.0;
  for (std::size_t i = 0; i < scan.points.size(); ++i) {
    const Eigen::Vector3d point_m = scan.points[i].cast<double>();
    CHECK(std::abs(point_m.y() - point_m.x()) < 1e-5);
    squares_m2 += (point_m.norm() - range_m) * (point_m.norm() - range_m);
  }
  CHECK(std::sqrt(squares_m2 / 20'000) == doctest::Approx(range_m * 1e-3).epsilon(0.03));
}

TEST_CASE("dropouts and returns of the rig have their shares") {
  const SimulatedScan whole = scan_inside_sphere({}, 4);
  const SimulatedScan dropped = scan_inside_sphere({.dropout_share = 0.1}, 4);
  CHECK(static_cast<double>(dropped.points.size()) ==
        doctest::Approx(0.9 * static_cast<double>(whole.points.size())).epsilon(0.01));

  const SimulatedScan rigged = scan_inside_sphere({.self_return_share = 0.02}, 4);
  std::size_t near = 0;
  for (std::size_t i = 0; i < rigged.points.size(); ++i) {
    if (rigged.points[i].norm() >= 0.7F) continue;
    ++near;
    CHECK(rigged.labels[i] == kNoSurface);
  }
  // Three posts, each of which hides 3 columns: one in its middle, and those within 1.2 degrees of it.
  CHECK(near == 9 * 181);
}

TEST_CASE("a shot without return is left out, or keeps its cell in the grid") {
  const Scene scene = wall_and_box({});
  const RayCaster world(scene);
  Scanner scanner = grid_scanner({.step_rad = radians(2.0)});
  scanner.max_range_m = 100.0;
  const SimulatedScan omitted = take_scan(world, scanner, exact_plan({}));
  CHECK_FALSE(omitted.points.grid.has_value());
  CHECK(omitted.points.size() < scanner.shot_count());

  const auto expect = [&](NoReturn policy, auto is_expected) {
    scanner.no_return = policy;
    scanner.sentinel_range_m = 250.0;
    const SimulatedScan scan = take_scan(world, scanner, exact_plan({}));
    REQUIRE(scan.points.size() == scanner.shot_count());
    CHECK(scan.points.grid == ShotGrid{91, 180});
    std::size_t none = 0;
    for (std::size_t i = 0; i < scan.points.size(); ++i) {
      if (scan.labels[i] != kNoSurface) continue;
      ++none;
      CHECK(is_expected(scan.points[i]));
    }
    CHECK(none == scanner.shot_count() - omitted.points.size());
  };
  expect(NoReturn::nan, [](const Eigen::Vector3f& p) { return std::isnan(p.x()) && std::isnan(p.z()); });
  expect(NoReturn::zero, [](const Eigen::Vector3f& p) { return p.norm() == 0.0F; });
  expect(NoReturn::sentinel, [](const Eigen::Vector3f& p) { return std::abs(p.norm() - 250.0F) < 1e-3F; });
}

TEST_CASE("the number of threads changes no byte, the seed changes the errors") {
  Scene scene = wall_and_box({.box_center_m = Eigen::Vector3d(5.0, 0.0, 0.0)});
  scene.add(placed(leaves({.seed = 3}, 5), {{3.0, 2.0, -2.0}, 0.0}));
  const RayCaster world(scene);
  Scanner scanner = spinning_scanner({});
  scanner.errors = kEverything;
  const tbb::global_control eight_workers(tbb::global_control::max_allowed_parallelism, 8);
  const auto with_threads = [&](int threads, std::uint64_t seed) {
    tbb::task_arena arena(threads);
    return arena.execute([&] { return take_scan(world, scanner, exact_plan({}, seed)); });
  };
  const SimulatedScan one = with_threads(1, 11);
  const SimulatedScan eight = with_threads(8, 11);
  CHECK(same_bytes(one.points.x_m, eight.points.x_m));
  CHECK(same_bytes(one.points.y_m, eight.points.y_m));
  CHECK(same_bytes(one.points.z_m, eight.points.z_m));
  CHECK(one.labels == eight.labels);
  CHECK_FALSE(same_bytes(one.points.x_m, with_threads(1, 12).points.x_m));
}
