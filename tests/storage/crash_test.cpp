#include <doctest/doctest.h>
#include <unistd.h>

#include <algorithm>
#include <random>
#include <set>
#include <vector>

#include "storage/sweep.hpp"
#include "tests/storage/killed_child.hpp"
#include "tests/storage/store_fixture.hpp"

namespace raywatch {
namespace {

/// What the child reports after each durable commit.
struct Report {
  enum Kind : std::int32_t { scan, finished } kind;
  std::int32_t number;  ///< of the scan, which decides its points, or of the comparison
};

constexpr std::size_t kPoints = 2000;

PointCloud points_of(std::int32_t number) { return cloud_of(kPoints, static_cast<std::uint32_t>(number)); }

void report(int pipe, Report::Kind kind, std::int64_t number) {
  const Report what{kind, static_cast<std::int32_t>(number)};
  if (write(pipe, &what, sizeof what) != sizeof what) _exit(1);
}

void finish_with_points(Store& store, const Job& job) {
  ComparisonPoints points;
  points.classes.assign(kPoints, PointClass::unchanged);
  points.free.assign(kPoints, 0);
  points.supported.assign(kPoints, 1);
  points.change_of.assign(kPoints, -1);
  ComparisonResult result;
  result.changes = {change_at({0.0, 0.0, 0.0}), change_at({1.0, 1.0, 1.0})};
  result.payload = store.payloads().put_comparison(job.site, at_second(0), points);
  store.write([&](Transaction& t) { finish_job(t, job, result, at_second(1)); });
}

/// Adds scans and compares them until it is killed.
[[noreturn]] void work(const std::filesystem::path& data_dir, std::int32_t number, int pipe) {
  Store store(options_for(data_dir));
  const Site site = store.read([](const Snapshot& s) { return find_site(s, "hall").value(); });
  const Sensor sensor = store.read([](const Snapshot& s) { return find_sensor(s, "door").value(); });
  store.write([](Transaction& t) { requeue_started_jobs(t); });
  for (;; ++number) {
    ScanRecord scan = sketched_scan(sensor, {at_second(number)});
    scan.payload = store.payloads().put_scan(site.id, scan.captured_at, points_of(number), empty_panorama());
    store.write([&](Transaction& t) {
      const ScanRecord stored = insert_scan(t, scan);
      insert_comparison(t, stored.id, PreviousReference{}, CompareParameters{}, at_second(0));
    });
    report(pipe, Report::scan, number);
    const auto job = store.write([&](Transaction& t) { return start_job(t, site.id); });
    if (!job) continue;
    finish_with_points(store, *job);
    report(pipe, Report::finished, job->comparison.value);
  }
}

/// Everything that was ever reported must be there, whole and once; nothing may lie around.
void check_store(Store& store, const std::set<std::int32_t>& scans, const std::set<std::int32_t>& finished) {
  const auto stored =
      store.read([](const Snapshot& s) { return list_scans(s, {}, {.limit = 1000, .cursor = std::nullopt}); }).items;
  std::set<std::int32_t> numbers;
  std::size_t payloads = stored.size();
  for (const ScanRecord& scan : stored) {
    const auto number = static_cast<std::int32_t>((scan.captured_at - at_second(0)) / std::chrono::seconds(1));
    numbers.insert(number);
    CHECK(same_bits(store.payloads().scan_points(scan.payload), points_of(number)));
  }
  CHECK(std::includes(numbers.begin(), numbers.end(), scans.begin(), scans.end()));
  const auto comparisons =
      store.read([](const Snapshot& s) { return list_comparisons(s, {}, {.limit = 1000, .cursor = std::nullopt}); })
          .items;
  CHECK(comparisons.size() == stored.size());
  for (const ComparisonRecord& comparison : comparisons) {
    const bool done = comparison.state == ComparisonState::done;
    CHECK((done || !finished.contains(static_cast<std::int32_t>(comparison.id.value))));
    const auto changes = store.read([&](const Snapshot& s) {
      ChangeFilter filter;
      filter.comparison = comparison.id;
      return list_changes(s, filter, {}).items.size();
    });
    CHECK(changes == (done ? 2u : 0u));
    if (!done) continue;
    ++payloads;
    CHECK(store.payloads().comparison_points(comparison.payload).classes.size() == kPoints);
  }
  CHECK(stored_payloads(store) == payloads);
}

TEST_CASE("after any kill everything that was reported as durable is there, whole and once") {
  const TempDir directory;
  {
    Store store(options_for(directory.path()));
    add_sensor(store, "door", add_site(store, "hall").id);
  }
  std::mt19937 random(20260101);
  std::set<std::int32_t> scans, finished;
  for (int round = 0; round < 20; ++round) {
    CAPTURE(round);
    const std::int32_t next = 1000 * (round + 1);
    const int reports = std::uniform_int_distribution(0, 12)(random);
    const auto spins = std::uniform_int_distribution<std::uint64_t>(0, 4'000'000)(random);
    const auto work_on = [&](int pipe) { work(directory.path(), next, pipe); };
    for (const Report& one : reports_until_killed<Report>(work_on, {.reports = reports, .spins = spins})) {
      if (one.kind == Report::scan) scans.insert(one.number);
      if (one.kind == Report::finished) CHECK(finished.insert(one.number).second);
    }
    Store store(options_for(directory.path()));
    CHECK(store.open_report().warnings.empty());
    check_store(store, scans, finished);
  }
  CHECK(scans.size() > 20);
}

}  // namespace
}  // namespace raywatch
