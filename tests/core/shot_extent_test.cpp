// How far clusters reach, counted in shots.

#include "core/shot_extent.hpp"

#include <doctest/doctest.h>
#include <rapidcheck.h>

#include <cmath>
#include <vector>

#include "tests/core/shots.hpp"

namespace raywatch {
namespace {

Taken wall() {
  return Taken(shoot([](int, int) { return 10.0; }));
}

TEST_CASE("a block of neighbouring shots is as long and as wide as it has columns and rows, and is full") {
  const Taken scan = wall();
  CHECK(rc::check([&] {
    const int columns = *rc::gen::inRange(1, 8), rows = *rc::gen::inRange(1, 8);
    std::vector<std::uint32_t> members;
    for (int c = 0; c < columns; ++c) {
      for (int r = 0; r < rows; ++r) members.push_back(shot(c - 4, r - 4));
    }
    const ShotExtent extent = extent_in_shots(scan.view(), members);
    RC_ASSERT(std::abs(extent.length - std::max(columns, rows)) < 0.1);
    RC_ASSERT(std::abs(extent.width - std::min(columns, rows)) < 0.1);
    RC_ASSERT(std::abs(extent.filled - 1.0) < 0.05);
  }));
}

TEST_CASE("of a chequered block half is filled, and a slanting line is one shot wide") {
  const Taken scan = wall();
  std::vector<std::uint32_t> chequered, slanting;
  for (int c = -4; c <= 4; ++c) {
    slanting.push_back(shot(c, c));
    for (int r = -4; r <= 4; ++r) {
      if ((c + r) % 2 == 0) chequered.push_back(shot(c, r));
    }
  }
  CHECK(extent_in_shots(scan.view(), chequered).filled == doctest::Approx(0.5).epsilon(0.05));
  CHECK(extent_in_shots(scan.view(), slanting).width == doctest::Approx(1.0).epsilon(0.05));
}

}  // namespace
}  // namespace raywatch
