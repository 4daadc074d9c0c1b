#include "api/voxel_thinning.hpp"

#include <doctest/doctest.h>
#include <rapidcheck.h>

#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>

namespace raywatch {
namespace {

struct ThinnedPoints {
  std::vector<float> x_m, y_m, z_m;
  std::vector<std::uint8_t> groups;
  ThinningInput view() const { return {x_m, y_m, z_m, groups}; }
};

TEST_CASE("the point nearest to the mean of its voxel stays, the first of equals") {
  const ThinnedPoints points{
      {0.1F, 0.5F, 0.9F, 1.25F, 1.75F}, {0.5F, 0.5F, 0.5F, 0.5F, 0.5F}, {0.5F, 0.5F, 0.5F, 0.5F, 0.5F}, {}};
  CHECK_EQ(thin(points.view(), 1.0), std::vector<std::uint32_t>{1, 3});
}

TEST_CASE("voxels reach to both sides of zero alike") {
  const ThinnedPoints points{{-0.25F, 0.25F}, {0.0F, 0.0F}, {0.0F, 0.0F}, {}};
  CHECK_EQ(thin(points.view(), 1.0).size(), 2);
}

TEST_CASE("groups never stand for each other") {
  const ThinnedPoints points{{0.5F, 0.5F, 0.5F}, {0.5F, 0.5F, 0.5F}, {0.5F, 0.5F, 0.5F}, {0, 1, 0}};
  CHECK_EQ(thin(points.view(), 1.0), std::vector<std::uint32_t>{0, 1});
}

TEST_CASE("what is not finite is left out, and no coordinate is too large") {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float huge = std::numeric_limits<float>::max();
  const ThinnedPoints points{{nan, 1.0F, huge, 1.0F}, {0.0F, nan, huge, 0.0F}, {0.0F, 0.0F, -huge, 0.0F}, {}};
  CHECK_EQ(thin(points.view(), 0.001), std::vector<std::uint32_t>{2, 3});
}

TEST_CASE("one point of every occupied voxel stays, and it is one of those in it") {
  CHECK(rc::check([](const std::vector<std::tuple<std::int8_t, std::int8_t, std::int8_t>>& places) {
    ThinnedPoints points;
    std::map<std::array<double, 3>, int> voxels;
    for (const auto& [x, y, z] : places) {
      points.x_m.push_back(static_cast<float>(x) * 0.25F);
      points.y_m.push_back(static_cast<float>(y) * 0.25F);
      points.z_m.push_back(static_cast<float>(z) * 0.25F);
      voxels[{std::floor(points.x_m.back()), std::floor(points.y_m.back()), std::floor(points.z_m.back())}] = 0;
    }
    for (const std::uint32_t place : thin(points.view(), 1.0)) {
      RC_ASSERT(place < points.x_m.size());
      ++voxels[{std::floor(points.x_m[place]), std::floor(points.y_m[place]), std::floor(points.z_m[place])}];
    }
    for (const auto& [voxel, count] : voxels) RC_ASSERT(count == 1);
  }));
}

}  // namespace
}  // namespace raywatch
