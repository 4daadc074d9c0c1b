// How points spread, and which of a scan's returns stand for all of them.

#include "core/principal_axes.hpp"

#include <doctest/doctest.h>
#include <rapidcheck.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <random>
#include <vector>

#include "core/returns_sample.hpp"
#include "tests/core/shots.hpp"

namespace raywatch {
namespace {

using Points3d = std::vector<Eigen::Vector3d>;

/// Evenly spread over a box of this size around the origin.
Points3d box_of(const Eigen::Vector3d& size_m) {
  constexpr int kSteps = 10;
  Points3d points_m;
  for (int a = 0; a < kSteps; ++a) {
    for (int b = 0; b < kSteps; ++b) {
      for (int c = 0; c < kSteps; ++c) {
        const Eigen::Vector3d place = (Eigen::Vector3d(a, b, c).array() + 0.5) / kSteps - 0.5;
        points_m.push_back(place.cwiseProduct(size_m));
      }
    }
  }
  return points_m;
}

TEST_CASE(
    "an evenly filled box is as wide along its principal axes as it is, wherever it lies and however it is turned") {
  const Eigen::Vector3d size_m(0.2, 1.0, 3.0);
  CHECK(rc::check([&] {
    const auto draw = [](int low, int high) { return *rc::gen::inRange(low, high); };
    const Eigen::Vector3d axis(draw(-9, 10), draw(-9, 10), 10.0);
    const Pose pose{Eigen::Quaterniond(Eigen::AngleAxisd(0.1 * draw(-30, 31), axis.normalized())),
                    Eigen::Vector3d(draw(-500, 501), draw(-500, 501), draw(-50, 51))};
    Points3d points_m = box_of(size_m);
    for (Eigen::Vector3d& p : points_m) p = pose * p;
    const PrincipalAxes<3> axes = principal_axes_of<3>(points_m);
    RC_ASSERT((axes.mean - pose.position_m).norm() < 1e-9);
    RC_ASSERT((axes.widths() - size_m).norm() < 0.01 * size_m.norm());
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector3d side = pose.orientation * Eigen::Vector3d::Unit(k);
      RC_ASSERT(std::abs(axes.directions.col(k).dot(side)) > 1.0 - 1e-6);
    }
  }));
}

TEST_CASE("one point has no width") {
  const std::vector<Eigen::Vector2d> one{{3.0, 4.0}};
  const PrincipalAxes<2> axes = principal_axes_of<2>(one);
  CHECK(axes.mean == one.front());
  CHECK(axes.widths() == Eigen::Vector2d(0.0, 0.0));
}

TEST_CASE(
    "a sample of returns is of those in the ball that are wanted, the same in whichever order the scan's points came") {
  PointCloud cloud = shoot([](int column, int) { return 5.0 + 0.01 * column; });
  const Eigen::Vector3d center_m(5.0, 0.0, 0.0);
  constexpr double kRadius_m = 0.5;
  const auto sample = [&](const PointCloud& points) {
    const PriorIndex index = PriorIndex::build(points, {});
    return sample_of_returns_around(index.impl(), center_m, kRadius_m, 20,
                                    [](const Eigen::Vector3d& p) { return p.z() > 0.0; });
  };
  const Points3d chosen_m = sample(cloud);
  CHECK(chosen_m.size() > 10);
  CHECK(chosen_m.size() <= 20);
  for (const Eigen::Vector3d& p : chosen_m) {
    CHECK(p.z() > 0.0);
    CHECK((p - center_m).norm() < kRadius_m);
  }
  std::vector<std::uint32_t> order(cloud.size());
  for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = i;
  std::shuffle(order.begin(), order.end(), std::mt19937(3));
  PointCloud shuffled;
  for (const std::uint32_t i : order) shuffled.push_back(cloud.x_m[i], cloud.y_m[i], cloud.z_m[i]);
  CHECK(sample(shuffled) == chosen_m);
}

}  // namespace
}  // namespace raywatch
