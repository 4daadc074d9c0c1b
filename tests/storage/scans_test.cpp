#include "storage/scans.hpp"

#include <doctest/doctest.h>

#include "core/error.hpp"
#include "tests/storage/store_fixture.hpp"

namespace raywatch {
namespace {

ScanRecord found_scan(Store& store, ScanId id) {
  return store.read([&](const Snapshot& s) { return find_scan(s, id).value(); });
}

TEST_CASE_FIXTURE(StoreFixture, "a scan comes back as it was given, queued") {
  ScanRecord given = sketched_scan(sensor, {.captured_at = at_second(7), .position_m = {1.0 / 3.0, 2.0, 3.0}});
  given.points = 1234;
  given.pose.orientation = Eigen::Quaterniond(0.5, 0.5, 0.5, 0.5);
  given.registration.residual_m = 0.01;
  given.registration.against = ScanId{3};
  given.estimated.no_return_m = 70.0;
  given.grid = ShotGrid{2, 617};
  given.has_intensity = true;
  given.note = "first";
  given.payload = {"payload/1/2026-01.db", 5};
  given.stored_bytes = 999;
  const ScanId id = store.write([&](Transaction& t) { return insert_scan(t, given); }).id;
  const ScanRecord scan = found_scan(store, id);
  CHECK(scan.captured_at == given.captured_at);
  CHECK(scan.received_at == given.received_at);
  CHECK(scan.points == 1234);
  CHECK(scan.sha256 == given.sha256);
  CHECK(scan.pose.position_m == given.pose.position_m);
  CHECK(scan.pose.orientation.coeffs() == given.pose.orientation.coeffs());
  CHECK(scan.registration.state == RegistrationState::none);
  CHECK(scan.registration.residual_m == 0.01);
  CHECK(scan.registration.against == ScanId{3});
  CHECK(scan.estimated.no_return_m == 70.0);
  CHECK(scan.grid == given.grid);
  CHECK(scan.has_intensity);
  CHECK_FALSE(scan.pinned);
  CHECK(scan.note == "first");
  CHECK(scan.state == ScanState::queued);
  CHECK(scan.payload == given.payload);
  CHECK(scan.stored_bytes == 999);
  CHECK(store.read([&](const Snapshot& s) { return find_scan(s, sensor.id, at_second(7)).value().id; }) == id);
}

TEST_CASE_FIXTURE(StoreFixture, "the same bytes of a sensor and time give the stored scan, other bytes a conflict") {
  const ScanRecord first = add_scan(store, sensor, {.captured_at = at_second(0)});
  CHECK(add_scan(store, sensor, {.captured_at = at_second(0)}).id == first.id);
  ScanRecord other = sketched_scan(sensor, {.captured_at = at_second(0)});
  other.sha256 = "other";
  CHECK_THROWS_AS(store.write([&](Transaction& t) { insert_scan(t, other); }), Conflict);
}

TEST_CASE_FIXTURE(StoreFixture, "a scan of a sensor of another site is a conflict") {
  ScanRecord scan = sketched_scan(sensor, {.captured_at = at_second(0)});
  scan.site = add_site(store, "yard").id;
  CHECK_THROWS_AS(store.write([&](Transaction& t) { insert_scan(t, scan); }), Conflict);
}

TEST_CASE_FIXTURE(StoreFixture,
                  "the first scan fixes the origin of its site: zero when it is near, else whole metres") {
  add_scan(store, sensor, {.captured_at = at_second(0), .position_m = {12.5, 3.0, 1.0}});
  const Site other = add_site(store, "quarry");
  const Sensor mast = add_sensor(store, "mast", other.id);
  const Eigen::Vector3d far_m(391'000.4, 6'460'000.6, 310.2);
  const ScanRecord scan = add_scan(store, mast, {.captured_at = at_second(0), .position_m = far_m});
  const auto site_now = [&](SiteId id) {
    return store.read([&](const Snapshot& s) { return find_site(s, id).value(); });
  };
  CHECK(site_now(site.id).origin_m == Eigen::Vector3d::Zero().eval());
  CHECK(site_now(other.id).origin_m == Eigen::Vector3d(391'000.0, 6'460'001.0, 310.0));
  CHECK(local_pose(scan, site_now(other.id)).position_m == far_m - Eigen::Vector3d(391'000.0, 6'460'001.0, 310.0));
}

TEST_CASE("a scan's local pose is the reported one, corrected, without the site's origin") {
  ScanRecord scan;
  scan.pose.position_m = {110.0, 20.0, 0.0};
  scan.registration.correction.position_m = {1.0, 0.0, 0.0};
  Site site;
  site.origin_m = Eigen::Vector3d(100.0, 0.0, 0.0);
  CHECK(local_pose(scan, site).position_m == Eigen::Vector3d(11.0, 20.0, 0.0));
}

TEST_CASE_FIXTURE(StoreFixture, "a note and a pin can be set one without the other") {
  const ScanRecord scan = add_scan(store, sensor, {.captured_at = at_second(0)});
  ScanEdit pin, note;
  pin.pinned = true;
  note.note = "look";
  store.write([&](Transaction& t) { edit_scan(t, scan.id, pin); });
  store.write([&](Transaction& t) { edit_scan(t, scan.id, note); });
  CHECK(found_scan(store, scan.id).pinned);
  CHECK(found_scan(store, scan.id).note == "look");
}

TEST_CASE_FIXTURE(StoreFixture,
                  "a deleted scan takes its comparisons, changes and vantage with it and names its payloads") {
  const ScanRecord scan = add_scan_with_points(store, sensor, {.captured_at = at_second(0)}, cloud_of(10, 1));
  const ComparisonRecord comparison = add_comparison(store, scan.id);
  finish_next_job(store, site.id, {change_at({1.0, 2.0, 3.0})});
  const std::vector<PayloadRef> payloads = store.write([&](Transaction& t) { return delete_scan(t, scan.id); });
  CHECK(payloads == std::vector{scan.payload});
  store.read([&](const Snapshot& s) {
    CHECK_FALSE(find_scan(s, scan.id).has_value());
    CHECK_FALSE(find_comparison(s, comparison.id).has_value());
    CHECK(list_changes(s, {}, {}).items.empty());
    ChangeFilter anywhere;
    anywhere.site = site.id;
    anywhere.box_m = Eigen::AlignedBox3d(Eigen::Vector3d::Constant(-100.0), Eigen::Vector3d::Constant(100.0));
    CHECK(list_changes(s, anywhere, {}).items.empty());
    CHECK(list_vantages(s, site.id, {}).items.empty());
  });
}

TEST_CASE_FIXTURE(StoreFixture, "a scan that is pinned, being compared or a prior is not deleted") {
  const ScanRecord old = add_scan(store, sensor, {.captured_at = at_second(0)});
  const ScanRecord scan = add_scan(store, sensor, {.captured_at = at_second(1)});
  const auto remove = [&](ScanId id) { store.write([&](Transaction& t) { delete_scan(t, id); }); };
  ScanEdit pin;
  pin.pinned = true;
  store.write([&](Transaction& t) { edit_scan(t, old.id, pin); });
  CHECK_THROWS_AS(remove(old.id), Conflict);
  pin.pinned = false;
  store.write([&](Transaction& t) { edit_scan(t, old.id, pin); });
  add_comparison(store, scan.id);
  const Job job = store.write([&](Transaction& t) { return start_job(t, site.id).value(); });
  CHECK_THROWS_AS(remove(scan.id), Conflict);
  ComparisonResult result;
  result.priors.push_back({.scan = old.id, .vantage = old.vantage, .overlap = 0.5, .added = 1, .removed = 2});
  store.write([&](Transaction& t) { finish_job(t, job, result, at_second(2)); });
  CHECK_THROWS_AS(remove(old.id), Conflict);
  remove(scan.id);
  remove(old.id);
  CHECK_THROWS_AS(remove(old.id), NotFound);
}

}  // namespace
}  // namespace raywatch
