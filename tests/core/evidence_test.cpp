// How a prior's evidence about single points is weighed.

#include "core/evidence.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

namespace raywatch {
namespace {

constexpr double radians(double degrees) { return degrees * std::numbers::pi / 180.0; }

Eigen::Vector3d at(double azimuth_deg, double elevation_deg, double range_m) {
  const double a = radians(azimuth_deg), e = radians(elevation_deg);
  return range_m * Eigen::Vector3d(std::cos(e) * std::cos(a), std::cos(e) * std::sin(a), std::sin(e));
}

void add(PointCloud& cloud, const Eigen::Vector3d& p) {
  cloud.push_back(static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z()));
}

/// The ground two metres below the sensor, as rings half a degree apart see it.
PointCloud ground() {
  PointCloud cloud;
  for (double elevation = -20.0; elevation <= -4.0; elevation += 0.5) {
    for (double azimuth = -10.0; azimuth <= 10.0; azimuth += 0.3) {
      add(cloud, at(azimuth, elevation, 2.0 / std::sin(radians(-elevation))));
    }
  }
  return cloud;
}

Answer weighed(const PointCloud& prior, const Eigen::Vector3d& point_m, Answer asked,
               const SurfaceTolerance& tolerance = {.roughness_m = 0.05}) {
  const PriorIndex index = PriorIndex::build(prior, {});
  PointCloud point;
  add(point, point_m);
  std::vector<Answer> answers{asked};
  weigh(index, point, Pose{}, {.angle_rad = radians(0.75), .range_m = 0.25}, tolerance, answers);
  return answers.front();
}

TEST_CASE("at grazing incidence a low thing on the ground is free before the surface, though the bare test is blind") {
  const Eigen::Vector3d low_thing(20.0, 0.2, -1.85);  // 15 cm above the ground
  const PriorIndex index = PriorIndex::build(ground(), {});
  PointCloud point;
  add(point, low_thing);
  std::vector<Answer> answers(1);
  ask(index, point, std::vector<std::uint8_t>{1}, Pose{}, {.angle_rad = radians(0.75), .range_m = 0.25}, answers);
  CHECK(answers.front() == Answer::ambiguous);
  CHECK(weighed(ground(), low_thing, Answer::ambiguous) == Answer::free);
}

TEST_CASE("what lies on the surface is supported, what lies below it occluded, and a little before it ambiguous") {
  CHECK(weighed(ground(), {11.0, 0.2, -1.96}, Answer::free) == Answer::supported);
  CHECK(weighed(ground(), {11.0, 0.2, -2.04}, Answer::ambiguous) == Answer::supported);
  CHECK(weighed(ground(), {11.0, 0.2, -2.3}, Answer::ambiguous) == Answer::occluded);
  CHECK(weighed(ground(), {11.0, 0.2, -1.92}, Answer::free) == Answer::ambiguous);
}

TEST_CASE("an uncertain pose widens what counts as on the surface: a turn by its lever, across the ray") {
  const Eigen::Vector3d above(11.0, 0.2, -1.88);
  CHECK(weighed(ground(), above, Answer::free) == Answer::free);
  CHECK(weighed(ground(), above, Answer::free, {.roughness_m = 0.05, .position_m = 0.1}) == Answer::supported);
  CHECK(weighed(ground(), above, Answer::free, {.roughness_m = 0.05, .angle_rad = radians(0.5)}) == Answer::supported);
}

TEST_CASE("noise along the ray hardly moves a point off a surface at grazing incidence") {
  CHECK(weighed(ground(), {11.0, 0.2, -1.88}, Answer::free, {.roughness_m = 0.05, .range_noise_m = 0.06}) ==
        Answer::free);
}

TEST_CASE(
    "where the surface is not flat or does not surround the point, only a near return speaks against the answer") {
  PointCloud step = ground();
  const Eigen::Vector3d point(11.0, 0.2, -1.75);
  add(step, 0.9 * point);
  for (const Answer asked : {Answer::free, Answer::ambiguous, Answer::occluded}) {
    CHECK(weighed(step, point, asked) == asked);
    CHECK(weighed(ground(), at(10.4, -10, 8.0), asked) == asked);
    CHECK(weighed(PointCloud{}, point, asked) == asked);
  }
  CHECK(weighed(step, point, Answer::supported) == Answer::ambiguous);
  add(step, point + Eigen::Vector3d(0.0, 0.04, 0.0));
  CHECK(weighed(step, point, Answer::free) == Answer::supported);
}

}  // namespace
}  // namespace raywatch
