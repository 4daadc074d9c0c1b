#include <tuple>

#include "storage/columns.hpp"
#include "storage/comparison_rows.hpp"
#include "storage/comparisons.hpp"
#include "storage/scans.hpp"
#include "storage/snapshot.hpp"

namespace raywatch {
namespace {

/// A job that was started more often than this without an end is taken for what stops the program.
constexpr int kMostJobAttempts = 5;

const std::string kSelectJobs = "SELECT id, comparison, scan, site, attempts FROM jobs ";

Job read_job(Statement& row) {
  Job job;
  job.id = row.take<JobId>();
  job.comparison = row.take<ComparisonId>();
  job.scan = row.take<ScanId>();
  job.site = row.take<SiteId>();
  job.attempts = row.take<int>();
  return job;
}

void set_states(Transaction& transaction, const Job& job, ComparisonState state, std::string_view failure = {}) {
  set_comparison_state(transaction, job.comparison, state, failure);
  update_scan_state(transaction, job.scan);
}

/// Takes a started job out of the queue; false if it is not there or not started.
bool take_out(Transaction& transaction, const Job& job) {
  Database& database = database_of(transaction);
  database.run("DELETE FROM jobs WHERE id = ? AND started = 1", job.id);
  return database.changed_rows() > 0;
}

void make_ready(Transaction& transaction, const Job& job, int attempts) {
  database_of(transaction).run("UPDATE jobs SET started = 0, attempts = ? WHERE id = ?", attempts, job.id);
  set_states(transaction, job, ComparisonState::queued);
}

void insert_priors(Transaction& transaction, ComparisonId comparison, const std::vector<ComparisonPrior>& priors) {
  std::int64_t place = 0;
  for (const ComparisonPrior& prior : priors) {
    database_of(transaction)
        .run("INSERT INTO comparison_priors VALUES (?, ?, ?, ?, ?, ?, ?)", comparison, place++, prior.scan,
             prior.vantage, prior.overlap, prior.added, prior.removed);
  }
}

void insert_candidates(Transaction& transaction, ComparisonId comparison,
                       const std::vector<ComparisonCandidate>& candidates) {
  std::int64_t place = 0;
  for (const ComparisonCandidate& candidate : candidates) {
    database_of(transaction)
        .run("INSERT INTO comparison_candidates VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?)", comparison, place++,
             candidate.scan, candidate.vantage, candidate.distance_m, candidate.age, candidate.overlap, candidate.gain,
             candidate.chosen, candidate.reason);
  }
}

void update_result(Transaction& transaction, ComparisonId comparison, const ComparisonResult& result, Time now) {
  database_of(transaction)
      .run(
          "UPDATE comparisons SET counts = ?, testable = ?, changes = ?, timings_ms = ?, warnings = ?, payload_file = "
          "?, "
          "payload_key = ?, stored_bytes = ?, finished_at = ? WHERE id = ?",
          counts_json(result.counts), result.testable, result.changes.size(), timings_json(result.timings_ms),
          texts_json(result.warnings), result.payload.file, result.payload.key, result.stored_bytes, now, comparison);
}

void end_without_result(Transaction& transaction, const Job& job, std::string_view why, std::optional<Time> when) {
  if (!take_out(transaction, job)) return;
  database_of(transaction).run("UPDATE comparisons SET finished_at = ? WHERE id = ?", when, job.comparison);
  set_states(transaction, job, ComparisonState::failed, why);
}

/// A job that may start, and its place in the order of its site.
struct Turn {
  Job job;
  Time captured_at;
  auto place() const { return std::tie(captured_at, job.id); }
};

/// The first of the jobs that follow one another: those that are watched, or all others. Nothing while another one of
/// them runs, nor before the earlier jobs of its scan have ended if it is watched: one of them finds the scan's pose.
std::optional<Turn> next_turn(Database& database, SiteId site, Watching watching) {
  Statement running(database,
                    "SELECT 1 FROM jobs INDEXED BY jobs_by_started JOIN comparisons ON comparisons.id = comparison "
                    "WHERE started = 1 AND jobs.site = ? AND watching = ?");
  const bool is_watched = watching == Watching::yes;
  if (running.bind(site, is_watched).next()) return std::nullopt;
  Statement row(database,
                "SELECT jobs.id, comparison, jobs.scan, jobs.site, attempts, jobs.captured_at, EXISTS(SELECT 1 FROM "
                "jobs AS earlier INDEXED BY jobs_by_turn WHERE "
                "earlier.site = jobs.site AND earlier.started IN (0, 1) AND earlier.captured_at = jobs.captured_at AND "
                "earlier.scan = jobs.scan AND earlier.id < jobs.id) "
                "FROM jobs INDEXED BY jobs_by_turn JOIN comparisons ON comparisons.id = comparison "
                "WHERE jobs.site = ? AND started = 0 AND watching = ? ORDER BY jobs.captured_at, jobs.id LIMIT 1");
  if (!row.bind(site, is_watched).next()) return std::nullopt;
  Turn turn{.job = read_job(row), .captured_at = {}};
  turn.captured_at = row.take<Time>();
  const bool has_earlier = row.take<bool>();
  if (is_watched && has_earlier) return std::nullopt;
  return turn;
}

}  // namespace

std::optional<Job> start_job(Transaction& transaction, SiteId site) {
  Database& database = database_of(transaction);
  std::optional<Turn> first = next_turn(database, site, Watching::no);
  const std::optional<Turn> watched = next_turn(database, site, Watching::yes);
  if (watched && (!first || watched->place() < first->place())) first = watched;
  if (!first) return std::nullopt;
  Job job = first->job;
  ++job.attempts;
  database.run("UPDATE jobs SET started = 1, attempts = ? WHERE id = ?", job.attempts, job.id);
  set_states(transaction, job, ComparisonState::running);
  return job;
}

std::vector<SiteId> sites_with_jobs(const Snapshot& snapshot) {
  Statement rows(database_of(snapshot),
                 "SELECT id FROM sites WHERE EXISTS "
                 "(SELECT 1 FROM jobs INDEXED BY jobs_by_turn WHERE site = sites.id AND started = 0) ORDER BY id");
  std::vector<SiteId> sites;
  while (rows.next()) sites.push_back(rows.take<SiteId>());
  return sites;
}

std::uint64_t unfinished_jobs(const Snapshot& snapshot) {
  return database_of(snapshot).find<std::uint64_t>("SELECT count(*) FROM jobs").value_or(0);
}

std::uint64_t requeue_started_jobs(Transaction& transaction) {
  std::vector<Job> started;
  {
    Statement rows(database_of(transaction), kSelectJobs + "INDEXED BY jobs_by_started WHERE started = 1 ORDER BY id");
    while (rows.next()) started.push_back(read_job(rows));
  }
  std::uint64_t requeued = 0;
  for (const Job& job : started) {
    if (job.attempts > kMostJobAttempts) {
      const std::string why = "the program stopped " + std::to_string(job.attempts) + " times during this comparison";
      end_without_result(transaction, job, why, std::nullopt);
    } else {
      make_ready(transaction, job, job.attempts);
      ++requeued;
    }
  }
  return requeued;
}

std::optional<std::vector<ChangeId>> finish_job(Transaction& transaction, const Job& job,
                                                const ComparisonResult& result, Time now) {
  transaction.impl().require_room_for_records();
  if (!take_out(transaction, job)) return std::nullopt;
  update_result(transaction, job.comparison, result, now);
  insert_priors(transaction, job.comparison, result.priors);
  insert_candidates(transaction, job.comparison, result.candidates);
  if (result.registration) set_registration(transaction, job.scan, *result.registration);
  std::vector<ChangeId> changes =
      insert_changes(transaction, find_comparison(transaction, job.comparison).value(), result.changes);
  set_states(transaction, job, ComparisonState::done);
  return changes;
}

void fail_job(Transaction& transaction, const Job& job, std::string_view why, Time now) {
  end_without_result(transaction, job, why, now);
}

void requeue_job(Transaction& transaction, const Job& job) {
  const auto attempts =
      database_of(transaction).find<int>("SELECT attempts FROM jobs WHERE id = ? AND started = 1", job.id);
  if (attempts) make_ready(transaction, job, *attempts - 1);
}

}  // namespace raywatch
