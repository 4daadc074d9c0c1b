#include <doctest/doctest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <filesystem>

#include "core/error.hpp"
#include "tests/storage/store_fixture.hpp"

namespace raywatch {
namespace {

StoreOptions options_without_room(const std::filesystem::path& data_dir) {
  StoreOptions options = options_for(data_dir);
  options.min_free_bytes = std::uint64_t{1} << 62;
  return options;
}

TEST_CASE("below the reserve nothing new is stored, but what is there can be read, ended and deleted") {
  const TempDir directory;
  ScanRecord scan;
  {
    Store store(options_for(directory.path()));
    const Sensor sensor = add_sensor(store, "door", add_site(store, "hall").id);
    scan = add_scan_with_points(store, sensor, {at_second(0)}, cloud_of(100, 1));
    add_comparison(store, scan.id);
  }
  {
    Store store(options_without_room(directory.path()));
    CHECK_THROWS_AS(add_site(store, "yard"), DiskFull);
    CHECK_THROWS_AS(add_comparison(store, scan.id), DiskFull);
    CHECK_THROWS_AS(store.payloads().put_scan(scan.site, at_second(1), cloud_of(5, 2), empty_panorama()), DiskFull);
    CHECK_THROWS_AS(store.payloads().put_comparison(scan.site, at_second(1), {}), DiskFull);
    CHECK(same_bits(store.payloads().scan_points(scan.payload), cloud_of(100, 1)));

    const Job job = store.write([&](Transaction& t) { return start_job(t, scan.site).value(); });
    CHECK_THROWS_AS(store.write([&](Transaction& t) { finish_job(t, job, {}, at_second(2)); }), DiskFull);
    store.write([&](Transaction& t) { requeue_job(t, job); });
    const auto payloads = store.write([&](Transaction& t) { return delete_scan(t, scan.id); });
    for (const PayloadRef& ref : payloads) store.payloads().remove(ref);
    CHECK_THROWS_AS(store.payloads().scan_points(scan.payload), NotFound);
  }
  Store store(options_for(directory.path()));
  add_site(store, "yard");
}

/// What the child below found.
enum Verdict : int { right = 0, no_failure = 1, half_stored = 2, not_recovered = 3, unexpected = 4 };

void limit_file_size(rlim_t bytes) {
  const rlimit limit{bytes, RLIM_INFINITY};
  setrlimit(RLIMIT_FSIZE, &limit);
}

/// Stores scans until a file may not grow any more, then lets it grow again.
Verdict fill_up(const std::filesystem::path& data_dir) {
  constexpr rlim_t kSmall_bytes = 2u << 20;
  Store store(options_for(data_dir));
  const Sensor sensor = add_sensor(store, "door", add_site(store, "hall").id);
  limit_file_size(kSmall_bytes);
  std::int64_t stored = 0;
  bool failed = false;
  while (!failed && stored < 100) {
    try {
      add_scan_with_points(store, sensor, {at_second(stored)}, cloud_of(20'000, static_cast<std::uint32_t>(stored)));
      ++stored;
    } catch (const DiskFull&) {
      failed = true;
    }
  }
  limit_file_size(RLIM_INFINITY);
  if (!failed) return no_failure;
  add_scan_with_points(store, sensor, {at_second(stored)}, cloud_of(20'000, static_cast<std::uint32_t>(stored)));
  const auto scans = store.read([](const Snapshot& s) { return list_scans(s, {}, {}); }).items;
  if (scans.size() != static_cast<std::size_t>(stored) + 1) return half_stored;
  for (std::size_t i = 0; i < scans.size(); ++i) {
    const auto seed = static_cast<std::uint32_t>(stored) - static_cast<std::uint32_t>(i);
    if (!same_bits(store.payloads().scan_points(scans[i].payload), cloud_of(20'000, seed))) return not_recovered;
  }
  return right;
}

TEST_CASE("a write that the disk refuses in its middle is rolled back, and later writes work") {
  const TempDir directory;
  const pid_t child = fork();
  REQUIRE(child >= 0);
  if (child == 0) {
    std::signal(SIGXFSZ, SIG_IGN);
    int verdict = unexpected;
    try {
      verdict = fill_up(directory.path());
    } catch (const std::exception& error) {
      std::fprintf(stderr, "%s\n", error.what());
    }
    _exit(verdict);
  }
  int status = 0;
  REQUIRE(waitpid(child, &status, 0) == child);
  REQUIRE(WIFEXITED(status));
  CHECK(WEXITSTATUS(status) == right);
}

}  // namespace
}  // namespace raywatch
