#include <doctest/doctest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <cmath>

#include "storage/scans.hpp"
#include "storage/spatial.hpp"
#include "tests/storage/store_fixture.hpp"

namespace raywatch {
namespace {

std::vector<Vantage> all_vantages(Store& store, SiteId site) {
  return store.read([&](const Snapshot& s) { return list_vantages(s, site, {.limit = 1000, .cursor = std::nullopt}); })
      .items;
}

std::size_t count_sites(const Snapshot& s) {
  return list_sites(s, {.limit = 1000, .cursor = std::nullopt}).items.size();
}

TEST_CASE_FIXTURE(StoreFixture, "scans nearer than a quarter of a metre share a vantage") {
  const VantageId first = add_scan(store, sensor, {at_second(0), {0.0, 0.0, 0.0}}).vantage;
  CHECK(add_scan(store, sensor, {at_second(1), {0.24, 0.0, 0.0}}).vantage == first);
  CHECK(add_scan(store, sensor, {at_second(2), {0.25, 0.0, 0.0}}).vantage != first);
  const std::vector<Vantage> vantages = all_vantages(store, site.id);
  REQUIRE(vantages.size() == 2);
  CHECK(vantages[0].scans == 2);
  CHECK(vantages[0].first_captured_at == at_second(0));
  CHECK(vantages[0].last_captured_at == at_second(1));
}

TEST_CASE_FIXTURE(StoreFixture, "vantages at one place of two sites are two") {
  const Sensor other = add_sensor(store, "mast", add_site(store, "yard").id);
  const VantageId here = add_scan(store, sensor, {at_second(0)}).vantage;
  CHECK(add_scan(store, other, {at_second(0)}).vantage != here);
  CHECK(all_vantages(store, site.id).size() == 1);
}

TEST_CASE_FIXTURE(StoreFixture, "a vantage counts scans out, and goes with its last one") {
  const ScanRecord early = add_scan(store, sensor, {at_second(0)});
  const ScanRecord late = add_scan(store, sensor, {at_second(9)});
  store.write([&](Transaction& t) { delete_scan(t, late.id); });
  REQUIRE(all_vantages(store, site.id).size() == 1);
  CHECK(all_vantages(store, site.id)[0].last_captured_at == at_second(0));
  store.write([&](Transaction& t) { delete_scan(t, early.id); });
  CHECK(all_vantages(store, site.id).empty());
  const ScanRecord again = add_scan(store, sensor, {at_second(10)});
  CHECK(again.vantage > early.vantage);
}

TEST_CASE_FIXTURE(StoreFixture, "the nearest vantages are those that a search through all of them finds") {
  CHECK(rc::check("places far and near, any limit", [&] {
    const SiteId here = add_site(store, std::to_string(store.read(count_sites))).id;
    const Sensor mover = add_sensor(store, "mover " + std::to_string(here.value), here);
    const auto places = *rc::gen::container<std::vector<std::array<int, 3>>>(
        rc::gen::container<std::array<int, 3>>(rc::gen::inRange(-300, 300)));
    store.write([&](Transaction& t) {
      std::int64_t second = 0;
      for (const auto& [x, y, z] : places) {
        insert_scan(t, sketched_scan(mover, {at_second(second++), Eigen::Vector3d(x, y, z) / 3.0}));
      }
    });
    const Eigen::Vector3d place_m(1.0, 2.0, 3.0);
    const auto limit = *rc::gen::inRange<std::size_t>(0, 20);
    std::vector<Vantage> expected = all_vantages(store, here);
    const auto distance_m = [&](const Vantage& v) { return (v.position_m - place_m).norm(); };
    std::stable_sort(expected.begin(), expected.end(),
                     [&](const Vantage& a, const Vantage& b) { return distance_m(a) < distance_m(b); });
    expected.resize(std::min(limit, expected.size()));
    const std::vector<Vantage> nearest =
        store.read([&](const Snapshot& s) { return nearest_vantages(s, here, place_m, limit); });
    RC_ASSERT(nearest.size() == expected.size());
    for (std::size_t i = 0; i < nearest.size(); ++i) RC_ASSERT(nearest[i].id == expected[i].id);
  }));
}

TEST_CASE("bounds as floats never shrink") {
  CHECK(rc::check("any number", [](double value) {
    if (std::isnan(value)) return;
    RC_ASSERT(static_cast<double>(float_below(value)) <= value);
    RC_ASSERT(static_cast<double>(float_above(value)) >= value);
  }));
  for (const double value : {1e-46, -1e-46, 1e300, -1e300, 0.0, 16'777'217.0}) {
    CAPTURE(value);
    CHECK(static_cast<double>(float_below(value)) <= value);
    CHECK(static_cast<double>(float_above(value)) >= value);
  }
}

}  // namespace
}  // namespace raywatch
