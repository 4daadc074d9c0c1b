// How a scan meets the clusters of another: broadside, edge-on, between its shots.

#include "core/cluster_aspect.hpp"

#include <doctest/doctest.h>
#include <rapidcheck.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "core/profile.hpp"
#include "tests/core/shots.hpp"

namespace raywatch {
namespace {

/// A scan towards x of a wall 5 m away, and a block of its shots.
struct Wall {
  Taken scan{
      shoot([](int column, int row) { return 5.0 / (std::cos(kStep_rad * column) * std::cos(kStep_rad * row)); })};

  std::vector<std::uint32_t> block(int columns, int rows) const {
    std::vector<std::uint32_t> members;
    for (int c = 0; c < columns; ++c) {
      for (int r = 0; r < rows; ++r) members.push_back(shot(c - columns / 2, r - rows / 2));
    }
    return members;
  }
  /// A sensor that looks at the middle of the wall from 5 m away, at this angle with it.
  ScanView from(double angle_rad) const {
    const Eigen::Vector3d towards(-std::sin(angle_rad), std::cos(angle_rad), 0.0);
    return scan.view(Pose{.position_m = Eigen::Vector3d(5.0, 0.0, 0.0) + 5.0 * towards});
  }
};

constexpr double kNever = std::numeric_limits<double>::infinity();

constexpr double radians(double degrees) { return degrees * std::numbers::pi / 180.0; }

TEST_CASE("the surface around a small cluster tells at which angle another scan meets it") {
  const Wall wall;
  const std::vector<std::uint32_t> members = wall.block(3, 2);
  for (const double degrees : {2.0, 10.0, 45.0, 90.0}) {
    const ClusterAspect aspect = aspect_of(wall.scan.view(), members, wall.from(radians(degrees)));
    CHECK(aspect.is_flat);
    CHECK(aspect.facing == doctest::Approx(std::sin(radians(degrees))).epsilon(0.02));
  }
}

TEST_CASE("a cluster reaches along and across the rays as far as its shots do") {
  const Wall wall;
  const std::vector<std::uint32_t> members = wall.block(13, 5);
  const double shot_m = 5.0 * kStep_rad;  // between shots on the wall
  const ClusterAspect oblique = aspect_of(wall.scan.view(), members, wall.from(radians(20.0)));
  CHECK(oblique.depth_m == doctest::Approx(12.0 * shot_m).epsilon(0.02));
  CHECK(oblique.foreshortened_m() == doctest::Approx(12.0 * shot_m * std::sin(radians(20.0))).epsilon(0.03));
  CHECK(oblique.spacing_m == doctest::Approx(shot_m).epsilon(0.02));
  const ClusterAspect upright = aspect_of(wall.scan.view(), members, wall.from(radians(90.0)));
  CHECK(upright.breadth_m == doctest::Approx(5.0 * shot_m).epsilon(0.05));
}

TEST_CASE("a corner is not flat") {
  const Taken scan(shoot([](int column, int) { return 5.0 + 0.1 * std::abs(column); }));
  std::vector<std::uint32_t> members;
  for (int column = -3; column <= 3; ++column) {
    for (int row = -2; row <= 2; ++row) members.push_back(shot(column, row));
  }
  CHECK_FALSE(aspect_of(scan.view(), members, scan.view()).is_flat);
}

TEST_CASE("a common rigid motion changes no aspect") {
  const Wall wall;
  const std::vector<std::uint32_t> members = wall.block(4, 3);
  CHECK(rc::check([&] {
    const auto draw = [](int low, int high) { return *rc::gen::inRange(low, high); };
    const Eigen::Vector3d axis(draw(-9, 10), draw(-9, 10), 10.0);
    const Pose moved_from_world{Eigen::Quaterniond(Eigen::AngleAxisd(0.1 * draw(-30, 31), axis.normalized())),
                                Eigen::Vector3d(draw(-500, 501), draw(-500, 501), draw(-50, 51))};
    ScanView view = wall.scan.view(), asked = wall.from(radians(draw(1, 90)));
    const ClusterAspect before = aspect_of(view, members, asked);
    view.world_from_sensor = moved_from_world * view.world_from_sensor;
    asked.world_from_sensor = moved_from_world * asked.world_from_sensor;
    const ClusterAspect after = aspect_of(view, members, asked);
    RC_ASSERT(after.is_flat == before.is_flat);
    RC_ASSERT(std::abs(after.facing - before.facing) < 1e-9);
    RC_ASSERT(std::abs(after.depth_m - before.depth_m) < 1e-6);
    RC_ASSERT(std::abs(after.breadth_m - before.breadth_m) < 1e-6);
  }));
}

TEST_CASE("in rooms what is met edge-on is doubted, and does not count at all where no ray went through") {
  const CompareParameters rooms = default_parameters(Profile::indoor, Grouping::consensus);
  const ClusterVotes through{.rays_through = 9}, beside{.rays_through = 0};
  const ClusterLook thing{.smoothness = 0.7, .extent = ShotExtent{.length = 9.0, .width = 5.0, .filled = 0.9}};
  const ClusterAspect panel{.is_flat = true, .facing = 0.04, .depth_m = 0.4, .breadth_m = 0.1, .spacing_m = 0.05};
  CHECK(doubt_of(panel, through, thing, rooms) > 0.0);
  CHECK(std::isfinite(doubt_of(panel, through, thing, rooms)));
  CHECK(doubt_of(panel, beside, thing, rooms) == kNever);
  ClusterAspect other = panel;
  other.is_flat = false;
  CHECK(doubt_of(other, beside, thing, rooms) == 0.0);
  other = panel;
  other.facing = 0.5;
  CHECK(doubt_of(other, beside, thing, rooms) == 0.0);
  other = panel;
  other.depth_m = 3.0;  // 12 cm of it are seen, more than lies between two shots
  CHECK(doubt_of(other, beside, thing, rooms) == 0.0);
}

TEST_CASE(
    "in rooms a piece of a flat side that is met edge-on is no change, however many rays seem to have gone through") {
  const CompareParameters rooms = default_parameters(Profile::indoor, Grouping::consensus);
  const ClusterVotes through{.rays_through = 9};
  const ShotExtent full{.length = 9.0, .width = 5.0, .filled = 0.9}, sparse{.length = 9.0, .width = 5.0, .filled = 0.2};
  const ClusterLook thing{.smoothness = 0.7, .extent = full}, full_of_gaps{.smoothness = 0.7, .extent = sparse},
      without_edge{.smoothness = 1.0, .extent = full};
  ClusterAspect side{.is_flat = true, .facing = 0.08, .depth_m = 3.0, .breadth_m = 0.1, .spacing_m = 0.05};
  CHECK(doubt_of(side, through, thing, rooms) == 0.0);
  CHECK(doubt_of(side, through, full_of_gaps, rooms) == kNever);
  CHECK(doubt_of(side, through, without_edge, rooms) == kNever);
  side.facing = 0.3;
  CHECK(doubt_of(side, through, full_of_gaps, rooms) == 0.0);
  CHECK(doubt_of(side, through, without_edge, rooms) == 0.0);
  CHECK(doubt_of(side, through, {.smoothness = 1.0, .extent = sparse}, rooms) == kNever);
  side.breadth_m = 0.03;  // narrower than the shots are apart
  CHECK(doubt_of(side, through, thing, rooms) == 0.0);
  CHECK(doubt_of(side, through, full_of_gaps, rooms) == kNever);
}

TEST_CASE("outdoors what stands upright between the shots is doubted, the sides of cars are not") {
  const CompareParameters outdoors = default_parameters(Profile::outdoor, Grouping::consensus);
  const ClusterVotes votes{.rays_through = 4, .penetrated = 9, .looked_at = 10};
  const ClusterVotes hardly_any{.rays_through = 4, .penetrated = 3, .looked_at = 10};
  const ClusterAspect post{.facing = 0.8, .depth_m = 0.1, .breadth_m = 0.1, .spacing_m = 0.3};
  CHECK(doubt_of(post, votes, {}, outdoors) > 0.0);
  ClusterAspect other = post;
  other.breadth_m = 0.4;
  CHECK(doubt_of(other, votes, {}, outdoors) == 0.0);
  other = post;
  other.facing = 0.1;
  CHECK(doubt_of(other, votes, {}, outdoors) == 0.0);
  CHECK(doubt_of(other, hardly_any, {}, outdoors) > 0.0);
}

TEST_CASE("outdoors what lies close among rough things that are seen densely must be surer, as leaves near a sensor") {
  const CompareParameters outdoors = default_parameters(Profile::outdoor, Grouping::consensus);
  const auto log_odds = [&](const Surroundings& surroundings, double clearance_m) {
    const ClusterVotes votes{.rays_through = 30,
                             .penetrated = 40,
                             .looked_at = 40,
                             .clearance_m = clearance_m,
                             .surroundings = surroundings};
    return log_odds_of_change(votes, {}, outdoors);
  };
  const Surroundings leaves{.smoothness = 0.9, .returns = 200}, grass_far_away{.smoothness = 0.9, .returns = 20};
  CHECK(log_odds(leaves, 0.3) < log_odds(grass_far_away, 0.3) - 2.0);
  CHECK(log_odds(leaves, 0.6) == log_odds(grass_far_away, 0.6));
  CHECK(log_odds({.smoothness = 0.97, .returns = 200}, 0.3) == log_odds({.smoothness = 0.97, .returns = 20}, 0.3));
}

TEST_CASE("in rooms what no ray went through is no change when hardly any of its points was penetrated") {
  const CompareParameters rooms = default_parameters(Profile::indoor, Grouping::consensus);
  const auto log_odds = [&](std::size_t rays, std::size_t penetrated) {
    const ClusterVotes votes{.rays_through = rays, .penetrated = penetrated, .looked_at = 40, .clearance_m = 1.0};
    return log_odds_of_change(votes, {}, rooms);
  };
  CHECK(log_odds(0, 3) == -kNever);
  CHECK(std::isfinite(log_odds(0, 4)));
  CHECK(std::isfinite(log_odds(1, 3)));
}

TEST_CASE("outdoors a piece of a fence must be surer than what is as porous but smooth") {
  const CompareParameters outdoors = default_parameters(Profile::outdoor, Grouping::consensus);
  const ClusterVotes votes{.rays_through = 30, .penetrated = 30, .looked_at = 40, .clearance_m = 0.6};
  const double smooth = log_odds_of_change(votes, {.porosity = 0.3, .smoothness = 0.65}, outdoors);
  CHECK(log_odds_of_change(votes, {.porosity = 0.3, .smoothness = 0.9}, outdoors) == smooth);
  CHECK(log_odds_of_change(votes, {.porosity = 0.3, .smoothness = 0.5}, outdoors) < smooth - 1.0);
}

}  // namespace
}  // namespace raywatch
