#include <doctest/doctest.h>
#include <rapidcheck.h>

#include "core/error.hpp"
#include "storage/scans.hpp"
#include "tests/storage/store_fixture.hpp"

namespace raywatch {
namespace {

/// All pages of a list, joined.
std::vector<ScanId> all_scans(Store& store, const ScanFilter& filter, std::size_t limit) {
  std::vector<ScanId> ids;
  PageRequest request{.limit = limit, .cursor = std::nullopt};
  do {
    const Page<ScanRecord> page = store.read([&](const Snapshot& s) { return list_scans(s, filter, request); });
    CHECK(page.items.size() <= limit);
    for (const ScanRecord& scan : page.items) ids.push_back(scan.id);
    request.cursor = page.next;
  } while (request.cursor);
  return ids;
}

/// Two sensors at three places, several scans of each time.
struct ScanListFixture : StoreFixture {
  Sensor other = add_sensor(store, "window", site.id);
  std::vector<ScanRecord> scans;
  ScanListFixture() {
    for (int i = 0; i < 12; ++i) {
      const Eigen::Vector3d place_m(2.0 * (i % 3), 0.0, 0.0);
      scans.push_back(add_scan(store, i % 2 == 0 ? sensor : other, {at_second(i / 2), place_m}));
    }
  }

  /// What a list must give, by its definition.
  std::vector<ScanId> expected(const std::function<bool(const ScanRecord&)>& wanted) const {
    std::vector<const ScanRecord*> chosen;
    for (const ScanRecord& scan : scans) {
      if (wanted(scan)) chosen.push_back(&scan);
    }
    std::sort(chosen.begin(), chosen.end(), [](const ScanRecord* a, const ScanRecord* b) {
      return std::pair(a->captured_at, a->id) > std::pair(b->captured_at, b->id);
    });
    std::vector<ScanId> ids;
    for (const ScanRecord* scan : chosen) ids.push_back(scan->id);
    return ids;
  }
};

TEST_CASE_FIXTURE(ScanListFixture, "every combination of filters gives what it says, newest first, at any page size") {
  for (unsigned bits = 0; bits < 64; ++bits) {
    CAPTURE(bits);
    ScanFilter filter;
    const bool near = bits & 32;
    if (bits & 1 || near) filter.site = site.id;
    if (bits & 2) filter.sensor = other.id;
    if (bits & 4) filter.vantage = scans[1].vantage;
    if (bits & 8) filter.from = at_second(1);
    if (bits & 16) filter.to = at_second(4);
    if (near) filter.near_m = Eigen::Vector3d(0.0, 0.0, 0.0);
    filter.near_radius_m = 3.0;
    const std::vector<ScanId> wanted = expected([&](const ScanRecord& scan) {
      return (!filter.sensor || scan.sensor == *filter.sensor) &&
             (!filter.vantage || scan.vantage == *filter.vantage) &&
             (!filter.from || scan.captured_at >= *filter.from) && (!filter.to || scan.captured_at < *filter.to) &&
             (!near || scan.pose.position_m.norm() < 3.0);
    });
    for (const std::size_t limit : {1, 2, 5, 100}) CHECK(all_scans(store, filter, limit) == wanted);
  }
}

TEST_CASE_FIXTURE(ScanListFixture, "a sensor or a vantage of another site has no scans in a site") {
  ScanFilter filter;
  filter.site = add_site(store, "yard").id;
  filter.sensor = sensor.id;
  CHECK(all_scans(store, filter, 10).empty());
  filter.sensor.reset();
  filter.vantage = scans[0].vantage;
  CHECK(all_scans(store, filter, 10).empty());
}

TEST_CASE_FIXTURE(ScanListFixture, "a list goes on behind its last item though newer scans arrived") {
  const Page<ScanRecord> first =
      store.read([](const Snapshot& s) { return list_scans(s, {}, {.limit = 5, .cursor = std::nullopt}); });
  add_scan(store, sensor, {at_second(100)});
  const Page<ScanRecord> second =
      store.read([&](const Snapshot& s) { return list_scans(s, {}, {.limit = 100, .cursor = first.next}); });
  CHECK(first.items.size() + second.items.size() == scans.size());
  CHECK(second.items.front().captured_at <= first.items.back().captured_at);
}

TEST_CASE_FIXTURE(StoreFixture, "around many vantages a list is found through time and stays the same") {
  std::vector<ScanId> newest_first;
  store.write([&](Transaction& t) {
    for (int i = 0; i < 600; ++i) {
      const ScanRecord scan = insert_scan(t, sketched_scan(sensor, {at_second(i), {0.3 * i, 0.0, 0.0}}));
      newest_first.insert(newest_first.begin(), scan.id);
    }
  });
  ScanFilter filter;
  filter.site = site.id;
  filter.near_m = Eigen::Vector3d::Zero();
  filter.near_radius_m = 0.3 * 550 - 0.1;
  CHECK(all_scans(store, filter, 70) == std::vector(newest_first.begin() + 50, newest_first.end()));
}

TEST_CASE_FIXTURE(StoreFixture, "a place without a site is refused") {
  ScanFilter filter;
  filter.near_m = Eigen::Vector3d::Zero();
  CHECK_THROWS_AS(all_scans(store, filter, 10), InvalidInput);
}

TEST_CASE_FIXTURE(StoreFixture, "the latest scan of a vantage lies between two times") {
  const VantageId vantage = add_scan(store, sensor, {at_second(10)}).vantage;
  add_scan(store, sensor, {at_second(20)});
  add_scan(store, sensor, {at_second(30), {5.0, 0.0, 0.0}});
  const auto latest = [&](std::int64_t not_before, std::int64_t before) -> std::optional<Time> {
    const auto scan = store.read(
        [&](const Snapshot& s) { return latest_scan(s, vantage, at_second(not_before), at_second(before)); });
    return scan ? std::optional(scan->captured_at) : std::nullopt;
  };
  CHECK(latest(0, 100) == at_second(20));
  CHECK(latest(0, 20) == at_second(10));
  CHECK(latest(20, 21) == at_second(20));
  CHECK_FALSE(latest(0, 10).has_value());
  CHECK_FALSE(latest(21, 100).has_value());
}

}  // namespace
}  // namespace raywatch
