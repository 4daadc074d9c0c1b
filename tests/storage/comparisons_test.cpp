#include "storage/comparisons.hpp"

#include <doctest/doctest.h>

#include <limits>

#include "core/error.hpp"
#include "storage/scans.hpp"
#include "tests/storage/store_fixture.hpp"

namespace raywatch {
namespace {

ComparisonRecord found_comparison(Store& store, ComparisonId id) {
  return store.read([&](const Snapshot& s) { return find_comparison(s, id).value(); });
}

TEST_CASE_FIXTURE(StoreFixture, "a comparison keeps each kind of reference and its parameters") {
  const ScanRecord scan = add_scan(store, sensor, {at_second(0)});
  CompareParameters parameters;
  parameters.grouping = Grouping::union_;
  parameters.angle_rad = 0.1 + 0.2;
  parameters.support_distance_m = 0.25;
  parameters.growth_distance_m = 0.5;
  parameters.foliage_distance_m = 0.75;
  parameters.clustering = false;
  parameters.contemporary_tolerance = std::chrono::seconds(7);
  const std::vector<Reference> references{PreviousReference{}, WindowReference{at_second(1), at_second(2)},
                                          ExplicitReference{{ScanId{3}, ScanId{5}}}};
  for (const Reference& reference : references) {
    const ComparisonId id = store.write(
        [&](Transaction& t) { return insert_comparison(t, scan.id, reference, parameters, at_second(4)).id; });
    const ComparisonRecord comparison = found_comparison(store, id);
    CHECK((comparison.reference == reference));
    CHECK(comparison.scan == scan.id);
    CHECK(comparison.site == site.id);
    CHECK(comparison.state == ComparisonState::queued);
    CHECK(comparison.created_at == at_second(4));
    CHECK(comparison.parameters.grouping == Grouping::union_);
    CHECK(comparison.parameters.angle_rad == parameters.angle_rad);
    CHECK(comparison.parameters.support_distance_m == 0.25);
    CHECK(comparison.parameters.growth_distance_m == 0.5);
    CHECK(comparison.parameters.foliage_distance_m == 0.75);
    CHECK_FALSE(comparison.parameters.clustering);
    CHECK(comparison.parameters.contemporary_tolerance == std::chrono::seconds(7));
  }
}

TEST_CASE_FIXTURE(StoreFixture, "parameters that are not finite are refused, and nothing is queued") {
  const ScanRecord scan = add_scan(store, sensor, {at_second(0)});
  CompareParameters parameters;
  parameters.range_m = std::numeric_limits<double>::infinity();
  CHECK_THROWS_AS(store.write([&](Transaction& t) {
    insert_comparison(t, scan.id, PreviousReference{}, parameters, at_second(0));
  }),
                  InvalidInput);
  CHECK(store.read([](const Snapshot& s) { return unfinished_jobs(s); }) == 0);
}

TEST_CASE_FIXTURE(StoreFixture, "a comparison of a scan that does not exist is not found") {
  CHECK_THROWS_AS(add_comparison(store, ScanId{9}), NotFound);
}

TEST_CASE_FIXTURE(StoreFixture, "a result comes back whole") {
  const ScanRecord scan = add_scan(store, sensor, {at_second(0)});
  const ComparisonRecord queued = add_comparison(store, scan.id);
  const Job job = store.write([&](Transaction& t) { return start_job(t, site.id).value(); });
  ComparisonResult result;
  result.priors.push_back({.scan = ScanId{7}, .vantage = VantageId{2}, .overlap = 0.75, .added = 11, .removed = 12});
  result.candidates.push_back({.scan = ScanId{8},
                               .vantage = VantageId{3},
                               .distance_m = 1.5,
                               .age = std::chrono::nanoseconds(-5),
                               .overlap = 0.1,
                               .gain = 0.05,
                               .chosen = false,
                               .reason = "adds too little"});
  result.counts = {1, 2, 3, 4, 5, 6, 7};
  result.testable = 0.9;
  result.timings_ms = {{"detect", 1.25}};
  result.warnings = {"broken \xff name"};
  result.payload = {"payload/1/2026-01.db", 4};
  result.changes = {change_at({1.0, 2.0, 3.0}), change_at({4.0, 5.0, 6.0}, ChangeKind::removed)};
  CHECK(store.write([&](Transaction& t) { return finish_job(t, job, result, at_second(9)); }));

  const ComparisonRecord done = found_comparison(store, queued.id);
  CHECK(done.state == ComparisonState::done);
  CHECK(done.counts == result.counts);
  CHECK(done.testable == 0.9);
  CHECK(done.changes == 2);
  CHECK(done.timings_ms == result.timings_ms);
  CHECK(done.warnings == std::vector<std::string>{"broken \xef\xbf\xbd name"});
  CHECK(done.payload == result.payload);
  CHECK(done.finished_at == at_second(9));
  REQUIRE(done.priors.size() == 1);
  CHECK(done.priors[0].scan == ScanId{7});
  CHECK(done.priors[0].removed == 12);
  const auto candidates = store.read([&](const Snapshot& s) { return candidates_of(s, queued.id); });
  REQUIRE(candidates.size() == 1);
  CHECK(candidates[0].age == std::chrono::nanoseconds(-5));
  CHECK(candidates[0].reason == "adds too little");
}

TEST_CASE_FIXTURE(StoreFixture, "comparisons are listed newest first by site, scan and state") {
  const ScanRecord first = add_scan(store, sensor, {at_second(0)});
  const ScanRecord second = add_scan(store, sensor, {at_second(1)});
  const ComparisonId a = add_comparison(store, first.id).id;
  const ComparisonId b = add_comparison(store, second.id).id;
  const ComparisonId c = add_comparison(store, first.id).id;
  finish_next_job(store, site.id);  // a
  const auto ids = [&](const ComparisonFilter& filter) {
    std::vector<ComparisonId> all;
    PageRequest page{.limit = 1, .cursor = std::nullopt};
    do {
      const auto one = store.read([&](const Snapshot& s) { return list_comparisons(s, filter, page); });
      for (const ComparisonRecord& comparison : one.items) all.push_back(comparison.id);
      page.cursor = one.next;
    } while (page.cursor);
    return all;
  };
  using Ids = std::vector<ComparisonId>;
  CHECK(ids({}) == Ids{c, b, a});
  CHECK(ids({.site = site.id, .scan = std::nullopt, .state = std::nullopt}) == Ids{c, b, a});
  CHECK(ids({.site = std::nullopt, .scan = first.id, .state = std::nullopt}) == Ids{c, a});
  CHECK(ids({.site = site.id, .scan = first.id, .state = ComparisonState::done}) == Ids{a});
  CHECK(ids({.site = site.id, .scan = std::nullopt, .state = ComparisonState::queued}) == Ids{c, b});
  CHECK(ids({.site = std::nullopt, .scan = std::nullopt, .state = ComparisonState::done}) == Ids{a});
  CHECK(ids({.site = SiteId{99}, .scan = std::nullopt, .state = std::nullopt}).empty());
  const auto of_first = store.read([&](const Snapshot& s) { return comparisons_of(s, first.id); });
  REQUIRE(of_first.size() == 2);
  CHECK(of_first[0].id == a);
}

}  // namespace
}  // namespace raywatch
