#include <doctest/doctest.h>

#include <fstream>
#include <optional>

#include "core/error.hpp"
#include "storage/sqlite.hpp"
#include "storage/sweep.hpp"
#include "tests/storage/store_fixture.hpp"

namespace raywatch {
namespace {

/// A closed store with one scan in each of two months.
struct ClosedStore {
  TempDir directory;
  PayloadRef january, february;
  ClosedStore() {
    Store store(options_for(directory.path()));
    const Sensor sensor = add_sensor(store, "door", add_site(store, "hall").id);
    january = add_scan_with_points(store, sensor, {at_second(0)}, cloud_of(20'000, 1)).payload;
    february = add_scan_with_points(store, sensor, {at_second(40 * 86'400)}, cloud_of(20'000, 2)).payload;
  }

  void flip(const std::string& file, std::streamoff place) const {
    std::fstream bytes(directory / file, std::ios::in | std::ios::out | std::ios::binary);
    bytes.seekg(place);
    const int byte = bytes.get();
    bytes.seekp(place);
    bytes.put(static_cast<char>(byte ^ 0x20));
  }
};

TEST_CASE("a scan whose file was cut short is corrupt; the store opens and its other scans are whole") {
  const ClosedStore closed;
  const auto size = std::filesystem::file_size(closed.directory / closed.january.file);
  std::filesystem::resize_file(closed.directory / closed.january.file, size / 2);
  Store store(options_for(closed.directory.path()));
  CHECK(store.open_report().warnings.size() == 1);
  CHECK_THROWS_AS(store.payloads().scan_points(closed.january), CorruptData);
  CHECK(same_bits(store.payloads().scan_points(closed.february), cloud_of(20'000, 2)));
}

TEST_CASE("a month whose file is damaged goes on in another file") {
  const ClosedStore closed;
  std::ofstream(closed.directory / closed.january.file, std::ios::binary) << std::string(40'000, 'x');
  Store store(options_for(closed.directory.path()));
  for (std::uint32_t seed = 5; seed < 8; ++seed) {
    const PayloadRef ref = store.payloads().put_scan(SiteId{1}, at_second(0), cloud_of(100, seed), empty_panorama());
    CHECK(ref.file == "payload/1/2026-01.2.db");
    CHECK(same_bits(store.payloads().scan_points(ref), cloud_of(100, seed)));
  }
  CHECK_THROWS_AS(store.payloads().scan_points(closed.january), CorruptData);
}

TEST_CASE("the record of a payload that was lost never leads to another's points") {
  for (const bool remove : {true, false}) {
    CAPTURE(remove);
    const ClosedStore closed;
    const std::filesystem::path file = closed.directory / closed.january.file;
    if (remove) {
      std::filesystem::remove(file);
    } else {
      std::filesystem::resize_file(file, 0);
    }
    Store store(options_for(closed.directory.path()));
    REQUIRE(store.open_report().warnings.size() == 1);
    CHECK(store.open_report().warnings[0].find("1 payloads are missing") != std::string::npos);
    const PayloadRef other = store.payloads().put_scan(SiteId{1}, at_second(0), cloud_of(100, 5), empty_panorama());
    CHECK(other.file == closed.january.file);
    CHECK_THROWS_AS(store.payloads().scan_points(closed.january), NotFound);
    CHECK(same_bits(store.payloads().scan_points(other), cloud_of(100, 5)));
  }
}

TEST_CASE("a flipped byte in a payload file never gives other points") {
  const ClosedStore closed;
  const auto size = static_cast<std::streamoff>(std::filesystem::file_size(closed.directory / closed.january.file));
  int corrupt = 0;
  for (std::streamoff place = 16'384; place < size; place += size / 23) {
    CAPTURE(place);
    closed.flip(closed.january.file, place);
    {
      Store store(options_for(closed.directory.path()));
      std::optional<PointCloud> points;
      try {
        points = store.payloads().scan_points(closed.january);
      } catch (const CorruptData&) {
        ++corrupt;
      }
      // A byte of free space may change without harm.
      if (points) CHECK(same_bits(*points, cloud_of(20'000, 1)));
      CHECK(same_bits(store.payloads().scan_points(closed.february), cloud_of(20'000, 2)));
    }
    closed.flip(closed.january.file, place);
  }
  CHECK(corrupt > 10);
}

TEST_CASE("after an unclean stop damaged metadata is refused with the advice to restore it") {
  const ClosedStore closed;
  std::ofstream(closed.directory / "raywatch.running").put(' ');
  const auto size = std::filesystem::file_size(closed.directory / "raywatch.db");
  std::filesystem::resize_file(closed.directory / "raywatch.db", size - 4096);
  CHECK_THROWS_AS(Store(options_for(closed.directory.path())), CorruptData);
  { std::ofstream(closed.directory / "raywatch.db", std::ios::binary) << std::string(8192, 'x'); }
  CHECK_THROWS_AS(Store(options_for(closed.directory.path())), CorruptData);
}

TEST_CASE("after an unclean stop sound metadata is checked and opened") {
  const ClosedStore closed;
  std::ofstream(closed.directory / "raywatch.running").put(' ');
  {
    Store store(options_for(closed.directory.path()));
    CHECK(store.recovered_from_unclean_stop());
    CHECK(same_bits(store.payloads().scan_points(closed.january), cloud_of(20'000, 1)));
  }
  Store store(options_for(closed.directory.path()));
  CHECK_FALSE(store.recovered_from_unclean_stop());
}

}  // namespace
}  // namespace raywatch
