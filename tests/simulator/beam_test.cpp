#include "tests/simulator/beam.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <set>

using namespace raywatch;
using namespace raywatch::simulator;

namespace {

constexpr ScannerErrors kWideBeam{.beam_divergence_rad = 0.01};

/// A near wall that covers y > 0 at x = near, and a far one behind it.
Scene edge_before_wall(double near_m, double far_m) {
  Scene scene;
  scene.add(Box{{Eigen::Quaterniond::Identity(), {near_m + 0.05, 5.0, 0.0}}, {0.05, 5.0, 5.0}}, 1);
  scene.add(Plane{{far_m, 0.0, 0.0}, -Eigen::Vector3d::UnitX()});
  return scene;
}

Ray across_edge(double offset_rad) { return {{0, 0, 0}, {std::cos(offset_rad), std::sin(offset_rad), 0.0}}; }

}  // namespace

TEST_CASE("returns of a beam across an edge lie between the two surfaces, or on one of them") {
  const Scene scene = edge_before_wall(5.0, 6.0);
  const RayCaster world(scene);
  std::set<StateId> seen;
  for (double offset_rad = -0.01; offset_rad <= 0.01; offset_rad += 1e-4) {
    const auto found = trace_beam(world, across_edge(offset_rad), kWideBeam);
    REQUIRE(found.has_value());
    seen.insert(found->state);
    const double along_m = found->range_m * std::cos(offset_rad);
    if (found->state == 1) CHECK(along_m == doctest::Approx(5.0).epsilon(1e-3));
    if (found->state == kBackground) CHECK(along_m == doctest::Approx(6.0).epsilon(1e-3));
    if (found->state == kNoSurface) {
      CHECK(along_m > 5.05);
      CHECK(along_m < 5.95);
    }
  }
  CHECK(seen == std::set<StateId>{kBackground, 1, kNoSurface});
}

TEST_CASE("surfaces farther apart than the blend length are never mixed") {
  const Scene scene = edge_before_wall(5.0, 12.0);
  const RayCaster world(scene);
  for (double offset_rad = -0.01; offset_rad <= 0.01; offset_rad += 1e-4) {
    CHECK(trace_beam(world, across_edge(offset_rad), kWideBeam)->state != kNoSurface);
  }
}

TEST_CASE("a beam on one slanted surface returns the range of its axis") {
  Scene scene;
  scene.add(Plane{{0.0, 0.0, -2.0}, Eigen::Vector3d::UnitZ()});
  const RayCaster world(scene);
  for (const double descent_rad : {0.03, 0.1, 0.5, 1.5}) {
    const auto found = trace_beam(world, {{0, 0, 0}, {std::cos(descent_rad), 0.0, -std::sin(descent_rad)}}, kWideBeam);
    REQUIRE(found.has_value());
    CHECK(found->range_m == doctest::Approx(2.0 / std::sin(descent_rad)).epsilon(1e-12));
    CHECK(found->state == kBackground);
  }
}

TEST_CASE("a beam whose edge alone touches a thing before the sky returns the thing") {
  Scene scene;
  scene.add(Box{{Eigen::Quaterniond::Identity(), {5.05, 5.0, 0.0}}, {0.05, 5.0, 5.0}}, 1);
  const RayCaster world(scene);
  const auto found = trace_beam(world, across_edge(-0.003), kWideBeam);
  REQUIRE(found.has_value());
  CHECK(found->state == 1);
  CHECK_FALSE(trace_beam(world, across_edge(-0.003), ScannerErrors{}).has_value());
}
