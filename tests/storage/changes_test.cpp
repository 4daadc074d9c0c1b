#include <doctest/doctest.h>
#include <rapidcheck.h>

#include <random>

#include "core/error.hpp"
#include "storage/comparisons.hpp"
#include "tests/storage/store_fixture.hpp"

namespace raywatch {
namespace {

std::vector<ChangeRecord> all_changes(Store& store, const ChangeFilter& filter, std::size_t limit) {
  std::vector<ChangeRecord> changes;
  PageRequest request{.limit = limit, .cursor = std::nullopt};
  do {
    Page<ChangeRecord> page = store.read([&](const Snapshot& s) { return list_changes(s, filter, request); });
    changes.insert(changes.end(), page.items.begin(), page.items.end());
    request.cursor = page.next;
  } while (request.cursor);
  return changes;
}

std::vector<ChangeId> ids_of(const std::vector<ChangeRecord>& changes) {
  std::vector<ChangeId> ids;
  for (const ChangeRecord& change : changes) ids.push_back(change.id);
  return ids;
}

/// Two scans of the site, the first compared twice, with changes strewn over 20 m.
struct ChangeFixture : StoreFixture {
  ChangeFixture() {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> coordinate_m(-10.0, 10.0);
    const ScanId first = add_scan(store, sensor, {at_second(0)}).id;
    const ScanId second = add_scan(store, sensor, {at_second(1)}).id;
    for (const ScanId scan : {first, second, first}) {
      add_comparison(store, scan);
      std::vector<Change> changes;
      for (int i = 0; i < 30; ++i) {
        const Eigen::Vector3d place_m(coordinate_m(random), coordinate_m(random), coordinate_m(random));
        changes.push_back(change_at(place_m, static_cast<ChangeKind>(i % 3)));
        changes.back().volume_m3 = i;
      }
      finish_next_job(store, site.id, changes);
    }
  }
};

TEST_CASE_FIXTURE(ChangeFixture, "a change comes back as it was given") {
  add_comparison(store, add_scan(store, sensor, {at_second(9)}).id);
  Change given = change_at({1.0 / 3.0, -2.0, 1e5}, ChangeKind::discrepancy);
  given.box.world_from_box = Eigen::Quaterniond(0.5, 0.5, 0.5, 0.5);
  given.confidence = {0.1, 0.2, 0.3, 0.4};
  const Job job = finish_next_job(store, site.id, {change_at({0.0, 0.0, 0.0}), given});
  const ChangeRecord listed = all_changes(store, {}, 100).at(1);
  const ChangeRecord record = store.read([&](const Snapshot& s) { return find_change(s, listed.id).value(); });
  CHECK(record.comparison == job.comparison);
  CHECK(record.place == 1);
  CHECK(record.captured_at == at_second(9));
  CHECK(record.change.kind == ChangeKind::discrepancy);
  CHECK(record.change.centroid_m == given.centroid_m);
  CHECK(record.change.bounds_m.min() == given.bounds_m.min());
  CHECK(record.change.bounds_m.max() == given.bounds_m.max());
  CHECK(record.change.box.center_m == given.box.center_m);
  CHECK(record.change.box.size_m == given.box.size_m);
  CHECK(record.change.box.world_from_box.coeffs() == given.box.world_from_box.coeffs());
  CHECK(record.change.points == given.points);
  CHECK(record.change.confidence.unknown == 0.4);
}

TEST_CASE_FIXTURE(ChangeFixture,
                  "changes are listed newest capture first, then by comparison and place, at any page size") {
  const std::vector<ChangeRecord> all = all_changes(store, {}, 1000);
  REQUIRE(all.size() == 90);
  const auto key = [](const ChangeRecord& c) {
    return std::tuple(-c.captured_at.time_since_epoch(), c.comparison, c.place);
  };
  CHECK(std::is_sorted(all.begin(), all.end(), [&](const auto& a, const auto& b) { return key(a) < key(b); }));
  for (const std::size_t limit : {1, 7, 30, 45}) CHECK(ids_of(all_changes(store, {}, limit)) == ids_of(all));
}

TEST_CASE_FIXTURE(ChangeFixture, "every combination of filters gives what it says") {
  const std::vector<ChangeRecord> all = all_changes(store, {}, 1000);
  const Eigen::AlignedBox3d box_m(Eigen::Vector3d(-4.0, -6.0, -3.0), Eigen::Vector3d(5.0, 4.0, 8.0));
  for (unsigned bits = 0; bits < 128; ++bits) {
    CAPTURE(bits);
    ChangeFilter filter;
    if (bits & 1 || bits & 64) filter.site = site.id;
    if (bits & 2) filter.comparison = all[40].comparison;
    if (bits & 4) filter.kind = ChangeKind::removed;
    if (bits & 8) filter.from = at_second(1);
    if (bits & 16) filter.to = at_second(1);
    if (bits & 32) filter.min_volume_m3 = 11.0;
    if (bits & 64) filter.box_m = box_m;
    std::vector<ChangeId> wanted;
    for (const ChangeRecord& c : all) {
      const bool fits = (!filter.comparison || c.comparison == *filter.comparison) &&
                        (!filter.kind || c.change.kind == *filter.kind) &&
                        (!filter.from || c.captured_at >= *filter.from) && (!filter.to || c.captured_at < *filter.to) &&
                        (!filter.min_volume_m3 || c.change.volume_m3 >= *filter.min_volume_m3) &&
                        (!filter.box_m || filter.box_m->intersects(c.change.bounds_m));
      if (fits) wanted.push_back(c.id);
    }
    CHECK(ids_of(all_changes(store, filter, 8)) == wanted);
  }
}

TEST_CASE_FIXTURE(StoreFixture, "a box that many changes meet is answered through time and gives the same") {
  add_comparison(store, add_scan(store, sensor, {at_second(0)}).id);
  std::vector<Change> changes;
  for (int i = 0; i < 6000; ++i) changes.push_back(change_at({0.01 * i, 0.0, 0.0}));
  finish_next_job(store, site.id, changes);
  ChangeFilter filter;
  filter.site = site.id;
  // The cubes whose centre is at most half a metre beyond the box meet it: x <= 55.5.
  filter.box_m = Eigen::AlignedBox3d(Eigen::Vector3d(-1.0, -1.0, -1.0), Eigen::Vector3d(55.004, 1.0, 1.0));
  CHECK(all_changes(store, filter, 1000).size() == 5551);
}

TEST_CASE_FIXTURE(StoreFixture, "a box finds a change that it misses by rounding to floats only if they really meet") {
  add_comparison(store, add_scan(store, sensor, {at_second(0)}).id);
  const double edge_m = 1000.1;  // not a float
  Change change = change_at({edge_m, 0.0, 0.0});
  change.bounds_m = Eigen::AlignedBox3d(Eigen::Vector3d(edge_m, 0.0, 0.0), Eigen::Vector3d(edge_m + 1.0, 1.0, 1.0));
  finish_next_job(store, site.id, {change});
  ChangeFilter filter;
  filter.site = site.id;
  const auto found_up_to = [&](double x_m) {
    filter.box_m = Eigen::AlignedBox3d(Eigen::Vector3d(0.0, 0.0, 0.0), Eigen::Vector3d(x_m, 1.0, 1.0));
    return all_changes(store, filter, 10).size();
  };
  CHECK(found_up_to(edge_m) == 1);
  CHECK(found_up_to(std::nextafter(edge_m, 0.0)) == 0);
}

TEST_CASE_FIXTURE(StoreFixture, "a box without a site is refused") {
  ChangeFilter filter;
  filter.box_m = Eigen::AlignedBox3d(Eigen::Vector3d::Zero(), Eigen::Vector3d::Ones());
  CHECK_THROWS_AS(all_changes(store, filter, 10), InvalidInput);
}

}  // namespace
}  // namespace raywatch
