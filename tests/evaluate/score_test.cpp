#include "tests/evaluate/score.hpp"

#include <doctest/doctest.h>

#include "tests/evaluate/hand_made.hpp"

using namespace raywatch;
using namespace raywatch::evaluation;

namespace {

constexpr StateId kNone = simulator::kNoSurface;

}  // namespace

TEST_CASE("precision, recall and f are shares of what was called changed and of what did change") {
  const PointCounts counts{.found = 6, .false_ = 2, .missed = 6, .unchanged = 100};
  CHECK(counts.precision() == doctest::Approx(0.75));
  CHECK(counts.recall() == doctest::Approx(0.5));
  CHECK(counts.f_score() == doctest::Approx(2 * 0.75 * 0.5 / (0.75 + 0.5)));
}

TEST_CASE("where nothing changed and nothing is found, everything is right; one false point makes f zero") {
  CHECK(PointCounts{}.precision() == 1.0);
  CHECK(PointCounts{}.recall() == 1.0);
  CHECK(PointCounts{}.f_score() == 1.0);
  CHECK(PointCounts{.false_ = 1}.f_score() == 0.0);
}

TEST_CASE("a point of the scan changed when its object was there in none of the priors") {
  const SimulatedScan scan = hand_made_scan({.labels = {0, 1, 2, 3, kNone}, .present = {1, 2, 3}});
  const SimulatedScan with_one = hand_made_scan({.labels = {0}, .present = {1}});
  const SimulatedScan with_two = hand_made_scan({.labels = {0}, .present = {2}});
  const std::vector<const SimulatedScan*> priors{&with_one, &with_two};
  CHECK(truth_of(scan, priors).scan ==
        std::vector<Truth>{Truth::unchanged, Truth::unchanged, Truth::unchanged, Truth::changed, Truth::ignored});
}

TEST_CASE("a point of a prior changed when its object is not there any more") {
  const SimulatedScan scan = hand_made_scan({.labels = {0}, .present = {2}});
  const SimulatedScan prior = hand_made_scan({.labels = {0, 1, 2, kNone}, .present = {1, 2}});
  const std::vector<const SimulatedScan*> priors{&prior};
  CHECK(truth_of(scan, priors).priors[0] ==
        std::vector<Truth>{Truth::unchanged, Truth::changed, Truth::unchanged, Truth::ignored});
}

TEST_CASE("both directions are counted, each prior's points for themselves, and what lies on no surface is not") {
  const CaseTruth truth{.scan = {Truth::changed, Truth::changed, Truth::unchanged, Truth::ignored},
                        .priors = {{Truth::changed, Truth::unchanged}, {Truth::changed, Truth::ignored}}};
  const Verdicts verdicts{.scan = {1, 0, 1, 1}, .priors = {{1, 0}, {0, 1}}};
  const Counts counts = count_points(verdicts, truth);
  CHECK(counts.added == PointCounts{.found = 1, .false_ = 1, .missed = 1, .unchanged = 0});
  CHECK(counts.removed == PointCounts{.found = 1, .false_ = 0, .missed = 1, .unchanged = 1});
  CHECK(counts.both() == PointCounts{.found = 2, .false_ = 1, .missed = 2, .unchanged = 1});
}
