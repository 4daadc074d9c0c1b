// The five answers, held against their definition evaluated by brute force.

#include <doctest/doctest.h>
#include <rapidcheck.h>

#include <cmath>
#include <numbers>
#include <random>

#include "core/error.hpp"
#include "core/prior_index.hpp"
#include "tests/support/brute_force.hpp"

namespace raywatch {
namespace {

using testing::are_free;
using testing::brute_force_answer;
using testing::free_points;
using testing::usable_returns;

constexpr double kPi = std::numbers::pi;
constexpr double radians(double degrees) { return degrees * kPi / 180.0; }

Eigen::Vector3d at(double azimuth_deg, double elevation_deg, double range_m) {
  const double a = radians(azimuth_deg), e = radians(elevation_deg);
  return range_m * Eigen::Vector3d(std::cos(e) * std::cos(a), std::cos(e) * std::sin(a), std::sin(e));
}

void add(PointCloud& cloud, const Eigen::Vector3d& p) {
  cloud.push_back(static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z()));
}

PointCloud one(const Eigen::Vector3d& p) {
  PointCloud cloud;
  add(cloud, p);
  return cloud;
}

/// A patch of shots one degree apart around a direction, all of one range.
PointCloud patch(double azimuth_deg, double elevation_deg, double range_m, int half_width = 3) {
  PointCloud cloud;
  for (int row = -half_width; row <= half_width; ++row) {
    for (int column = -half_width; column <= half_width; ++column) {
      add(cloud, at(azimuth_deg + column, elevation_deg + row, range_m));
    }
  }
  return cloud;
}

Answer answer_of(const PointCloud& prior, const Eigen::Vector3d& point_m, const Thresholds& thresholds) {
  const PriorIndex index = PriorIndex::build(prior, {});
  const std::vector<std::uint8_t> valid{1};
  std::vector<Answer> answers(1);
  ask(index, one(point_m), valid, Pose{}, thresholds, answers);
  return answers.front();
}

const Thresholds kTwoDegrees{.angle_rad = radians(2.0), .range_m = 0.1};

TEST_CASE("a point in front of a surface that surrounds it is free") {
  CHECK(answer_of(patch(30, 10, 8.0), at(30.3, 10.2, 5.0), kTwoDegrees) == Answer::free);
}

TEST_CASE("a point on the surface is supported, one behind it is occluded") {
  CHECK(answer_of(patch(30, 10, 8.0), at(30.3, 10.2, 8.05), kTwoDegrees) == Answer::supported);
  CHECK(answer_of(patch(30, 10, 8.0), at(30.3, 10.2, 9.0), kTwoDegrees) == Answer::occluded);
}

TEST_CASE("a direction without returns is unseen, also inside a prior that saw something elsewhere") {
  CHECK(answer_of(patch(30, 10, 8.0), at(60, 10, 5.0), kTwoDegrees) == Answer::unseen);
  CHECK(answer_of(patch(30, 10, 8.0), at(30, -70, 5.0), kTwoDegrees) == Answer::unseen);
  CHECK(answer_of(PointCloud{}, at(30, 10, 5.0), kTwoDegrees) == Answer::unseen);
}

TEST_CASE("a direction at the border of the coverage is not surrounded, so nothing is concluded") {
  CHECK(answer_of(patch(30, 10, 8.0), at(34.0, 10, 5.0), kTwoDegrees) == Answer::ambiguous);
  CHECK(answer_of(patch(30, 10, 8.0), at(30, 14.0, 5.0), kTwoDegrees) == Answer::ambiguous);
}

TEST_CASE("nearer and farther returns together are ambiguous") {
  PointCloud edge = patch(30, 10, 8.0);
  add(edge, at(30.5, 10.5, 2.0));
  CHECK(answer_of(edge, at(30.3, 10.2, 5.0), kTwoDegrees) == Answer::ambiguous);
}

TEST_CASE("the azimuth seam is like any other direction") {
  for (const double azimuth : {179.9, -179.9, 180.0}) {
    CHECK(answer_of(patch(180, 0, 8.0), at(azimuth, 0.2, 5.0), kTwoDegrees) == Answer::free);
    CHECK(answer_of(patch(180, 0, 8.0), at(azimuth, 0.2, 8.0), kTwoDegrees) == Answer::supported);
  }
}

TEST_CASE("zenith and nadir are like any other direction") {
  for (const double pole : {90.0, -90.0}) {
    PointCloud cap;
    for (int ring = 1; ring <= 4; ++ring) {
      for (int azimuth = 0; azimuth < 360; azimuth += 15) add(cap, at(azimuth, pole > 0 ? 90 - ring : ring - 90, 8.0));
    }
    CHECK(answer_of(cap, {0.0, 0.0, pole > 0 ? 5.0 : -5.0}, kTwoDegrees) == Answer::free);
    CHECK(answer_of(cap, at(77, pole > 0 ? 89.7 : -89.7, 5.0), kTwoDegrees) == Answer::free);
    CHECK(answer_of(cap, at(77, pole > 0 ? 89.7 : -89.7, 8.0), kTwoDegrees) == Answer::supported);
    CHECK(answer_of(cap, at(77, pole > 0 ? 89.7 : -89.7, 9.0), kTwoDegrees) == Answer::occluded);
  }
}

TEST_CASE("rings that are coarser than the threshold leave no neighbours, and nothing is concluded") {
  PointCloud rings;
  for (int azimuth = 0; azimuth < 360; ++azimuth) {
    add(rings, at(azimuth, 0, 8.0));
    add(rings, at(azimuth, 5, 8.0));
  }
  CHECK(answer_of(rings, at(40.5, 2.5, 4.0), kTwoDegrees) == Answer::unseen);
}

TEST_CASE("returns that are no measurement of a surface never take part") {
  PointCloud prior = patch(30, 10, 8.0);
  add(prior, {0, 0, 0});
  prior.push_back(std::nanf(""), 1.0f, 1.0f);
  prior.push_back(std::numeric_limits<float>::infinity(), 0.0f, 0.0f);
  add(prior, at(30.1, 10.1, 0.3));     // the rig
  add(prior, at(30.2, 10.1, 32.767));  // "no return"
  add(prior, at(30.3, 10.1, 32.759));  // the same, of another receiver
  const PriorIndex index = PriorIndex::build(prior, {.min_m = 0.7, .max_m = 100.0, .no_return_m = 32.767});
  CHECK(index.size() == 49);
  std::vector<Answer> answers(1);
  ask(index, one(at(30.3, 10.2, 5.0)), std::vector<std::uint8_t>{1}, Pose{}, kTwoDegrees, answers);
  CHECK(answers.front() == Answer::free);
}

TEST_CASE("thresholds out of their range are refused") {
  const PriorIndex index = PriorIndex::build(patch(0, 0, 5), {});
  std::vector<Answer> answers(1);
  const std::vector<std::uint8_t> valid{1};
  const auto asked_with = [&](const Thresholds& thresholds) {
    ask(index, one({1, 0, 0}), valid, Pose{}, thresholds, answers);
  };
  CHECK_THROWS_AS(asked_with({.angle_rad = 0.0, .range_m = 0.1}), InvalidInput);
  CHECK_THROWS_AS(asked_with({.angle_rad = 2.0, .range_m = 0.1}), InvalidInput);
  CHECK_THROWS_AS(asked_with({.angle_rad = 0.1, .range_m = -0.1}), InvalidInput);
  CHECK_THROWS_AS(asked_with({.angle_rad = std::nan(""), .range_m = 0.1}), InvalidInput);
}

/// How a random prior is made: its returns crowd around some directions and ranges so that every answer occurs.
struct RandomScene {
  PointCloud prior;
  PointCloud points;
  Thresholds thresholds;
};

RandomScene random_scene(std::uint32_t seed, std::size_t returns, std::size_t questions) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  const double angle_deg = 0.03 * std::pow(100.0, unit(random));  // 0.03 to 3 degrees
  const double spread_deg = angle_deg * std::sqrt(static_cast<double>(returns)) * (0.1 + 0.5 * unit(random));
  const double pole_or_seam = unit(random);
  const double center_elevation = pole_or_seam < 0.2 ? 89.9 : pole_or_seam < 0.4 ? -89.9 : 120.0 * unit(random) - 60.0;
  const double center_azimuth = pole_or_seam > 0.7 ? 180.0 : 360.0 * unit(random) - 180.0;
  const double range_m = 0.5 * std::pow(1000.0, unit(random));  // 0.5 to 500 m
  const double step_m = 0.02 * range_m;
  // Directions around the center by a rotation that turns the x axis there: no crowding at the poles.
  const Eigen::Quaterniond turn = Eigen::AngleAxisd(radians(center_azimuth), Eigen::Vector3d::UnitZ()) *
                                  Eigen::AngleAxisd(-radians(center_elevation), Eigen::Vector3d::UnitY());
  const auto draw = [&](double range, double widen = 1.0) {
    const double width_deg = widen * spread_deg;
    return Eigen::Vector3d(turn * at(width_deg * (unit(random) - 0.5), width_deg * (unit(random) - 0.5), range));
  };
  RandomScene scene{.thresholds = {.angle_rad = radians(angle_deg), .range_m = step_m}};
  const double steep = unit(random);
  for (std::size_t i = 0; i < returns; ++i) {
    const double layer = unit(random) < 0.7 ? 1.0 : 1.3;
    add(scene.prior, draw(range_m * layer + step_m * steep * unit(random)));
  }
  for (std::size_t i = 0; i < questions; ++i) {
    const double layers[] = {0.8, 1.0, 1.15, 1.3, 1.5};
    add(scene.points, draw(range_m * layers[random() % 5] + step_m * (unit(random) - 0.5), 1.5));
  }
  return scene;
}

