// The priors' points that are gone, and what several priors show of one thing.

#include "core/prior_changes.hpp"

#include <doctest/doctest.h>

#include "tests/core/shots.hpp"

namespace raywatch {
namespace {

constexpr double kPlate_m = 6.0;

bool is_in_plate(int column, int row) { return std::abs(column) <= 3 && std::abs(row) <= 3; }

CompareParameters parameters() {
  CompareParameters result;
  result.support_distance_m = 0.06;
  result.growth_distance_m = 0.4;
  result.foliage_distance_m = 0.8;
  result.cluster_distance_m = 0.3;
  result.cluster_min_points = 5;
  return result;
}

std::vector<std::size_t> changed_points(const ScanView& scan, const std::vector<ScanView>& priors) {
  const CompareParameters with = parameters();
  std::vector<std::size_t> count(priors.size(), 0);
  for (const PriorPoint& point : find_prior_changes(scan, priors, Asking(with)).points) ++count[point.prior];
  return count;
}

/// A thin plate stood 6 m before two sensors that face each other. It is gone, and since then something stands before
/// the upper half of its place, as the scan sees it.
struct TwoSides {
  Taken front{shoot([](int c, int r) { return is_in_plate(c, r) ? kPlate_m : 10.0; })};
  Taken back{shoot([](int c, int r) { return is_in_plate(c, r) && r >= 1 ? kPlate_m : 22.0; })};
  Taken now{shoot([](int, int r) { return r >= 1 ? 3.0 : 10.0; })};
  Pose other_side{Eigen::Quaterniond(Eigen::AngleAxisd(std::numbers::pi, Eigen::Vector3d::UnitZ())),
                  Eigen::Vector3d(2.0 * kPlate_m, 0.0, 0.0)};
  ScanView scan() const { return now.view({}, Time(std::chrono::hours(1))); }
};

TEST_CASE("what only one prior shows, and the scan cannot see, is not called gone") {
  const TwoSides sides;
  CHECK(changed_points(sides.scan(), {sides.back.view(sides.other_side)}) == std::vector<std::size_t>{0});
}

TEST_CASE("what a prior shows beside changed points of another prior is gone with them") {
  const TwoSides sides;
  const std::vector<std::size_t> changed =
      changed_points(sides.scan(), {sides.front.view(), sides.back.view(sides.other_side)});
  CHECK(changed[0] >= 28);  // the lower four rows of seven, and what grows from them
  CHECK(changed[1] >= 14);  // of its three rows, the upper one may be farther from what is sure than changes grow
  CHECK(changed[1] <= 21);
}

TEST_CASE("what is nearer to a point of the other prior that did not change stays") {
  // A wall right behind the upper half of the plate, which the front shows beside it, and the back shows alone.
  const TwoSides sides;
  const Taken wall_behind(shoot([](int c, int r) { return std::abs(c) <= 12 && r >= 5 ? kPlate_m : 22.0; }));
  const Taken front(shoot([](int c, int r) { return is_in_plate(c, r) || r >= 5 ? kPlate_m : 10.0; }));
  CHECK(changed_points(sides.scan(), {front.view(), wall_behind.view(sides.other_side)})[1] == 0);
}

}  // namespace
}  // namespace raywatch
