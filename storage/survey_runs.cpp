#include "storage/survey_runs.hpp"

#include <array>
#include <limits>

#include "core/names.hpp"
#include "storage/cursor.hpp"
#include "storage/snapshot.hpp"
#include "storage/survey_json.hpp"

namespace raywatch {
namespace {

/// A run that was begun more often than this without an end is taken for what stops the program.
constexpr int kMostRunAttempts = 5;

constexpr std::string_view kRunList = "survey_runs";
constexpr Names<RunState, 8> kRunStates{{{RunState::queued, "queued"},
                                         {RunState::running, "running"},
                                         {RunState::done, "done"},
                                         {RunState::failed, "failed"},
                                         {RunState::no_scans, "no_scans"},
                                         {RunState::refused, "refused"},
                                         {RunState::skipped, "skipped"},
                                         {RunState::cancelled, "cancelled"}}};
const std::string kSelectRuns =
    "SELECT id, site, schedule, due_at, from_at, to_at, definition, state, attempts, why, log, epoch, reference, "
    "survey, created_at, started_at, finished_at FROM survey_runs ";

RunRecord read_run(Statement& row) {
  RunRecord run;
  run.id = row.take<RunId>();
  run.site = row.take<SiteId>();
  run.schedule = row.take<std::optional<ScheduleId>>();
  run.due_at = row.take<Time>();
  run.from = row.take<Time>();
  run.to = row.take<Time>();
  run.definition = definition_from_json(row.take<std::string>());
  run.state = parse_run_state(row.take<std::string>());
  run.attempts = row.take<int>();
  run.why = row.take<std::string>();
  run.log = log_from_json(row.take<std::string>());
  run.epoch = row.take<std::optional<EpochId>>();
  run.reference = row.take<std::optional<EpochId>>();
  run.survey = row.take<std::optional<SurveyId>>();
  run.created_at = row.take<Time>();
  run.started_at = row.take<std::optional<Time>>();
  run.finished_at = row.take<std::optional<Time>>();
  return run;
}

std::vector<RunRecord> read_all(Statement& rows) {
  std::vector<RunRecord> runs;
  while (rows.next()) runs.push_back(read_run(rows));
  return runs;
}

}  // namespace

std::string_view to_string(RunState state) { return name_of(kRunStates, state); }
RunState parse_run_state(std::string_view name) { return value_of(kRunStates, name, "state"); }

RunRecord insert_run(Transaction& transaction, const RunRecord& run, Time now) {
  transaction.impl().require_room_for_records();
  Database& database = database_of(transaction);
  database.run(
      "INSERT INTO survey_runs (site, schedule, due_at, from_at, to_at, definition, state, attempts, why, log, epoch, "
      "reference, survey, created_at, finished_at) VALUES (?, ?, ?, ?, ?, ?, ?, 0, ?, ?, ?, ?, NULL, ?, ?)",
      run.site, run.schedule, run.due_at, run.from, run.to, definition_json(run.definition), to_string(run.state),
      run.why, log_json(run.log), run.epoch, run.reference, now,
      run.state == RunState::queued ? std::nullopt : std::optional(now));
  return find_run(transaction, RunId{database.last_id()}).value();
}

std::optional<RunRecord> find_run(const Snapshot& snapshot, RunId id) {
  Statement row(database_of(snapshot), kSelectRuns + "WHERE id = ?");
  if (!row.bind(id).next()) return std::nullopt;
  return read_run(row);
}

Page<RunRecord> list_runs(const Snapshot& snapshot, const RunFilter& filter, const PageRequest& page) {
  const auto [before] = key_before<1>(page, kRunList, {std::numeric_limits<std::int64_t>::max()});
  const std::string which = filter.schedule ? "INDEXED BY survey_runs_by_schedule WHERE schedule = ? AND "
                            : filter.site   ? "INDEXED BY survey_runs_by_site WHERE site = ? AND "
                                            : "WHERE ";
  Statement rows(database_of(snapshot), kSelectRuns + which + "id < ? ORDER BY id DESC LIMIT ?");
  if (filter.schedule) {
    rows.bind(*filter.schedule);
  } else if (filter.site) {
    rows.bind(*filter.site);
  }
  rows.bind(before, rows_to_read(page));
  return make_page(read_all(rows), page, kRunList, [](const RunRecord& run) { return std::array{run.id.value}; });
}

std::vector<RunRecord> queued_runs(const Snapshot& snapshot) {
  Statement rows(database_of(snapshot),
                 kSelectRuns + "INDEXED BY survey_runs_waiting WHERE state = 'queued' ORDER BY due_at, id");
  return read_all(rows);
}

std::vector<RunRecord> unfinished_runs(const Snapshot& snapshot, SiteId site) {
  std::vector<RunRecord> runs;
  for (const char* which :
       {"survey_runs_waiting WHERE state = 'queued'", "survey_runs_running WHERE state = 'running'"}) {
    Statement rows(database_of(snapshot), kSelectRuns + "INDEXED BY " + which + " AND site = ?");
    rows.bind(site);
    for (RunRecord& run : read_all(rows)) runs.push_back(std::move(run));
  }
  return runs;
}

bool has_useful_run(const Snapshot& snapshot, ScheduleId schedule, Time due_at) {
  return database_of(snapshot)
      .find<int>(
          "SELECT 1 FROM survey_runs INDEXED BY survey_runs_by_due WHERE schedule = ? AND due_at = ? AND "
          "state IN ('queued', 'running', 'done', 'refused', 'cancelled') LIMIT 1",
          schedule, due_at)
      .has_value();
}

std::optional<RunRecord> start_run(Transaction& transaction, RunId id, Time now) {
  Database& database = database_of(transaction);
  database.run(
      "UPDATE survey_runs SET state = 'running', attempts = attempts + 1, started_at = ? WHERE id = ? AND "
      "state = 'queued'",
      now, id);
  if (database.changed_rows() == 0) return std::nullopt;
  return find_run(transaction, id);
}

std::uint64_t requeue_running_runs(Transaction& transaction, Time now) {
  Database& database = database_of(transaction);
  database.run(
      "UPDATE survey_runs INDEXED BY survey_runs_running SET state = 'failed', finished_at = ?, "
      "why = 'the program stopped ' || attempts || ' times during this survey' "
      "WHERE state = 'running' AND attempts > ?",
      now, kMostRunAttempts);
  database.run("UPDATE survey_runs INDEXED BY survey_runs_running SET state = 'queued' WHERE state = 'running'");
  return static_cast<std::uint64_t>(database.changed_rows());
}

void requeue_run(Transaction& transaction, RunId id) {
  database_of(transaction)
      .run("UPDATE survey_runs SET state = 'queued', attempts = attempts - 1 WHERE id = ? AND state = 'running'", id);
}

void put_back_running_runs(Transaction& transaction) {
  database_of(transaction)
      .run(
          "UPDATE survey_runs INDEXED BY survey_runs_running SET state = 'queued', attempts = attempts - 1 "
          "WHERE state = 'running'");
}

bool cancel_run(Transaction& transaction, RunId id, const std::string& why, Time now) {
  Database& database = database_of(transaction);
  database.run(
      "UPDATE survey_runs SET state = 'cancelled', why = ?, finished_at = ? WHERE id = ? AND "
      "state IN ('queued', 'running')",
      why, now, id);
  return database.changed_rows() > 0;
}

bool is_running(const Snapshot& snapshot, RunId id) {
  return database_of(snapshot)
      .find<int>("SELECT 1 FROM survey_runs WHERE id = ? AND state = 'running'", id)
      .has_value();
}

bool finish_run(Transaction& transaction, RunId id, const RunEnd& end, Time now) {
  Database& database = database_of(transaction);
  database.run(
      "UPDATE survey_runs SET state = ?, why = ?, log = ?, epoch = ?, reference = ?, survey = ?, finished_at = ? "
      "WHERE id = ? AND state = 'running'",
      to_string(end.state), end.why, log_json(end.log), end.epoch, end.reference, end.survey, now, id);
  return database.changed_rows() > 0;
}

}  // namespace raywatch
