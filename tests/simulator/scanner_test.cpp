#include "tests/simulator/scanner.hpp"

#include <doctest/doctest.h>

#include <algorithm>

using namespace raywatch::simulator;

TEST_CASE("a grid of one degree covers the sphere once") {
  const Scanner scanner = grid_scanner({});
  CHECK(scanner.azimuths_rad.size() == 360);
  CHECK(scanner.elevations_rad.size() == 181);
  CHECK(scanner.elevations_rad.front() == doctest::Approx(radians(-90.0)));
  CHECK(scanner.elevations_rad.back() == doctest::Approx(radians(90.0)));
  CHECK(scanner.azimuths_rad.back() == doctest::Approx(radians(179.0)));
}

TEST_CASE("the spinning sensor has 64 rings, finer above than below") {
  const Scanner scanner = spinning_scanner({});
  REQUIRE(scanner.elevations_rad.size() == 64);
  CHECK(std::ranges::is_sorted(scanner.elevations_rad, std::greater<>()));
  CHECK(scanner.elevations_rad[0] == doctest::Approx(radians(2.0)));
  CHECK(scanner.elevations_rad[0] - scanner.elevations_rad[1] == doctest::Approx(radians(1.0 / 3.0)));
  CHECK(scanner.elevations_rad[62] - scanner.elevations_rad[63] == doctest::Approx(radians(0.5)));
  CHECK(scanner.elevations_rad[63] == doctest::Approx(radians(-24.33)));
  CHECK(scanner.shot_count() == 64 * 1800);
}

TEST_CASE("the tripod scanner shoots 1.4 million times in a full turn") {
  const Scanner scanner = tripod_scanner({});
  CHECK(scanner.shot_count() == 1'400'000);
  CHECK(scanner.elevations_rad.front() == doctest::Approx(radians(-60.0)));
  CHECK(scanner.elevations_rad.back() == doctest::Approx(radians(60.0)));
}
