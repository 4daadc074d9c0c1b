#include "storage/sites.hpp"

#include <doctest/doctest.h>

#include "core/error.hpp"
#include "tests/storage/store_fixture.hpp"

namespace raywatch {
namespace {

TEST_CASE_FIXTURE(StoreFixture, "a site is found by its name and by its id, as it was given") {
  Site given;
  given.name = "quarry";
  given.time_zone = "Australia/Perth";
  given.profile = Profile::survey;
  given.epsg = 28350;
  given.origin_m = Eigen::Vector3d(391'000.0, 6'460'000.0, 310.5);
  const Site stored = store.write([&](Transaction& t) { return insert_site(t, given, at_second(5)); });
  const Site found = store.read([&](const Snapshot& s) { return find_site(s, "quarry").value(); });
  CHECK(found.id == stored.id);
  CHECK(found.time_zone == given.time_zone);
  CHECK(found.profile == Profile::survey);
  CHECK(found.epsg == given.epsg);
  CHECK(found.origin_m == given.origin_m);
  CHECK(found.created_at == at_second(5));
  CHECK(store.read([&](const Snapshot& s) { return find_site(s, stored.id).value().name; }) == "quarry");
}

TEST_CASE_FIXTURE(StoreFixture, "a second site of a name is a conflict") {
  CHECK_THROWS_AS(add_site(store, "hall"), Conflict);
}

TEST_CASE_FIXTURE(StoreFixture, "an edit changes what it names and nothing else") {
  SiteEdit edit;
  edit.time_zone = "Europe/Berlin";
  store.write([&](Transaction& t) { edit_site(t, site.id, edit); });
  const Site edited = store.read([&](const Snapshot& s) { return find_site(s, site.id).value(); });
  CHECK(edited.time_zone == "Europe/Berlin");
  CHECK(edited.profile == site.profile);
  CHECK(edited.name == site.name);
}

TEST_CASE_FIXTURE(StoreFixture, "a site has an EPSG code or a mine grid, never both, and either is taken away again") {
  const auto edit = [&](const SiteEdit& what) {
    store.write([&](Transaction& t) { edit_site(t, site.id, what); });
    return store.read([&](const Snapshot& s) { return find_site(s, site.id).value(); });
  };
  const MineGrid grid{
      .site_origin_m = {1.5, 2.0, 3.0}, .grid_origin_m = {1e4, 2e4, 0.1}, .rotation_rad = 0.3, .scale = 0.9996};
  const Site gridded = edit({.mine_grid = grid});
  REQUIRE(gridded.mine_grid);
  CHECK(gridded.mine_grid->site_origin_m == grid.site_origin_m);
  CHECK(gridded.mine_grid->grid_origin_m == grid.grid_origin_m);
  CHECK(gridded.mine_grid->rotation_rad == grid.rotation_rad);
  CHECK(gridded.mine_grid->scale == grid.scale);
  CHECK(output_frame(gridded).grid->scale == grid.scale);
  CHECK_THROWS_AS(edit({.epsg = 25833}), InvalidInput);
  const Site mapped = edit({.epsg = 25833, .mine_grid = std::optional<MineGrid>()});
  CHECK(mapped.epsg == 25833);
  CHECK_FALSE(mapped.mine_grid);
  CHECK_THROWS_AS(edit({.mine_grid = grid}), InvalidInput);
  CHECK_FALSE(edit({.epsg = std::optional<int>()}).epsg);
  CHECK_THROWS_AS(edit({.mine_grid = MineGrid{.scale = 1000.0}}), InvalidInput);
}

TEST_CASE_FIXTURE(StoreFixture, "the origin of a site with scans cannot be moved") {
  SiteEdit edit;
  edit.origin_m = Eigen::Vector3d(1.0, 2.0, 3.0);
  store.write([&](Transaction& t) { edit_site(t, site.id, edit); });
  add_scan(store, sensor, {.captured_at = at_second(0)});
  edit.origin_m = Eigen::Vector3d(4.0, 5.0, 6.0);
  CHECK_THROWS_AS(store.write([&](Transaction& t) { edit_site(t, site.id, edit); }), Conflict);
}

TEST_CASE_FIXTURE(StoreFixture, "a site is deleted only when its sensors are") {
  CHECK_THROWS_AS(store.write([&](Transaction& t) { delete_site(t, site.id); }), Conflict);
  store.write([&](Transaction& t) { delete_sensor(t, sensor.id); });
  store.write([&](Transaction& t) { delete_site(t, site.id); });
  CHECK_FALSE(store.read([&](const Snapshot& s) { return find_site(s, site.id).has_value(); }));
}

TEST_CASE_FIXTURE(StoreFixture, "the id of a deleted site is not used again") {
  const Site last = add_site(store, "yard");
  store.write([&](Transaction& t) { delete_site(t, last.id); });
  CHECK(add_site(store, "yard").id > last.id);
}

TEST_CASE_FIXTURE(StoreFixture, "what is asked of a site that does not exist is not found") {
  const SiteId nobody{99};
  CHECK_THROWS_AS(store.write([&](Transaction& t) { edit_site(t, nobody, {}); }), NotFound);
  CHECK_THROWS_AS(store.write([&](Transaction& t) { delete_site(t, nobody); }), NotFound);
}

TEST_CASE_FIXTURE(StoreFixture, "a list of sites goes on where its page ended, whatever was added meanwhile") {
  add_site(store, "yard");
  add_site(store, "tunnel");
  const auto list = [&](const PageRequest& page) {
    return store.read([&](const Snapshot& s) { return list_sites(s, page); });
  };
  const Page<Site> first = list({.limit = 2, .cursor = std::nullopt});
  REQUIRE(first.items.size() == 2);
  REQUIRE(first.next.has_value());
  add_site(store, "roof");
  const Page<Site> second = list({.limit = 2, .cursor = first.next});
  REQUIRE(second.items.size() == 2);
  CHECK(second.items[0].name == "tunnel");
  CHECK(second.items[1].name == "roof");
  CHECK_FALSE(second.next.has_value());
}

}  // namespace
}  // namespace raywatch
