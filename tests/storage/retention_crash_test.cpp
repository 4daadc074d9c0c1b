#include <doctest/doctest.h>
#include <unistd.h>

#include <random>

#include "storage/retention.hpp"
#include "storage/sweep.hpp"
#include "tests/storage/killed_child.hpp"
#include "tests/storage/store_fixture.hpp"

namespace raywatch {
namespace {

constexpr int kScans = 60;
constexpr std::size_t kPoints = 3000;

Time taken_at(int number) { return at_second(1000 + number); }

/// Deletes all scans, two at a time, and says so after each, until it is killed.
[[noreturn]] void delete_all(const std::filesystem::path& data_dir, int pipe) {
  Store store(options_for(data_dir));
  const Site site = store.read([](const Snapshot& s) { return find_site(s, "hall").value(); });
  const RetentionState state{.in_force = {.max_age_days = 1}, .now = at_second(1'000'000)};
  for (;;) {
    const RetentionPlan plan = store.read([&](const Snapshot& s) { return plan_retention(s, site.id, state, 2); });
    const DeletedScans deleted =
        store.write([&](Transaction& t) { return delete_expired(t, site.id, plan.expired, at_second(1'000'000)); });
    for (const PayloadRef& payload : deleted.payloads) store.payloads().remove(payload);
    store.give_back_space(deleted.payloads);
    for (const ScanId scan : deleted.scans) {
      if (write(pipe, &scan.value, sizeof scan.value) != sizeof scan.value) _exit(1);
    }
    if (plan.expired.empty()) pause();
  }
}

TEST_CASE("after a kill in the middle of retention each scan is there as a whole, or gone as a whole and recorded") {
  const TempDir directory;
  {
    Store store(options_for(directory.path()));
    const Sensor sensor = add_sensor(store, "door", add_site(store, "hall").id);
    for (int i = 0; i < kScans; ++i) {
      add_scan_with_points(store, sensor, {taken_at(i)}, cloud_of(kPoints, static_cast<std::uint32_t>(i)));
    }
  }
  std::mt19937 random(20261122);
  std::size_t left = kScans;
  for (int round = 0; round < 10; ++round) {
    CAPTURE(round);
    const int reports = std::uniform_int_distribution(1, 5)(random);
    const auto spins = std::uniform_int_distribution<std::uint64_t>(0, 3'000'000)(random);
    const std::vector<std::int64_t> deleted = reports_until_killed<std::int64_t>(
        [&](int pipe) { delete_all(directory.path(), pipe); }, {.reports = reports, .spins = spins});
    Store store(options_for(directory.path()));
    CHECK(store.open_report().warnings.empty());
    const auto scans =
        store.read([](const Snapshot& s) { return list_scans(s, {}, {.limit = 1000, .cursor = {}}); }).items;
    CHECK(scans.size() <= left);
    left = scans.size();
    for (const std::int64_t gone : deleted) {
      CHECK_FALSE(store.read([&](const Snapshot& s) { return find_scan(s, ScanId{gone}); }));
    }
    for (const ScanRecord& scan : scans) {
      const auto number = static_cast<std::uint32_t>((scan.captured_at - taken_at(0)) / std::chrono::seconds(1));
      CHECK(same_bits(store.payloads().scan_points(scan.payload), cloud_of(kPoints, number)));
    }
    const std::size_t records =
        store.read([](const Snapshot& s) { return list_deletions(s, {}, {.limit = 1000, .cursor = {}}); }).items.size();
    CHECK(records == kScans - scans.size());
    if (!scans.empty()) CHECK(stored_payloads(store) == scans.size());
  }
  CHECK(left < kScans);
}

}  // namespace
}  // namespace raywatch
