#include "storage/store.hpp"

#include <doctest/doctest.h>

#include <fstream>
#include <memory>
#include <thread>

#include "core/error.hpp"
#include "storage/sqlite.hpp"
#include "storage/sweep.hpp"
#include "tests/storage/store_fixture.hpp"

namespace raywatch {
namespace {

TEST_CASE("a store that was closed opens again with what was in it") {
  const TempDir directory;
  PayloadRef ref;
  {
    Store store(options_for(directory.path()));
    const Sensor sensor = add_sensor(store, "door", add_site(store, "hall").id);
    ref = add_scan_with_points(store, sensor, {at_second(0)}, cloud_of(100, 1)).payload;
  }
  CHECK_FALSE(std::filesystem::exists(directory / "raywatch.db-wal"));
  Store store(options_for(directory.path()));
  CHECK_FALSE(store.recovered_from_unclean_stop());
  CHECK(store.open_report().swept_payloads == 0);
  CHECK(store.read([](const Snapshot& s) { return find_site(s, "hall").has_value(); }));
  CHECK(same_bits(store.payloads().scan_points(ref), cloud_of(100, 1)));
}

TEST_CASE("a data directory is made with all its parents") {
  const TempDir directory;
  Store store(options_for(directory / "a/b/c"));
  CHECK(std::filesystem::exists(directory / "a/b/c/raywatch.db"));
}

TEST_CASE("a second store in the same directory is refused and names who holds it") {
  const TempDir directory;
  auto store = std::make_unique<Store>(options_for(directory.path()));
  try {
    Store second(options_for(directory.path()));
    FAIL("the lock did not hold");
  } catch (const StorageError& error) {
    CHECK(std::string(error.what()).find(std::to_string(getpid())) != std::string::npos);
  }
  store.reset();
  Store third(options_for(directory.path()));
  CHECK_FALSE(third.recovered_from_unclean_stop());
}

TEST_CASE("the settings that the store promises are those of its files") {
  const TempDir directory;
  PayloadRef ref;
  {
    Store store(options_for(directory.path()));
    ref = store.payloads().put_scan(SiteId{1}, at_second(0), cloud_of(5, 1), empty_panorama());
    for (const std::filesystem::path& file : {directory / "raywatch.db", directory / ref.file}) {
      Database database(file, Database::Access::read_only);
      CHECK(database.find<std::string>("PRAGMA journal_mode") == "wal");
      CHECK(database.find<int>("PRAGMA auto_vacuum") == 2);
      CHECK(database.find<int>("PRAGMA user_version").value() > 0);
    }
  }
}

TEST_CASE_FIXTURE(StoreFixture, "a write that throws leaves nothing behind") {
  const auto write = [&] {
    store.write([&](Transaction& t) {
      Site other;
      other.name = "yard";
      insert_site(t, other, at_second(0));
      insert_site(t, other, at_second(0));
    });
  };
  CHECK_THROWS_AS(write(), Conflict);
  CHECK_FALSE(store.read([](const Snapshot& s) { return find_site(s, "yard").has_value(); }));
}

TEST_CASE_FIXTURE(StoreFixture, "a snapshot does not see what is committed while it lasts") {
  store.read([&](const Snapshot& s) {
    const std::size_t before = list_sites(s, {}).items.size();
    std::jthread([&] { add_site(store, "yard"); }).join();
    CHECK(list_sites(s, {}).items.size() == before);
  });
  CHECK(store.read([](const Snapshot& s) { return list_sites(s, {}).items.size(); }) == 2);
}

TEST_CASE_FIXTURE(StoreFixture, "readers and writers work at the same time without an error") {
  std::jthread writer([&] {
    for (int i = 0; i < 50; ++i) {
      add_scan_with_points(store, sensor, {at_second(i)}, cloud_of(200, static_cast<std::uint32_t>(i)));
    }
  });
  std::vector<std::jthread> readers;
  for (int r = 0; r < 3; ++r) {
    readers.emplace_back([&] {
      std::size_t seen = 0;
      while (seen < 50) {
        const auto page = store.read([](const Snapshot& s) { return list_scans(s, {}, {}); });
        REQUIRE(page.items.size() >= seen);
        seen = page.items.size();
        if (seen == 0) continue;
        const ScanRecord& newest = page.items.front();
        REQUIRE(same_bits(store.payloads().scan_points(newest.payload),
                          cloud_of(200, static_cast<std::uint32_t>(seen - 1))));
      }
    });
  }
}

TEST_CASE("payloads without a record, and unfinished uploads, are swept at the opening and counted") {
  const TempDir directory;
  PayloadRef owned, orphan, alone;
  {
    Store store(options_for(directory.path()));
    const Sensor sensor = add_sensor(store, "door", add_site(store, "hall").id);
    owned = add_scan_with_points(store, sensor, {at_second(0)}, cloud_of(100, 1)).payload;
    orphan = store.payloads().put_scan(sensor.site, at_second(0), cloud_of(100, 2), empty_panorama());
    alone = store.payloads().put_comparison(SiteId{77}, at_second(0), {});
  }
  std::filesystem::create_directory(directory / "spool");
  std::ofstream(directory / "spool/upload-1") << "half";
  Store store(options_for(directory.path()));
  CHECK(store.open_report().swept_payloads == 2);
  CHECK(store.open_report().swept_spool_files == 1);
  CHECK(std::filesystem::is_empty(directory / "spool"));
  CHECK_FALSE(std::filesystem::exists(directory / alone.file));
  CHECK_THROWS_AS(store.payloads().scan_points(orphan), NotFound);
  CHECK(same_bits(store.payloads().scan_points(owned), cloud_of(100, 1)));
}

TEST_CASE("payloads whose metadata is missing are not swept: the directory is refused") {
  const TempDir directory;
  PayloadRef ref;
  {
    Store store(options_for(directory.path()));
    ref = store.payloads().put_scan(SiteId{1}, at_second(0), cloud_of(100, 2), empty_panorama());
  }
  std::filesystem::remove(directory / "raywatch.db");
  CHECK_THROWS_AS(Store(options_for(directory.path())), StorageError);
  CHECK(std::filesystem::exists(directory / ref.file));
}

}  // namespace
}  // namespace raywatch