TEST_CASE(
    "every answer is the one of the definition, from 0.03 to 3 degrees, from 0.5 to 500 m, poles and seam included") {
  std::size_t total = 0, free = 0, differing = 0, differing_beyond_rounding = 0;
  std::array<std::size_t, 5> seen{};
  CHECK(rc::check([&] {
    const auto seed = *rc::gen::arbitrary<std::uint32_t>();
    const RandomScene scene = random_scene(seed, 400, 200);
    const PriorIndex index = PriorIndex::build(scene.prior, {});
    const std::vector<std::uint8_t> valid(scene.points.size(), 1);
    std::vector<Answer> answers(scene.points.size());
    ask(index, scene.points, valid, Pose{}, scene.thresholds, answers);
    RC_ASSERT(free_points(index, scene.points, valid, Pose{}, scene.thresholds) == are_free(answers));
    const auto returns = usable_returns(scene.prior, {});
    for (std::size_t i = 0; i < answers.size(); ++i) {
      const auto expected = brute_force_answer(returns, scene.points[i].cast<double>(), scene.thresholds);
      ++total;
      ++seen[static_cast<std::size_t>(expected.answer)];
      free += expected.answer == Answer::free;
      differing += answers[i] != expected.answer;
      differing_beyond_rounding += answers[i] != expected.answer && expected.margin > 1e-12;
    }
    RC_ASSERT(differing_beyond_rounding == 0u);
  }));
  MESSAGE(total << " questions, " << free << " free, " << differing << " answered otherwise");
  CHECK(differing <= total / 10000);
  for (const std::size_t count : seen) CHECK(count > total / 200);  // the scenes ask for every answer
}

