// What a scan shows about the sensor that took it.

#include "core/sensor.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <random>

#include "tests/simulator/scanner.hpp"
#include "tests/simulator/simulated_scan.hpp"
#include "tests/simulator/wall_and_box.hpp"

namespace raywatch {
namespace {

using namespace simulator;

Scene room() {
  Scene scene;
  scene.add(Room{Pose{}, {12.0, 8.0, 3.0}});
  return scene;
}

TEST_CASE("the angular resolution is found in any order of the points, separately in azimuth and elevation") {
  Scanner scanner = spinning_scanner({.rings = 64, .azimuth_steps = 1200});
  scanner.errors.range_noise_m = 0.02;
  SimulatedScan scan = take_scan(RayCaster(room()), scanner, exact_plan(Pose{}, 7));
  const auto check = [](const SensorModel& model) {
    REQUIRE(model.angular_resolution_rad);
    CHECK(model.angular_resolution_rad->x() == doctest::Approx(radians(0.3)).epsilon(0.15));
    CHECK(model.angular_resolution_rad->y() == doctest::Approx(radians(0.42)).epsilon(0.25));
  };
  check(estimate_sensor(scan.points));
  std::vector<std::size_t> order(scan.points.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::shuffle(order.begin(), order.end(), std::mt19937(5));
  PointCloud shuffled;
  for (const std::size_t i : order) shuffled.push_back(scan.points.x_m[i], scan.points.y_m[i], scan.points.z_m[i]);
  check(estimate_sensor(shuffled));
  CHECK(estimate_sensor(shuffled).angular_resolution_rad == estimate_sensor(scan.points).angular_resolution_rad);
  CHECK(estimate_sensor(shuffled).range_noise_m == estimate_sensor(scan.points).range_noise_m);
}

TEST_CASE("the range noise is found from neighbouring returns") {
  Scanner scanner = grid_scanner({.step_rad = radians(0.5)});
  scanner.errors.range_noise_m = 0.02;
  const SensorModel model = estimate_sensor(take_scan(RayCaster(room()), scanner, exact_plan(Pose{}, 3)).points);
  REQUIRE(model.range_noise_m);
  CHECK(*model.range_noise_m == doctest::Approx(0.02).epsilon(0.15));
}

TEST_CASE("a range that stands for no return is found, and a farthest wall is not taken for one") {
  Scene half_open;
  half_open.add(Plane{{9.0, 0.0, 0.0}, -Eigen::Vector3d::UnitX()});
  Scanner scanner = grid_scanner({.step_rad = radians(1.0)});
  scanner.max_range_m = 30.0;
  scanner.no_return = NoReturn::sentinel;
  scanner.sentinel_range_m = 32.767;
  const SensorModel with = estimate_sensor(take_scan(RayCaster(half_open), scanner, exact_plan(Pose{}, 1)).points);
  REQUIRE(with.no_return_m);
  CHECK(*with.no_return_m == doctest::Approx(32.767));
  CHECK_FALSE(estimate_sensor(take_scan(RayCaster(room()), scanner, exact_plan(Pose{}, 1)).points).no_return_m);
}

TEST_CASE("nothing is guessed from too few points") {
  CHECK_FALSE(estimate_sensor(PointCloud{}).angular_resolution_rad);
  PointCloud few;
  for (int i = 0; i < 5; ++i) few.push_back(5.0f, 0.1f * static_cast<float>(i), 0.0f);
  const SensorModel model = estimate_sensor(few);
  CHECK_FALSE(model.angular_resolution_rad);
  CHECK_FALSE(model.no_return_m);
  CHECK_FALSE(model.range_noise_m);
}

TEST_CASE("what is known about a sensor comes before what is estimated") {
  const SensorModel model = merged({.range_noise_m = 0.01}, {.range_noise_m = 0.05, .max_range_m = 80.0});
  CHECK(*model.range_noise_m == 0.01);
  CHECK(*model.max_range_m == 80.0);
}

}  // namespace
}  // namespace raywatch
