#include <doctest/doctest.h>

#include "storage/comparisons.hpp"
#include "storage/scans.hpp"
#include "tests/storage/store_fixture.hpp"

namespace raywatch {
namespace {

struct JobFixture : StoreFixture {
  std::optional<Job> start() {
    return store.write([&](Transaction& t) { return start_job(t, site.id); });
  }
  void finish(const Job& job) {
    store.write([&](Transaction& t) { finish_job(t, job, {}, at_second(100)); });
  }
  ComparisonId start_and_finish() {
    const Job job = start().value();
    finish(job);
    return job.comparison;
  }
  std::uint64_t requeue_started() {
    return store.write([](Transaction& t) { return requeue_started_jobs(t); });
  }
  ScanRecord scan(ScanId id) {
    return store.read([&](const Snapshot& s) { return find_scan(s, id).value(); });
  }
  ComparisonRecord comparison(ComparisonId id) {
    return store.read([&](const Snapshot& s) { return find_comparison(s, id).value(); });
  }
};

TEST_CASE_FIXTURE(JobFixture, "jobs of a site start in the order of capture, then of arrival") {
  const ScanRecord late = add_scan(store, sensor, {at_second(5)});
  const ScanRecord early = add_scan(store, sensor, {at_second(1)});
  const ComparisonId of_late = add_comparison(store, late.id).id;
  const ComparisonId of_early = add_comparison(store, early.id).id;
  const ComparisonId again = add_comparison(store, early.id).id;
  CHECK(start_and_finish() == of_early);
  CHECK(start_and_finish() == again);
  CHECK(start_and_finish() == of_late);
  CHECK_FALSE(start().has_value());
}

TEST_CASE_FIXTURE(JobFixture, "watched comparisons follow one another, beside all others of later scans") {
  const ScanId first = add_scan(store, sensor, {at_second(1)}).id;
  const ScanId second = add_scan(store, sensor, {at_second(2)}).id;
  for (const ScanId id : {first, second}) {
    add_comparison(store, id);
    add_comparison(store, id, Watching::yes);
  }
  const Job of_first = start().value();
  CHECK(of_first.scan == first);
  CHECK_FALSE(start().has_value());  // the watched one of this scan needs its pose, and the next is not its turn
  finish(of_first);
  const Job watched = start().value();
  CHECK(watched.scan == first);
  CHECK(comparison(watched.comparison).watching);
  const Job of_second = start().value();
  CHECK(of_second.scan == second);
  CHECK_FALSE(comparison(of_second.comparison).watching);
  finish(of_second);
  CHECK_FALSE(start().has_value());
  finish(watched);
  const Job last = start().value();
  CHECK(last.scan == second);
  CHECK(comparison(last.comparison).watching);
}

TEST_CASE_FIXTURE(JobFixture, "a scan is queued, comparing, then compared") {
  const ScanId id = add_scan(store, sensor, {at_second(0)}).id;
  const ComparisonId comparison_id = add_comparison(store, id).id;
  CHECK(scan(id).state == ScanState::queued);
  const Job job = start().value();
  CHECK(job.attempts == 1);
  CHECK(scan(id).state == ScanState::comparing);
  CHECK(comparison(comparison_id).state == ComparisonState::running);
  store.write([&](Transaction& t) { finish_job(t, job, {}, at_second(1)); });
  CHECK(scan(id).state == ScanState::compared);
  CHECK(comparison(comparison_id).state == ComparisonState::done);
}

TEST_CASE_FIXTURE(JobFixture, "a job is finished once, however often its end is told") {
  add_comparison(store, add_scan(store, sensor, {at_second(0)}).id);
  const Job job = start().value();
  ComparisonResult result;
  result.changes = {change_at({0.0, 0.0, 0.0})};
  const auto finish = [&] {
    return store.write([&](Transaction& t) { return finish_job(t, job, result, at_second(1)); });
  };
  CHECK(finish());
  CHECK_FALSE(finish());
  store.write([&](Transaction& t) { fail_job(t, job, "late", at_second(2)); });
  store.write([&](Transaction& t) { requeue_job(t, job); });
  CHECK(comparison(job.comparison).state == ComparisonState::done);
  CHECK(store.read([](const Snapshot& s) { return list_changes(s, {}, {}); }).items.size() == 1);
  CHECK(store.read([](const Snapshot& s) { return unfinished_jobs(s); }) == 0);
}

TEST_CASE_FIXTURE(JobFixture, "a job that was put back cannot be finished by who had it before") {
  add_comparison(store, add_scan(store, sensor, {at_second(0)}).id);
  const Job job = start().value();
  store.write([&](Transaction& t) { requeue_job(t, job); });
  CHECK_FALSE(store.write([&](Transaction& t) { return finish_job(t, job, {}, at_second(1)); }));
  CHECK(scan(job.scan).state == ScanState::queued);
  CHECK(start()->attempts == 1);
}

TEST_CASE_FIXTURE(JobFixture, "a scan fails with its only comparison, and stays compared when another one was done") {
  const ScanId id = add_scan(store, sensor, {at_second(0)}).id;
  add_comparison(store, id);
  const auto fail_next = [&] {
    const Job job = start().value();
    store.write([&](Transaction& t) { fail_job(t, job, "no memory", at_second(1)); });
    return job;
  };
  const Job failed = fail_next();
  CHECK(scan(id).state == ScanState::failed);
  CHECK(scan(id).failure == "no memory");
  CHECK(comparison(failed.comparison).failure == "no memory");
  add_comparison(store, id);
  CHECK(scan(id).state == ScanState::queued);
  CHECK(scan(id).failure.empty());
  finish_next_job(store, site.id);
  add_comparison(store, id);
  CHECK(scan(id).state == ScanState::compared);
  fail_next();
  CHECK(scan(id).state == ScanState::compared);
}

TEST_CASE_FIXTURE(JobFixture, "started jobs are ready again after a stop") {
  const ScanId id = add_scan(store, sensor, {at_second(0)}).id;
  add_comparison(store, id);
  start();
  CHECK(store.read([](const Snapshot& s) { return sites_with_jobs(s); }).empty());
  CHECK(requeue_started() == 1);
  CHECK(scan(id).state == ScanState::queued);
  CHECK(store.read([](const Snapshot& s) { return sites_with_jobs(s); }) == std::vector{site.id});
  CHECK(start()->attempts == 2);
}

TEST_CASE_FIXTURE(JobFixture, "a job that was under way at six stops is taken for their cause and fails") {
  const ScanId id = add_scan(store, sensor, {at_second(0)}).id;
  add_comparison(store, id);
  for (int stop = 1; stop <= 5; ++stop) {
    start();
    CHECK(requeue_started() == 1);
  }
  start();
  CHECK(requeue_started() == 0);
  CHECK(scan(id).state == ScanState::failed);
  CHECK(scan(id).failure.find("6 times") != std::string::npos);
  CHECK_FALSE(start().has_value());
}

TEST_CASE_FIXTURE(JobFixture, "jobs of sites are apart") {
  const Site other = add_site(store, "yard");
  const Sensor mast = add_sensor(store, "mast", other.id);
  add_comparison(store, add_scan(store, mast, {at_second(0)}).id);
  CHECK_FALSE(start().has_value());
  CHECK(store.read([](const Snapshot& s) { return sites_with_jobs(s); }) == std::vector{other.id});
  CHECK(store.read([](const Snapshot& s) { return unfinished_jobs(s); }) == 1);
}

}  // namespace
}  // namespace raywatch
