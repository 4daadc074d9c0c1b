// Which clusters surely changed: what rays prove, and what they do not.

#include "core/seeds.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <functional>
#include <vector>

#include "core/cluster_rays.hpp"
#include "core/cluster_votes.hpp"
#include "core/profile.hpp"
#include "core/smoothness.hpp"
#include "tests/core/shots.hpp"

namespace raywatch {
namespace {

constexpr double kPane_m = 4.0, kFarWall_m = 9.0;

/// A scan towards x of a plane at 4 m, where it stands or returns, and of a wall behind it; from beside its middle.
Taken scan_from(double beside_m, const std::function<bool(double y_m, double azimuth_rad)>& returns) {
  PointCloud cloud;
  for (int row = -12; row <= 12; ++row) {
    for (int column = -60; column <= 60; ++column) {
      const double azimuth = kStep_rad * column, slope = std::cos(azimuth) * std::cos(kStep_rad * row);
      const double y_m = beside_m + kPane_m * std::tan(azimuth);
      push_shot(cloud, column, row, (returns(y_m, azimuth) ? kPane_m : kFarWall_m) / slope);
    }
  }
  return Taken(std::move(cloud));
}

std::vector<Change> changes_between(const Taken& after, double after_m, const Taken& before, double before_m) {
  CompareParameters parameters = default_parameters(Profile::indoor, Grouping::consensus);
  parameters.align = false;
  const auto pose = [](double y_m) { return Pose{.position_m = {0.0, y_m, 0.0}}; };
  const std::vector<ScanView> priors{before.view(pose(before_m))};
  return compare(after.view(pose(after_m), Time{} + std::chrono::hours(1)), priors, parameters).changes;
}

TEST_CASE("glass that each scan sees only where it meets it upright is no change") {
  const auto glass = [](double y_m, double azimuth_rad) {
    return std::abs(y_m) < 4.0 && std::abs(azimuth_rad) < 30.0 * kStep_rad;
  };
  CHECK(changes_between(scan_from(1.5, glass), 1.5, scan_from(-1.5, glass), -1.5).empty());
}

TEST_CASE("a door that is closed in a wall which goes on beside it is a change") {
  const auto wall = [](double y_m, double) { return std::abs(y_m) < 6.0; };
  const auto doorway = [&](double y_m, double azimuth_rad) {
    return wall(y_m, azimuth_rad) && !(y_m > 1.2 && y_m < 2.2);
  };
  const std::vector<Change> closed = changes_between(scan_from(1.5, wall), 1.5, scan_from(-1.5, doorway), -1.5);
  REQUIRE(closed.size() == 1);
  CHECK(closed[0].kind == ChangeKind::added);
  CHECK(changes_between(scan_from(1.5, doorway), 1.5, scan_from(-1.5, wall), -1.5).size() == 1);
}

TEST_CASE("a pane that stands free is a change, whoever sees it upright") {
  const auto panel = [](double y_m, double) { return y_m > 1.2 && y_m < 2.2; };
  const auto nothing = [](double, double) { return false; };
  CHECK(changes_between(scan_from(1.5, panel), 1.5, scan_from(-1.5, nothing), -1.5).size() == 1);
}

/// Flat ground, 2 m below the sensor.
Taken ground() {
  PointCloud cloud;
  for (int row = -40; row <= -5; ++row) {
    for (int column = -20; column <= 20; ++column) push_shot(cloud, column, row, 2.0 / std::sin(-kStep_rad * row));
  }
  return Taken(std::move(cloud));
}

TEST_CASE("a ray crosses a surface only if it ends on its other side") {
  const Taken near = ground();
  const Pose far_from_near{.position_m = {60.0, 0.0, -3.0}};  // the other sensor: 60 m off, 5 m up
  const Pose near_from_far = far_from_near.inverse();
  const Crossing crosses(near.view(), near.view(near_from_far), 0.1);
  const Eigen::Vector3d point_m = far_from_near * Eigen::Vector3d(6.0, 0.0, -2.0);
  const auto ends = [&](double along_m, double down_m) {
    return std::vector<Eigen::Vector3d>{far_from_near * Eigen::Vector3d(6.0 + along_m, 0.0, -2.0 - down_m)};
  };
  CHECK_FALSE(crosses.any_of(point_m, ends(0.5, 0.0)));
  CHECK_FALSE(crosses.any_of(point_m, ends(3.0, 0.02)));
  CHECK(crosses.any_of(point_m, ends(3.0, 2.0)));
  CHECK(crosses.any_of(point_m, ends(0.0, 1.0)));
}

TEST_CASE("where a scan shows no surface every ray that passes a point crosses it") {
  PointCloud alone;
  push_shot(alone, 0, 0, 5.0);
  const Taken scan(alone);
  const Crossing crosses(scan.view(), scan.view(), 0.1);
  CHECK(crosses.any_of({5.0, 0.0, 0.0}, std::vector<Eigen::Vector3d>{{5.3, 0.0, 0.0}}));
}

TEST_CASE("single returns of a fence are scattered, a small thing is not") {
  const auto is_fence = [](int column, int row) { return std::abs(row) <= 6 && (7 * column + 11 * row) % 5 == 0; };
  const auto is_thing = [](int column, int row) { return column >= 10 && column < 13 && row >= 10 && row < 13; };
  const Taken scan(shoot([&](int column, int row) {
    return is_fence(column, row) ? 20.0 : is_thing(column, row) ? 10.0 : 40.0;
  }));
  std::vector<std::uint32_t> fence, thing;
  for (int row = -20; row <= 20; ++row) {
    for (int column = -20; column <= 20; ++column) {
      if (is_fence(column, row) && std::abs(row) <= 2 && std::abs(column) <= 4) fence.push_back(shot(column, row));
      if (is_thing(column, row)) thing.push_back(shot(column, row));
    }
  }
  REQUIRE(fence.size() < 12);
  CHECK(is_scattered(fence.size(), smoothness_of(scan.view(), fence)));
  std::vector<std::uint32_t> line;  // a corner, one shot wide
  for (int row = -7; row <= 7; ++row) line.push_back(shot(-10, row));
  const Taken corner(shoot([](int column, int row) { return column == -10 && std::abs(row) <= 7 ? 20.0 : 40.0; }));
  CHECK(is_scattered(line.size(), smoothness_of(corner.view(), line)));
  CHECK_FALSE(is_scattered(thing.size(), smoothness_of(scan.view(), thing)));
}

/// A cluster of nine points in a box of 20 cm.
JudgedCluster judged(double log_odds, double x_m = 0.0) {
  JudgedCluster cluster{.point_class = PointClass::removed, .members = {0, 1, 2, 3, 4, 5, 6, 7, 8}};
  cluster.box_m = Eigen::AlignedBox3d(Eigen::Vector3d(x_m, 0.0, 0.0), Eigen::Vector3d(x_m + 0.2, 0.2, 0.2));
  cluster.log_odds = log_odds;
  cluster.rays_through = kEnoughRaysThrough;
  return cluster;
}

/// How many seeds the first of some scans has, of which each shows one cluster.
std::size_t seeds_of_first(const std::vector<JudgedCluster>& clusters, Profile profile = Profile::indoor) {
  std::vector<std::vector<JudgedCluster>> scans;
  for (const JudgedCluster& cluster : clusters) scans.push_back({cluster});
  return find_seeds(scans, default_parameters(profile, Grouping::consensus)).front().size();
}

}  // namespace
TEST_CASE("what one scan is nearly sure of is believed when a second one says the same of the same place") {
  const CompareParameters rooms = default_parameters(Profile::indoor, Grouping::consensus);
  const double sure = sure_log_odds(9, rooms), nearly = sure - 2.0, doubtful = least_log_odds_of_second_opinion(rooms);
  CHECK(seeds_of_first({judged(sure)}) == 9);
  CHECK(seeds_of_first({judged(nearly)}) == 0);
  CHECK(seeds_of_first({judged(nearly), judged(doubtful, 0.25)}) == 9);
  CHECK(seeds_of_first({judged(doubtful), judged(nearly, 0.25)}) == 0);
  JudgedCluster twice_asked = judged(nearly);
  twice_asked.next_log_odds = doubtful;
  CHECK(seeds_of_first({twice_asked}) == 9);
}

TEST_CASE("a second opinion counts for the same place and kind, through enough rays, and never among leaves") {
  const double nearly = sure_log_odds(9, default_parameters(Profile::indoor, Grouping::consensus)) - 2.0;
  CHECK(seeds_of_first({judged(nearly), judged(nearly)}) == 9);
  CHECK(seeds_of_first({judged(nearly), judged(nearly, 0.35)}) == 0);
  JudgedCluster of_other_kind = judged(nearly), hardly_crossed = judged(nearly);
  of_other_kind.point_class = PointClass::discrepancy;
  hardly_crossed.rays_through = kEnoughRaysThrough - 1;
  CHECK(seeds_of_first({judged(nearly), of_other_kind}) == 0);
  CHECK(seeds_of_first({hardly_crossed, judged(nearly)}) == 0);
  CHECK(seeds_of_first({judged(nearly), judged(nearly)}, Profile::outdoor) == 0);
}

}  // namespace raywatch
