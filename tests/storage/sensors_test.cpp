#include "storage/sensors.hpp"

#include <doctest/doctest.h>

#include "core/error.hpp"
#include "tests/storage/store_fixture.hpp"

namespace raywatch {
namespace {

TEST_CASE_FIXTURE(StoreFixture, "a sensor comes back with its pose and its model bit by bit") {
  Sensor given;
  given.name = "mast";
  given.site = site.id;
  given.pose = Pose{Eigen::Quaterniond(0.1, 0.2, 0.3, 0.927361849549570).normalized(), {1.0 / 3.0, -2e6, 1e-9}};
  given.known.range_noise_m = 0.1 + 0.2;
  given.known.angular_resolution_rad = Eigen::Vector2d(0.003, 0.007);
  given.known.no_return_m = 655.35;
  given.interval_s = 0.1;
  const SensorId id = store.write([&](Transaction& t) { return insert_sensor(t, given, at_second(3)); }).id;
  const Sensor found = store.read([&](const Snapshot& s) { return find_sensor(s, id).value(); });
  CHECK(found.pose->orientation.coeffs() == given.pose->orientation.coeffs());
  CHECK(found.pose->position_m == given.pose->position_m);
  CHECK(found.known.range_noise_m == given.known.range_noise_m);
  CHECK(found.known.angular_resolution_rad == given.known.angular_resolution_rad);
  CHECK(found.known.no_return_m == given.known.no_return_m);
  CHECK_FALSE(found.known.max_range_m.has_value());
  CHECK(found.interval_s == given.interval_s);
  CHECK(found.created_at == at_second(3));
}

TEST_CASE_FIXTURE(StoreFixture, "the name of a sensor is taken in every site") {
  const Site other = add_site(store, "yard");
  CHECK_THROWS_AS(add_sensor(store, "door", other.id), Conflict);
}

TEST_CASE_FIXTURE(StoreFixture, "a sensor needs a site that exists") {
  CHECK_THROWS_AS(add_sensor(store, "lost", SiteId{99}), NotFound);
}

TEST_CASE_FIXTURE(StoreFixture, "an edit can set a pose and clear it again") {
  SensorEdit edit;
  edit.pose = std::optional(Pose{Eigen::Quaterniond::Identity(), {1.0, 2.0, 3.0}});
  store.write([&](Transaction& t) { edit_sensor(t, sensor.id, edit); });
  const auto stored = [&] { return store.read([&](const Snapshot& s) { return find_sensor(s, "door").value(); }); };
  CHECK(stored().pose->position_m == Eigen::Vector3d(1.0, 2.0, 3.0));
  SensorEdit clear;
  clear.pose.emplace(std::nullopt);
  store.write([&](Transaction& t) { edit_sensor(t, sensor.id, clear); });
  CHECK_FALSE(stored().pose.has_value());
}

TEST_CASE_FIXTURE(StoreFixture, "what scans show about a sensor stands beside what is known of it") {
  SensorModel estimated;
  estimated.max_range_m = 50.0;
  store.write([&](Transaction& t) { set_estimated_model(t, sensor.id, estimated); });
  const Sensor found = store.read([&](const Snapshot& s) { return find_sensor(s, sensor.id).value(); });
  CHECK(found.estimated.max_range_m == 50.0);
  CHECK_FALSE(found.known.max_range_m.has_value());
}

TEST_CASE_FIXTURE(StoreFixture, "a sensor with scans is not deleted") {
  add_scan(store, sensor, {.captured_at = at_second(0)});
  CHECK_THROWS_AS(store.write([&](Transaction& t) { delete_sensor(t, sensor.id); }), Conflict);
}

TEST_CASE_FIXTURE(StoreFixture, "sensors can be listed by site") {
  const Site other = add_site(store, "yard");
  add_sensor(store, "mast", other.id);
  const Page<Sensor> all = store.read([](const Snapshot& s) { return list_sensors(s, std::nullopt, {}); });
  const Page<Sensor> of_yard = store.read([&](const Snapshot& s) { return list_sensors(s, other.id, {}); });
  CHECK(all.items.size() == 2);
  REQUIRE(of_yard.items.size() == 1);
  CHECK(of_yard.items[0].name == "mast");
}

}  // namespace
}  // namespace raywatch
