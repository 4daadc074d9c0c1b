// Which clusters of free points are believed, and how changes grow from them.

#include "core/grow.hpp"

#include <doctest/doctest.h>

#include <limits>
#include <random>

#include "core/cluster_votes.hpp"
#include "core/prior_index_impl.hpp"
#include "tests/core/shots.hpp"

namespace raywatch {
namespace {

constexpr double kWall_m = 10.0, kThing_m = 6.0;

Taken wall() {
  return Taken(shoot([](int, int) { return kWall_m; }));
}

/// A thing before the wall, seen by the shots of the columns and rows up to these.
Taken thing(int columns, int rows) {
  return Taken(shoot([=](int c, int r) { return std::abs(c) <= columns && std::abs(r) <= rows ? kThing_m : kWall_m; }));
}

std::vector<std::uint32_t> shots_of_thing(int columns, int rows) {
  std::vector<std::uint32_t> shots;
  for (int r = -rows; r <= rows; ++r) {
    for (int c = -columns; c <= columns; ++c) shots.push_back(shot(c, r));
  }
  return shots;
}

CompareParameters parameters() {
  CompareParameters result;
  result.support_distance_m = 0.06;
  result.growth_distance_m = 0.4;
  result.foliage_distance_m = 0.8;
  return result;
}

ClusterVotes votes(const Taken& scan, const std::vector<std::uint32_t>& members, const Taken& prior) {
  constexpr double kAnything = -std::numeric_limits<double>::infinity();
  return *votes_of(scan.view(), members, prior.view(), parameters(), kAnything);
}

std::vector<Candidate> added(const std::vector<std::uint32_t>& shots) {
  std::vector<Candidate> candidates;
  for (const std::uint32_t i : shots) candidates.push_back({i, PointClass::added});
  return candidates;
}

std::vector<ClassedPoint> seeds_of(const Taken& scan, std::span<const ScanView> asked,
                                   const std::vector<Candidate>& candidates) {
  const std::vector<JudgedCluster> clusters = judge_clusters(scan.view(), candidates, asked, false, parameters());
  return find_seeds({&clusters, 1}, parameters()).front();
}

std::vector<ClassedPoint> seeds_of(const Taken& scan, const Taken& prior, const std::vector<Candidate>& candidates) {
  const std::vector<ScanView> asked{prior.view()};
  return seeds_of(scan, asked, candidates);
}

std::vector<ClassedPoint> grown(const Taken& scan, const Taken& prior, const std::vector<Candidate>& candidates,
                                bool open) {
  return grow(scan.view(), sources_of(scan.index.impl(), scan.points), seeds_of(scan, prior, candidates), candidates,
              parameters(),
              [&](std::span<const std::uint32_t> places) { return std::vector<std::uint8_t>(places.size(), open); });
}

TEST_CASE("rays of a prior go through a thing that came, and none through what is one row thin") {
  CHECK(votes(thing(3, 3), shots_of_thing(3, 3), wall()).rays_through >= 40);
  // A board between two rows of the prior's shots.
  PointCloud board;
  std::vector<std::uint32_t> members;
  for (int c = -5; c <= 5; ++c) {
    const double a = kStep_rad * (c + 0.3), e = 0.5 * kStep_rad;
    members.push_back(static_cast<std::uint32_t>(board.size()));
    board.push_back(static_cast<float>(kThing_m * std::cos(e) * std::cos(a)),
                    static_cast<float>(kThing_m * std::cos(e) * std::sin(a)),
                    static_cast<float>(kThing_m * std::sin(e)));
  }
  CHECK(votes(Taken(board), members, wall()).rays_through == 0);
}

TEST_CASE("a prior that has the thing lets no ray through") {
  CHECK(votes(thing(3, 3), shots_of_thing(3, 3), thing(3, 3)).rays_through == 0);
}

TEST_CASE("points of a thing that came are penetrated by rays of the prior, those of one that stayed stop them") {
  const ClusterVotes came = votes(thing(3, 3), shots_of_thing(3, 3), wall());
  CHECK(came.penetrated == 49);
  CHECK(came.blocked == 0);
  const ClusterVotes stayed = votes(thing(3, 3), shots_of_thing(3, 3), thing(3, 3));
  CHECK(stayed.penetrated == 0);
  CHECK(stayed.blocked == 49);
}

TEST_CASE("the clearance of a cluster is its median distance from what the prior saw, at most a metre") {
  CHECK(votes(thing(3, 3), shots_of_thing(3, 3), wall()).clearance_m == doctest::Approx(1.0));
  CHECK(votes(thing(3, 3), shots_of_thing(3, 3), thing(3, 3)).clearance_m == doctest::Approx(0.0));
  const Taken nearer(shoot([](int, int) { return kThing_m + 0.4; }));
  CHECK(votes(thing(3, 3), shots_of_thing(3, 3), nearer).clearance_m == doctest::Approx(0.4).epsilon(0.02));
}

TEST_CASE("a solid thing is not porous, a fence and scattered returns are") {
  CHECK(porosity_of(thing(3, 3).view(), shots_of_thing(3, 3), parameters()) == 0.0);
  const auto is_wire = [](int c, int r) { return std::abs(c) <= 6 && std::abs(r) <= 6 && (c % 2 == 0 && r % 2 == 0); };
  const Taken fence(shoot([&](int c, int r) { return is_wire(c, r) ? kThing_m : kWall_m; }));
  std::vector<std::uint32_t> wires;
  for (int r = -6; r <= 6; r += 2) {
    for (int c = -6; c <= 6; c += 2) wires.push_back(shot(c, r));
  }
  CHECK(porosity_of(fence.view(), wires, parameters()) > 0.4);
}

TEST_CASE("what came is believed, and neither a fence that was there nor an edge measured twice is") {
  CHECK(seeds_of(thing(3, 3), wall(), added(shots_of_thing(3, 3))).size() == 49);
  const Taken stayed = thing(3, 3);
  CHECK(seeds_of(stayed, stayed, added(shots_of_thing(3, 3))).empty());
  // The last column of the thing, which in the prior ended one column earlier.
  std::vector<std::uint32_t> edge;
  for (int r = -3; r <= 3; ++r) edge.push_back(shot(3, r));
  CHECK(seeds_of(thing(3, 3), thing(2, 3), added(edge)).empty());
}

TEST_CASE("a scan shows a thing where its rays end at it, not where it is free or hidden") {
  const Taken scan = thing(3, 3);
  const std::vector<std::uint32_t> members = shots_of_thing(3, 3);
  const Taken hiding(shoot([](int, int) { return kThing_m - 2.0; }));
  CHECK(shows(scan.view(), scan.view(), members, parameters()));
  CHECK_FALSE(shows(wall().view(), scan.view(), members, parameters()));
  CHECK_FALSE(shows(hiding.view(), scan.view(), members, parameters()));
}

TEST_CASE("what one station of a visit does not see is no change when another station shows it") {
  const Taken scan = thing(3, 3), free = wall(), shown = thing(3, 3);
  const auto seeds = [&](Duration shown_before_free) {
    std::vector<ScanView> asked{free.view(), shown.view()};
    asked[0].captured_at = Time(std::chrono::hours(100));
    asked[1].captured_at = asked[0].captured_at - shown_before_free;
    return seeds_of(scan, asked, added(shots_of_thing(3, 3))).size();
  };
  CHECK(seeds(std::chrono::minutes(5)) == 0);
  CHECK(seeds(-std::chrono::minutes(5)) == 0);
  // Yesterday it stood there, this morning it was gone: it came back.
  CHECK(seeds(std::chrono::hours(24)) == 49);
}

TEST_CASE("in rooms a thing close before others is believed when many rays went through, and no rough edge is") {
  CompareParameters rooms = parameters();
  rooms.foliage_distance_m = 0.0;
  const ClusterVotes near{.rays_through = 60, .penetrated = 95, .looked_at = 100, .clearance_m = 0.1};
  const ClusterVotes few_rays{.rays_through = 12, .penetrated = 9, .looked_at = 100, .clearance_m = 0.14};
  constexpr double kLeast = 1.5;
  CHECK(log_odds_of_change(near, {.porosity = 0.0, .smoothness = 0.95}, rooms) > kLeast);
  CHECK(log_odds_of_change(few_rays, {.porosity = 0.0, .smoothness = 0.95}, rooms) < kLeast);
  CHECK(log_odds_of_change(near, {.porosity = 0.0, .smoothness = 0.3}, rooms) < kLeast);
  CHECK(log_odds_of_change(near, {.porosity = 0.3, .smoothness = 0.95}, rooms) < kLeast);
  CHECK(log_odds_of_change({.looked_at = 20, .clearance_m = 1.0}, {}, rooms) < kLeast);  // no ray says anything
}

TEST_CASE("the surroundings of a place are smooth at a wall and rough in leaves") {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> near_thing(kThing_m - 0.7, kThing_m + 0.7);
  const Taken leaves(shoot([&](int, int) { return near_thing(random); }));
  CHECK(votes(thing(3, 3), shots_of_thing(3, 3), wall()).surroundings.smoothness == 1.0);
  CHECK(votes(thing(3, 3), shots_of_thing(3, 3), leaves).surroundings.smoothness < 0.85);
}

TEST_CASE("a sure cluster grows over open points up to the growth distance, and not over closed ones") {
  const Taken scan = thing(8, 3);
  const std::vector<Candidate> candidates = added(shots_of_thing(3, 3));
  CHECK(grown(scan, wall(), candidates, false).size() == candidates.size());
  const std::vector<ClassedPoint> points = grown(scan, wall(), candidates, true);
  CHECK(points.size() > candidates.size());
  for (const ClassedPoint& point : points) {
    CHECK(point.point_class == PointClass::added);
    const Eigen::Vector3f p = scan.points[point.index];
    CHECK(p.norm() == doctest::Approx(kThing_m));  // the wall behind it is out of reach
    const double beyond_rad = std::max(0.0, std::atan2(std::abs(p.y()), p.x()) - 3 * kStep_rad);
    CHECK(beyond_rad * kThing_m <= parameters().growth_distance_m + 0.01);
  }
}

TEST_CASE("what most contradict is no seed, and neither is a cluster of few points") {
  std::vector<Candidate> candidates = added(shots_of_thing(3, 3));
  for (std::size_t k = 0; k < 30; ++k) candidates[k].contradicted = true;
  CHECK(grown(thing(8, 3), wall(), candidates, true).empty());
  CHECK(grown(thing(8, 3), wall(), added({shot(0, 0), shot(1, 0), shot(0, 1), shot(1, 1)}), true).empty());
}

}  // namespace
}  // namespace raywatch
