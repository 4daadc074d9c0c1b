// Which clusters are parts of one thing: those with nothing between them that anybody saw free.

#include "core/join_parts.hpp"

#include <doctest/doctest.h>

#include "core/profile.hpp"
#include "tests/core/shots.hpp"

namespace raywatch {
namespace {

constexpr double kWall_m = 10.0, kPanel_m = 6.0, kPost_m = 3.0;

enum class Between { open, post };

/// A wall; before it a panel with a gap in its middle, and, if asked for, a post that hides the gap.
Taken place(bool panel, Between between, int half_gap = 3, int half_panel = 14) {
  return Taken(shoot([=](int column, int row) {
    if (std::abs(column) <= half_gap) return between == Between::post ? kPost_m : kWall_m;
    return panel && std::abs(column) <= half_panel && std::abs(row) <= 5 ? kPanel_m : kWall_m;
  }));
}

CompareParameters parameters(Grouping grouping) {
  CompareParameters result = default_parameters(Profile::indoor, grouping);
  result.align = false;
  result.cluster_distance_m = 0.15;  // the shots are 0.105 m apart at the panel
  return result;
}

std::vector<Change> changes(const Taken& after, const Taken& before, Grouping grouping = Grouping::consensus) {
  const std::vector<ScanView> priors{before.view()};
  return compare(after.view({}, Time{} + std::chrono::hours(1)), priors, parameters(grouping)).changes;
}

TEST_CASE("what a post hides the middle of is one change") {
  const std::vector<Change> found = changes(place(true, Between::post), place(false, Between::post));
  REQUIRE(found.size() == 1);
  CHECK(found[0].points == 2 * 11 * 11);
  CHECK(found[0].box.size_m.x() > 2.5);
}

TEST_CASE("what was taken away from behind a post was one thing, too") {
  const std::vector<Change> found = changes(place(false, Between::post), place(true, Between::post));
  REQUIRE(found.size() == 1);
  CHECK(found[0].kind == ChangeKind::removed);
}

TEST_CASE("two things between which the wall is seen are two changes") {
  CHECK(changes(place(true, Between::open), place(false, Between::open)).size() == 2);
}

TEST_CASE("a gap that is wider than either part is long joins nothing") {
  CHECK(changes(place(true, Between::post, 7, 12), place(false, Between::post, 7, 12)).size() == 2);
}

TEST_CASE("a union keeps to the published clusters") {
  CHECK(changes(place(true, Between::post), place(false, Between::post), Grouping::union_).size() == 2);
}

TEST_CASE("what is joined does not depend on the order of clusters and points") {
  const Taken scan = place(true, Between::post);
  const ScanView view = scan.view();
  std::vector<Eigen::Vector3d> world_m;
  Members left, right;
  for (int row = -5; row <= 5; ++row) {
    for (int column = -14; column <= 14; ++column) {
      if (std::abs(column) <= 3) continue;
      (column < 0 ? left : right).push_back(static_cast<std::uint32_t>(world_m.size()));
      world_m.push_back(scan.points[shot(column, row)].cast<double>());
    }
  }
  const std::vector<std::uint32_t> view_of(world_m.size(), 0);
  const SeenPoints points{world_m, view_of, {&view}};
  const CompareParameters p = parameters(Grouping::consensus);
  const std::vector<Members> one = join_parts({left, right}, points, p);
  std::ranges::reverse(left);
  const std::vector<Members> other = join_parts({right, left}, points, p);
  REQUIRE(one.size() == 1);
  CHECK(one == other);
}

}  // namespace
}  // namespace raywatch
