#include <doctest/doctest.h>

#include <fstream>
#include <thread>

#include "core/error.hpp"
#include "storage/sweep.hpp"
#include "tests/storage/store_fixture.hpp"

namespace raywatch {
namespace {

TEST_CASE_FIXTURE(StoreFixture, "a backup made during writes and deletions opens as a store with every scan whole") {
  const auto seed_of = [](const ScanRecord& scan) {
    return static_cast<std::uint32_t>((scan.captured_at - at_second(0)) / std::chrono::seconds(1));
  };
  const auto add = [&](std::int64_t i) {
    return add_scan_with_points(store, sensor, {at_second(i)}, cloud_of(3000, static_cast<std::uint32_t>(i)));
  };
  std::vector<ScanRecord> before;
  for (std::int64_t i = 0; i < 20; ++i) before.push_back(add(i));
  const TempDir target;
  {
    std::jthread busy([&](const std::stop_token& stop) {
      for (std::int64_t i = 20; !stop.stop_requested(); ++i) {
        add(i);
        if (static_cast<std::size_t>(i - 20) >= before.size()) continue;
        const ScanId old = before[static_cast<std::size_t>(i - 20)].id;
        for (const PayloadRef& ref : store.write([&](Transaction& t) { return delete_scan(t, old); })) {
          store.payloads().remove(ref);
        }
      }
    });
    store.backup(target / "copy");
  }
  Store copy(options_for(target / "copy"));
  CHECK_FALSE(copy.recovered_from_unclean_stop());
  const auto scans =
      copy.read([](const Snapshot& s) { return list_scans(s, {}, {.limit = 1000, .cursor = std::nullopt}); }).items;
  CHECK(scans.size() >= 20);
  for (const ScanRecord& scan : scans) {
    CHECK(same_bits(copy.payloads().scan_points(scan.payload), cloud_of(3000, seed_of(scan))));
  }
  add_scan_with_points(copy, sensor, {at_second(-1)}, cloud_of(10, 1));
}

TEST_CASE_FIXTURE(StoreFixture, "payloads that were to be deleted during a backup are gone after it") {
  const ScanRecord scan = add_scan_with_points(store, sensor, {at_second(0)}, cloud_of(10, 1));
  const TempDir target;
  store.backup(target / "one");
  for (const PayloadRef& ref : store.write([&](Transaction& t) { return delete_scan(t, scan.id); })) {
    store.payloads().remove(ref);
  }
  CHECK_THROWS_AS(store.payloads().scan_points(scan.payload), NotFound);
  Store copy(options_for(target / "one"));
  CHECK(same_bits(copy.payloads().scan_points(scan.payload), cloud_of(10, 1)));
}

TEST_CASE_FIXTURE(StoreFixture, "a backup goes into an empty or a new directory only") {
  const TempDir target;
  store.backup(target.path());
  CHECK_THROWS_AS(store.backup(target.path()), InvalidInput);
  std::ofstream(target / "file") << "x";
  CHECK_THROWS_AS(store.backup(target / "file"), InvalidInput);
  CHECK_THROWS_AS(store.backup({}), InvalidInput);
  CHECK_THROWS_AS(store.backup("/proc/copy"), InvalidInput);
}

TEST_CASE_FIXTURE(StoreFixture, "a backup does not go into the data directory, by whatever way") {
  const TempDir elsewhere;
  std::filesystem::create_directory_symlink(store.data_dir(), elsewhere / "link");
  for (const std::filesystem::path& target :
       {store.data_dir(), store.data_dir() / "copy", store.data_dir() / "deep" / "copy", elsewhere / "link" / "copy",
        store.data_dir() / ".." / store.data_dir().filename() / "copy"}) {
    CAPTURE(target.string());
    CHECK_THROWS_WITH_AS(store.backup(target), doctest::Contains("must not lie in the data directory"), InvalidInput);
  }
  CHECK_FALSE(std::filesystem::exists(store.data_dir() / "copy"));
  store.backup(store.data_dir().string() + "-copy");  // its name only begins like it
  std::filesystem::remove_all(store.data_dir().string() + "-copy");
}

TEST_CASE("a backup without room leaves its directory empty") {
  const TempDir directory, target;
  StoreOptions options = options_for(directory.path());
  options.min_free_bytes = std::uint64_t{1} << 62;
  Store store(options);
  CHECK_THROWS_AS(store.backup(target.path()), DiskFull);
  CHECK(std::filesystem::is_empty(target.path()));
}

}  // namespace
}  // namespace raywatch
