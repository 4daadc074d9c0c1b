#pragma once

#include <tbb/task_arena.h>

#include <functional>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "core/survey.hpp"
#include "core/time.hpp"
#include "server/scan_loader.hpp"
#include "server/survey_registration.hpp"
#include "storage/epochs.hpp"
#include "storage/schedules.hpp"
#include "storage/sites.hpp"
#include "storage/store.hpp"
#include "storage/survey_runs.hpp"

namespace raywatch {

/// Carries out queued surveys, one after the other: from the scans of a window to committed figures. Used by one
/// thread.
class SurveyRunner {
 public:
  SurveyRunner(Store& store, IndexCache& cache, std::string program_version, std::function<Time()> now);

  /// Carries out the first queued run that can be; false when there is none. Runs of one schedule keep their order; one
  /// whose scans are still compared waits. What stops a run by passing trouble (a full disk) comes out, and the run is
  /// put back. A run that is cancelled ends at its next step, and so does one that is stopped, which is put back.
  /// Computes in `arena`; must not be called from inside it. @throws StorageError.
  bool run_next(tbb::task_arena& arena, const std::stop_token& stop = {});

 private:
  struct Subject;

  std::optional<RunRecord> take_run();
  void run(const RunRecord& run, tbb::task_arena& arena, const std::stop_token& stop);
  void read_subject(Subject& subject) const;
  void survey(Subject& subject, tbb::task_arena& arena);
  /// Asked between the steps of a run.
  bool is_wanted(const Subject& subject) const;
  /// Nothing: the run is not wanted any more.
  std::optional<LoadedEpoch> load(const Subject& subject, const std::vector<ScanRecord>& scans,
                                  tbb::task_arena& arena) const;
  /// Ends a run that brought no survey; its epoch is kept when it has scans.
  void end_without_survey(Subject& subject, RunState state, const std::string& why);
  void commit(Subject& subject, const SurveyResult& result);
  void note_registration(Subject& subject, const LoadedEpoch& epoch) const;
  void note(Subject& subject, const std::string& text) const;

  Store& store_;
  ScanLoader loader_;
  std::string program_version_;
  std::function<Time()> now_;
};

}  // namespace raywatch
