#include "tests/evaluate/objects.hpp"

#include <doctest/doctest.h>

#include "tests/evaluate/hand_made.hpp"

using namespace raywatch;
using namespace raywatch::evaluation;

namespace {

/// A scan against one prior that has nothing but background, with every point testable.
struct Scene {
  SimulatedScan scan;
  SimulatedScan prior;
  CaseLabels labels;
  Comparison comparison;

  explicit Scene(const std::vector<StateId>& scan_labels, const std::vector<StateId>& prior_labels = {}) {
    scan = hand_made_scan({.labels = scan_labels, .present = {1, 2}});
    prior = hand_made_scan({.labels = prior_labels, .present = {8, 9}});
    labels.scan = &scan;
    labels.priors = {&prior};
    labels.truth = truth_of(scan, labels.priors);
    labels.testable_scan.assign(scan_labels.size(), 1);
    labels.testable_priors = {std::vector<std::uint8_t>(prior_labels.size(), 1)};
    comparison.change_of.assign(scan_labels.size(), -1);
  }
  Scene(const Scene&) = delete;
  Scene& operator=(const Scene&) = delete;

  /// A change that came, of the scan's points from `first` to before `last`.
  void change(std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      comparison.change_of[i] = static_cast<std::int32_t>(comparison.changes.size());
    }
    comparison.changes.push_back({.kind = ChangeKind::added});
  }
  void removal(std::uint32_t first, std::uint32_t last) {
    const auto number = static_cast<std::int32_t>(comparison.changes.size());
    for (std::uint32_t i = first; i < last; ++i) {
      comparison.prior_points.push_back({.prior = 0, .index = i, .change = number});
    }
    comparison.changes.push_back({.kind = ChangeKind::removed});
  }
  ObjectScore score() const { return count_objects(comparison, labels); }
};

}  // namespace

TEST_CASE("an object that one change covers is found as exactly one") {
  Scene scene(repeated({{0, 100}, {1, 40}}));
  scene.change(100, 135);
  CHECK(scene.score().added == ObjectCounts{.real = 1, .found = 1, .once = 1});
}

TEST_CASE("an object in two changes is split") {
  Scene scene(repeated({{1, 60}}));
  scene.change(0, 30);
  scene.change(32, 60);
  CHECK(scene.score().added == ObjectCounts{.real = 1, .found = 1, .split = 1});
}

TEST_CASE("two objects in one change are merged") {
  Scene scene(repeated({{1, 50}, {2, 50}}));
  scene.change(0, 100);
  CHECK(scene.score().added == ObjectCounts{.real = 2, .found = 2, .merged = 2});
}

TEST_CASE("a small object is merged into a large one's change when that has half of its returns") {
  Scene scene(repeated({{1, 400}, {2, 20}}));
  scene.change(0, 410);
  CHECK(scene.score().added == ObjectCounts{.real = 2, .found = 2, .merged = 2});
}

TEST_CASE("a change with a few points of another object shows that other object no more") {
  Scene scene(repeated({{1, 400}, {2, 40}}));
  scene.change(0, 405);
  scene.change(405, 440);
  CHECK(scene.score().added == ObjectCounts{.real = 2, .found = 2, .once = 2});
}

TEST_CASE("a change is false when less than a fifth of its points changed; points on no surface do not count") {
  Scene scene(repeated({{0, 81}, {1, 19}, {simulator::kNoSurface, 50}, {0, 40}, {1, 10}}));
  scene.change(0, 100);
  scene.change(150, 200);
  scene.change(100, 150);
  const ObjectCounts counts = scene.score().added;
  CHECK(counts.false_ == 1);
  CHECK(counts.undecided == 1);
}

TEST_CASE("an object counts from fifteen testable returns on") {
  Scene scene(repeated({{1, 14}, {2, 30}}));
  CHECK(scene.score().added == ObjectCounts{.real = 1});
  std::fill(scene.labels.testable_scan.begin() + 20, scene.labels.testable_scan.end(), std::uint8_t{0});
  CHECK(scene.score().added == ObjectCounts{});
}

TEST_CASE("what went is scored apart from what came") {
  Scene scene(repeated({{0, 10}, {1, 20}}), repeated({{8, 30}, {9, 30}, {0, 25}}));
  scene.removal(0, 30);
  scene.removal(60, 85);
  const ObjectScore score = scene.score();
  CHECK(score.added == ObjectCounts{.real = 1});
  CHECK(score.removed == ObjectCounts{.real = 2, .found = 1, .once = 1, .false_ = 1});
  CHECK(score.both() == ObjectCounts{.real = 3, .found = 1, .once = 1, .false_ = 1});
  CHECK(score.comparisons == 1);
}

TEST_CASE("of every object and every false change it is said which changes they are") {
  Scene scene(repeated({{1, 60}, {0, 40}, {2, 20}}));
  scene.change(0, 30);
  scene.change(32, 60);
  scene.change(60, 100);
  const ObjectFates fates = fates_of(scene.comparison, scene.labels);
  REQUIRE(fates.objects.size() == 2);
  CHECK(fates.objects[0].state == 1);
  CHECK(fates.objects[0].shown_by == std::vector<std::size_t>{0, 1});
  CHECK(fates.objects[1].state == 2);
  CHECK(fates.objects[1].shown_by.empty());
  REQUIRE(fates.false_changes.size() == 1);
  CHECK(fates.false_changes[0].shown_by == std::vector<std::size_t>{2});
  CHECK(fates.undecided.empty());
}
