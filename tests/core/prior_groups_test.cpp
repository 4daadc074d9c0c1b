// A baseline of several scans, each with its own part of the world.

#include "core/prior_groups.hpp"

#include <doctest/doctest.h>

#include <algorithm>

#include "core/sample_changes.hpp"
#include "tests/core/watch_scene.hpp"

namespace raywatch {
namespace {

using namespace std::chrono_literals;

constexpr Time kStart{std::chrono::sys_days{std::chrono::year{2026} / 3 / 1}};
const Eigen::AlignedBox3d kBoxRegion{Eigen::Vector3d(4.0, -1.0, -1.0), Eigen::Vector3d(6.0, 1.0, 1.0)};

std::vector<Change> changes(const WatchedScan& scan, const std::vector<PriorGroup>& groups) {
  const CompareParameters parameters = watch_parameters();
  const std::vector<ScanView> priors = all_priors(groups);
  return form_changes(scan.view(), priors, parameters, detect_in_regions(scan.view(), groups, parameters)).changes;
}

TEST_CASE("one group that speaks everywhere answers as its priors alone do") {
  const WatchedScan before = look_at_wall(false, kStart), now = look_at_wall(true, kStart + 1h);
  const std::vector<ScanView> priors{before.view()};
  const Detection alone = detect(now.view(), priors, watch_parameters());
  const Detection grouped = detect_in_regions(now.view(), std::vector<PriorGroup>{{priors, {}}}, watch_parameters());
  CHECK(grouped.classes == alone.classes);
  CHECK(grouped.prior_points.size() == alone.prior_points.size());
  CHECK(grouped.testable == alone.testable);
  const Detection nobody = detect_in_regions(now.view(), {}, watch_parameters());
  CHECK(nobody.testable == 0.0);
}

TEST_CASE("what was accepted is no change any more, and its theft is one") {
  const WatchedScan empty = look_at_wall(false, kStart), with_box = look_at_wall(true, kStart + 1h);
  const std::vector<PriorGroup> baseline{{{empty.view()}, {}}, {{with_box.view()}, kBoxRegion}};
  REQUIRE(changes(look_at_wall(true, kStart + 2h), {baseline.front()}).size() == 1);
  CHECK(changes(look_at_wall(true, kStart + 2h), baseline).empty());
  const auto stolen = changes(look_at_wall(false, kStart + 2h), baseline);
  REQUIRE(stolen.size() == 1);
  CHECK(stolen.front().kind == ChangeKind::removed);
  CHECK((stolen.front().centroid_m - Eigen::Vector3d(4.5, 0, 0)).norm() < 0.2);
}

TEST_CASE("an accepted removal is no change any more, and its return is one") {
  const WatchedScan with_box = look_at_wall(true, kStart), empty = look_at_wall(false, kStart + 1h);
  const std::vector<PriorGroup> baseline{{{with_box.view()}, {}}, {{empty.view()}, kBoxRegion}};
  REQUIRE(changes(look_at_wall(false, kStart + 2h), {baseline.front()}).size() == 1);
  CHECK(changes(look_at_wall(false, kStart + 2h), baseline).empty());
  const auto returned = changes(look_at_wall(true, kStart + 2h), baseline);
  REQUIRE(returned.size() == 1);
  CHECK(returned.front().kind == ChangeKind::added);
}

TEST_CASE("what stood in the last of the scans that show together what is normal is not missed later") {
  const WatchedScan first = look_at_wall(false, kStart), last = look_at_wall(true, kStart + 1h);
  const WatchedScan now = look_at_wall(false, kStart + 2h);
  const std::vector<ScanView> priors{first.view(), last.view()};
  REQUIRE(changes(now, {{priors, {}}}).size() == 1);
  CHECK(changes(now, {{priors, {}, {true, true}}}).empty());
  // As an operator who takes a later scan into the baseline says by it that what it shows is normal.
  CHECK(changes(now, {{priors, {}, {true, false}}}).size() == 1);
  const WatchedScan also = look_at_wall(true, kStart);
  CHECK(changes(now, {{{also.view(), last.view()}, {}, {true, true}}}).size() == 1);
}

TEST_CASE("outside of its region an accepted scan says nothing") {
  // What stood elsewhere when the box was accepted is neither normal nor missing later.
  const WatchedScan empty = look_at_wall(false, kStart), elsewhere = look_at_wall(true, kStart + 1h, 3.0);
  const std::vector<PriorGroup> baseline{{{empty.view()}, {}}, {{elsewhere.view()}, kBoxRegion}};
  CHECK(changes(look_at_wall(false, kStart + 2h), baseline).empty());
  const auto again = changes(look_at_wall(true, kStart + 2h, 3.0), baseline);
  REQUIRE(again.size() == 1);
  CHECK(again.front().kind == ChangeKind::added);
}

TEST_CASE("the sample of a change is some of its points, evenly chosen") {
  const WatchedScan before = look_at_wall(true, kStart), now = look_at_wall(false, kStart + 1h);
  for (const auto& [scan, prior] : {std::pair(&now, &before), std::pair(&before, &now)}) {
    const std::vector<ScanView> priors{prior->view()};
    const Comparison comparison = compare(scan->view(), priors, watch_parameters());
    REQUIRE(comparison.changes.size() == 1);
    for (const std::size_t most : {7u, 64u, 100'000u}) {
      const auto samples = sample_changes(scan->view(), priors, comparison, most);
      REQUIRE(samples.size() == 1);
      CHECK(samples.front().size() == std::min(most, comparison.changes.front().points));
      const Eigen::AlignedBox3d& bounds_m = comparison.changes.front().bounds_m;
      for (const Eigen::Vector3f& p : samples.front()) CHECK(bounds_m.exteriorDistance(p.cast<double>()) < 1e-5);
    }
  }
}

TEST_CASE("where regions overlap the later one speaks") {
  const WatchedScan empty = look_at_wall(false, kStart), with_box = look_at_wall(true, kStart + 1h);
  const WatchedScan empty_again = look_at_wall(false, kStart + 2h);
  const std::vector<PriorGroup> baseline{
      {{empty.view()}, {}}, {{with_box.view()}, kBoxRegion}, {{empty_again.view()}, kBoxRegion}};
  CHECK(changes(look_at_wall(false, kStart + 3h), baseline).empty());
  CHECK(changes(look_at_wall(true, kStart + 3h), baseline).size() == 1);
}

}  // namespace
}  // namespace raywatch
