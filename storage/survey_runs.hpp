#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/survey_definition.hpp"
#include "core/time.hpp"
#include "storage/page.hpp"
#include "storage/store.hpp"

namespace raywatch {

enum class RunState : std::uint8_t {
  queued,
  running,
  done,      ///< with a survey, or without one: the first epoch of a schedule has nothing to be compared with
  failed,    ///< see `why`
  no_scans,  ///< nothing, or not all that was required, was scanned in its window
  refused,   ///< the scans are not registered well enough
  skipped,   ///< it was missed, and not caught up
  cancelled  ///< by an operator; see `why`
};
std::string_view to_string(RunState state);
/// @throws InvalidInput naming the known ones.
RunState parse_run_state(std::string_view name);

struct RunLogLine {
  Time at;
  std::string text;
};

/// One run of a schedule, or one survey made by hand: the durable queue of surveys.
struct RunRecord {
  RunId id;
  SiteId site;
  std::optional<ScheduleId> schedule;  ///< none: by hand
  Time due_at;
  Time from, to;  ///< the window of its epoch: from <= captured_at < to
  SurveyDefinition definition;
  RunState state = RunState::queued;
  int attempts = 0;
  std::string why;
  std::vector<RunLogLine> log;
  std::optional<EpochId> epoch;      ///< that was surveyed; of one by hand it is given
  std::optional<EpochId> reference;  ///< that it was compared with; of one by hand it is given
  std::optional<SurveyId> survey;
  Time created_at;
  std::optional<Time> started_at, finished_at;
};

/// Its id and created_at are decided here; `finished_at` too, unless it is queued.
RunRecord insert_run(Transaction& transaction, const RunRecord& run, Time now);
std::optional<RunRecord> find_run(const Snapshot& snapshot, RunId id);

struct RunFilter {
  std::optional<SiteId> site;
  std::optional<ScheduleId> schedule;
};
/// Newest first. With a schedule the site is not asked about.
Page<RunRecord> list_runs(const Snapshot& snapshot, const RunFilter& filter, const PageRequest& page);

/// The queued runs, by due time.
std::vector<RunRecord> queued_runs(const Snapshot& snapshot);
/// Queued and running ones of a site.
std::vector<RunRecord> unfinished_runs(const Snapshot& snapshot, SiteId site);
/// Whether there is a run of that due time that is not finished, or brought something.
bool has_useful_run(const Snapshot& snapshot, ScheduleId schedule, Time due_at);
/// Marks a queued run as running, and counts the attempt. Nothing when it is not queued any more.
std::optional<RunRecord> start_run(Transaction& transaction, RunId id, Time now);
/// Puts runs back that an earlier process began and did not end; those that were begun too often fail.
std::uint64_t requeue_running_runs(Transaction& transaction, Time now);
/// Puts a run back without counting the attempt. Nothing happens when it is not running any more.
void requeue_run(Transaction& transaction, RunId id);
/// The same of all that are running: the program ends in good order, but cannot wait for them.
void put_back_running_runs(Transaction& transaction);
/// Ends a run that waits or is running; whoever carries it out finds that out by `finish_run`. False when it has ended.
bool cancel_run(Transaction& transaction, RunId id, const std::string& why, Time now);
/// Whether a run is running: not when it was cancelled, or put back.
bool is_running(const Snapshot& snapshot, RunId id);

/// How a run ends.
struct RunEnd {
  RunState state = RunState::done;
  std::string why;
  std::vector<RunLogLine> log;
  std::optional<EpochId> epoch, reference;
  std::optional<SurveyId> survey;
};
/// False when it was not running any more: then nothing else of it may be committed.
bool finish_run(Transaction& transaction, RunId id, const RunEnd& end, Time now);

}  // namespace raywatch
