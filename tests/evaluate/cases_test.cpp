#include "tests/evaluate/cases.hpp"

#include <doctest/doctest.h>

#include <algorithm>

#include "tests/evaluate/hand_made.hpp"

using namespace raywatch;
using namespace raywatch::evaluation;

namespace {

/// Two vantages at x = 0 and 5 m; each scans twice before and once after an object came.
Place two_vantages() {
  Place place{.name = "hand-made", .scans = {}, .states = {}};
  for (int minute = 0; minute < 6; ++minute) {
    HandMade scan{.labels = {0}, .present = {}, .minute = minute, .x_m = minute % 2 == 0 ? 0.0 : 5.0};
    if (minute >= 4) scan.present = {1};
    place.scans.push_back(hand_made_scan(scan));
  }
  return place;
}

std::vector<Case> of_kind(const std::vector<Case>& cases, Against against) {
  std::vector<Case> chosen;
  std::ranges::copy_if(cases, std::back_inserter(chosen), [&](const Case& c) { return c.against == against; });
  return chosen;
}

}  // namespace

TEST_CASE("single pairs are of different states, of one pose or of two") {
  const std::vector<Case> cases = make_cases(two_vantages(), Duration::zero(), 100);
  CHECK(of_kind(cases, Against::same_pose).size() == 4);
  CHECK(of_kind(cases, Against::other_pose).size() == 4);
}

TEST_CASE("several priors are the latest scan of each vantage in the state before") {
  const std::vector<Case> groups = of_kind(make_cases(two_vantages(), Duration::zero(), 0), Against::several);
  REQUIRE(groups.size() == 2);
  CHECK(groups[0].scan == 4);
  CHECK(groups[0].priors == std::vector<std::size_t>{2, 3});
  CHECK(groups[1].scan == 5);
  CHECK(groups[1].priors == std::vector<std::size_t>{2, 3});
}

TEST_CASE("quiet comparisons are with earlier scans of the same state") {
  const std::vector<Case> quiet = of_kind(make_cases(two_vantages(), Duration::zero(), 0), Against::quiet);
  REQUIRE(quiet.size() == 4);
  CHECK(quiet[2].scan == 3);
  CHECK(quiet[2].priors == std::vector<std::size_t>{1, 2});
  CHECK(quiet[3].scan == 5);
  CHECK(quiet[3].priors == std::vector<std::size_t>{4});
}

TEST_CASE("scans of one time are not compared, and pairs are thinned evenly") {
  const Place place = two_vantages();
  for (const Case& c : make_cases(place, std::chrono::minutes(1), 100)) {
    for (const std::size_t prior : c.priors) {
      CHECK(place.scans[c.scan].captured_at - place.scans[prior].captured_at > std::chrono::minutes(1));
    }
  }
  const std::vector<Case> thinned = make_cases(place, Duration::zero(), 4);
  const auto pairs = of_kind(thinned, Against::same_pose).size() + of_kind(thinned, Against::other_pose).size();
  CHECK(pairs == 4);
}