TEST_CASE("what is only asked whether it is free gets the same answer, valid or not") {
  const RandomScene scene = random_scene(5, 3000, 1001);
  const PriorIndex index = PriorIndex::build(scene.prior, {});
  std::vector<std::uint8_t> valid(scene.points.size(), 1);
  for (std::size_t i = 0; i < 700; ++i) valid[i] = i % 3 == 0 || (i > 100 && i < 200);
  std::vector<Answer> answers(scene.points.size());
  ask(index, scene.points, valid, Pose{}, scene.thresholds, answers);
  CHECK(std::count(answers.begin(), answers.end(), Answer::free) > 20);
  CHECK(free_points(index, scene.points, valid, Pose{}, scene.thresholds) == are_free(answers));
  const std::vector<std::uint8_t> none(valid.size(), 0);
  CHECK(free_points(PriorIndex::build({}, {}), scene.points, valid, Pose{}, scene.thresholds) == none);
}

TEST_CASE("near returns are found in every direction, also across the seam and behind the point") {
  const PriorIndex index = PriorIndex::build(patch(180, 0, 8.0), {});
  const auto is_near = [&](const Eigen::Vector3d& point_m, double distance_m) {
    std::vector<std::uint8_t> near(1);
    find_near_returns(index, one(point_m), Pose{}, distance_m, near);
    return near.front() != 0;
  };
  CHECK(is_near(at(179.95, 0.0, 8.05), 0.06));
  CHECK(is_near(at(-179.95, 0.0, 7.95), 0.06));
  CHECK_FALSE(is_near(at(180.0, 0.0, 8.2), 0.06));
  CHECK_FALSE(is_near(at(180.5, 0.5, 8.0), 0.06));  // in the middle of four shots
  CHECK_FALSE(is_near({0.01, 0.0, 0.0}, 0.06));
}

TEST_CASE("a pose of map coordinates changes no answer") {
  const RandomScene scene = random_scene(11, 2000, 500);
  const PriorIndex index = PriorIndex::build(scene.prior, {});
  const std::vector<std::uint8_t> valid(scene.points.size(), 1);
  std::vector<Answer> here(scene.points.size()), there(scene.points.size());
  ask(index, scene.points, valid, Pose{}, scene.thresholds, here);
  const Pose world_from_prior{Eigen::Quaterniond(Eigen::AngleAxisd(1.1, Eigen::Vector3d(1, 2, 3).normalized())),
                              {456789.125, 5912345.25, 118.5}};
  ask(index, scene.points, valid, world_from_prior.inverse() * world_from_prior, scene.thresholds, there);
  std::size_t differing = 0;
  for (std::size_t i = 0; i < here.size(); ++i) differing += here[i] != there[i];
  CHECK(differing <= 1);
}

}  // namespace
}  // namespace raywatch
