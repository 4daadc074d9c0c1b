#include "tests/simulator/simulated_scan.hpp"

#include <doctest/doctest.h>

#include "tests/simulator/wall_and_box.hpp"

using namespace raywatch;
using namespace raywatch::simulator;

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
  // Half a metre at 4.5 m is 6.34 degrees: 13 columns, of which the outer ones are hit in as many rows.
  CHECK(on_box == 13 * 13);
  CHECK(scan.present == std::vector<StateId>{kBoxState});
}
