#include "api/refinement.hpp"

#include <doctest/doctest.h>
#include <rapidcheck.h>

#include <array>
#include <limits>
#include <set>

namespace raywatch {
namespace {

struct RefinedPoints {
  std::vector<float> x_m, y_m, z_m;
  CoordinatePlanes view() const { return {x_m, y_m, z_m}; }
  void push_back(float x, float y, float z) {
    x_m.push_back(x);
    y_m.push_back(y);
    z_m.push_back(z);
  }
};

using Cell = std::array<int, 3>;

/// The cells of 1/2^`round` of a cube with the edge `edge_m` at the origin that the points of these places are in.
std::set<Cell> cells(const RefinedPoints& points, std::span<const std::uint32_t> places, float edge_m, int round) {
  std::set<Cell> found;
  const float count = static_cast<float>(1 << round);
  const auto index = [&](float value_m) {
    return std::min(static_cast<int>(value_m / edge_m * count), (1 << round) - 1);
  };
  for (const std::uint32_t i : places) found.insert({index(points.x_m[i]), index(points.y_m[i]), index(points.z_m[i])});
  return found;
}

TEST_CASE("the order begins with one point for each cell of a grid, then of one twice as fine, and so on") {
  RefinedPoints points;
  constexpr int kSide = 32;  // a floor, much denser in one corner
  for (int i = 0; i < kSide; ++i)
    for (int k = 0; k < kSide; ++k) points.push_back(static_cast<float>(i), static_cast<float>(k), 0.0F);
  for (int i = 0; i < 5000; ++i)
    points.push_back(static_cast<float>(i) * 1e-4F, static_cast<float>(i % 70) * 0.01F, 0.0F);
  const auto order = refinement_order(points.view());
  REQUIRE_EQ(order.size(), points.x_m.size());
  for (int round = 0; round <= 5; ++round) {
    const std::size_t begin = std::size_t{1} << (2 * round);  // cells of a floor
    const std::span<const std::uint32_t> prefix(order.data(), begin);
    CHECK_EQ(cells(points, prefix, 31.0F, round).size(), begin);
  }
}

TEST_CASE("half of a round covers the place as the whole does") {
  RefinedPoints points;
  for (int i = 0; i < 4096; ++i) points.push_back(static_cast<float>(i % 64), static_cast<float>(i / 64), 0.0F);
  const auto order = refinement_order(points.view());
  const std::span<const std::uint32_t> prefix(order.data(), 1024 + 1024);  // one third of the last round
  std::array<int, 4> by_quarter{};
  for (const std::uint32_t i : prefix)
    ++by_quarter[(points.x_m[i] < 32.0F ? 0U : 1U) + (points.y_m[i] < 32.0F ? 0U : 2U)];
  for (const int count : by_quarter) CHECK_EQ(count, doctest::Approx(512).epsilon(0.05));
}

TEST_CASE("each finite point stands once in the order, whatever the coordinates are") {
  CHECK(rc::check([](const std::vector<std::array<std::int16_t, 3>>& coordinates, bool with_huge) {
    RefinedPoints points;
    std::set<std::uint32_t> expected;
    for (const auto& [x, y, z] : coordinates) {
      expected.insert(static_cast<std::uint32_t>(points.x_m.size()));
      points.push_back(static_cast<float>(x), static_cast<float>(y), static_cast<float>(z));
      points.push_back(std::numeric_limits<float>::quiet_NaN(), 0.0F, 0.0F);
    }
    if (with_huge) {
      for (const float huge : {std::numeric_limits<float>::max(), std::numeric_limits<float>::lowest()}) {
        expected.insert(static_cast<std::uint32_t>(points.x_m.size()));
        points.push_back(huge, 0.0F, huge);
      }
    }
    const auto order = refinement_order(points.view());
    RC_ASSERT(order.size() == expected.size());
    RC_ASSERT((std::set<std::uint32_t>(order.begin(), order.end()) == expected));
  }));
}

}  // namespace
}  // namespace raywatch
