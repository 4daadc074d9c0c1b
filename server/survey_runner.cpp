#include "server/survey_runner.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <cstdio>
#include <numbers>
#include <set>
#include <utility>

#include "core/error.hpp"
#include "server/survey_alerts.hpp"
#include "server/survey_reference.hpp"
#include "server/unowned_payloads.hpp"
#include "storage/events.hpp"
#include "storage/local_time.hpp"
#include "storage/surveys.hpp"
#include "storage/zones.hpp"

namespace raywatch {

/// What a run is about, and what came of it so far.
struct SurveyRunner::Subject {
  RunRecord run;
  std::stop_token stop;
  Site site;
  std::optional<ScheduleRecord> schedule;
  std::vector<ScanRecord> scans;         ///< of the epoch
  std::optional<EpochRecord> reference;  ///< nothing to compare with: none
  std::vector<ScanRecord> reference_scans;
  std::vector<SurveyZone> zones;
  std::vector<Prism> control;
  std::vector<RunLogLine> log;
};

SurveyRunner::SurveyRunner(Store& store, IndexCache& cache, std::string program_version, std::function<Time()> now)
    : store_(store), loader_(store, cache), program_version_(std::move(program_version)), now_(std::move(now)) {}

bool SurveyRunner::run_next(tbb::task_arena& arena, const std::stop_token& stop) {
  const std::optional<RunRecord> taken = take_run();
  if (!taken) return false;
  try {
    run(*taken, arena, stop);
  } catch (const CorruptData&) {
    throw;
  } catch (const StorageError&) {  // a full disk, an I/O error: it may work later
    store_.write([&](Transaction& transaction) { requeue_run(transaction, taken->id); });
    throw;
  }
  return true;
}

std::optional<RunRecord> SurveyRunner::take_run() {
  const auto ready = store_.read([](const Snapshot& snapshot) -> std::optional<RunId> {
    std::set<ScheduleId> waiting;
    for (const RunRecord& run : queued_runs(snapshot)) {
      if (run.schedule && waiting.contains(*run.schedule)) continue;
      if (run.epoch || !is_window_unsettled(snapshot, {run.site, run.from, run.to})) return run.id;
      if (run.schedule) waiting.insert(*run.schedule);
    }
    return std::nullopt;
  });
  if (!ready) return std::nullopt;
  return store_.write([&](Transaction& transaction) { return start_run(transaction, *ready, now_()); });
}

void SurveyRunner::run(const RunRecord& run, tbb::task_arena& arena, const std::stop_token& stop) {
  Subject subject;
  subject.run = run;
  subject.stop = stop;
  try {
    read_subject(subject);
    survey(subject, arena);
  } catch (const InvalidInput& error) {
    end_without_survey(subject, RunState::failed, error.what());
  } catch (const CorruptData& error) {
    end_without_survey(subject, RunState::failed, error.what());
  } catch (const NotFound& error) {
    end_without_survey(subject, RunState::failed, error.what());
  } catch (const Conflict& error) {
    if (store_.read([&](const Snapshot& snapshot) { return is_running(snapshot, run.id); })) throw;
    spdlog::info("survey run {} was cancelled or put back while it ended: {}", run.id.value, error.what());
  }
  // One that has ended stays as it is.
  if (stop.stop_requested()) store_.write([&](Transaction& transaction) { requeue_run(transaction, run.id); });
}

bool SurveyRunner::is_wanted(const Subject& subject) const {
  if (subject.stop.stop_requested()) return false;
  return store_.read([&](const Snapshot& snapshot) { return is_running(snapshot, subject.run.id); });
}

/// What was read before something is missing stays, so that its end can be told.
void SurveyRunner::read_subject(Subject& subject) const {
  const RunRecord& run = subject.run;
  store_.read([&](const Snapshot& snapshot) {
    const std::optional<Site> site = find_site(snapshot, run.site);
    if (!site) throw NotFound("The site of the survey does not exist any more.");
    subject.site = *site;
    if (run.schedule) subject.schedule = find_schedule(snapshot, *run.schedule);
    if (run.epoch) {
      const std::optional<EpochRecord> epoch = find_epoch(snapshot, *run.epoch);
      if (!epoch) throw NotFound("The epoch does not exist any more.");
      subject.scans = scans_with(snapshot, *epoch);
    } else {
      const std::vector<SensorId> sensors = subject.schedule ? subject.schedule->plan.sensors : std::vector<SensorId>{};
      subject.scans = scans_of_window(snapshot, {run.site, run.from, run.to, sensors});
    }
    subject.reference = reference_epoch(snapshot, run, subject.site);
    if (subject.reference) subject.reference_scans = scans_with(snapshot, *subject.reference);
    subject.zones = survey_zones(snapshot, run);
    for (const Zone& zone : zones_of(snapshot, run.site)) {
      if (zone.kind == ZoneKind::control) subject.control.push_back(zone.prism);
    }
  });
}

void SurveyRunner::survey(Subject& subject, tbb::task_arena& arena) {
  note(subject, std::to_string(subject.scans.size()) + " scans from " +
                    local_text(subject.run.from, subject.site.time_zone) + " to " +
                    local_text(subject.run.to, subject.site.time_zone));
  const std::string missing =
      store_.read([&](const Snapshot& snapshot) { return what_is_missing(snapshot, subject.scans, subject.schedule); });
  if (!missing.empty()) return end_without_survey(subject, RunState::no_scans, missing);
  const std::string misfit = what_is_misplaced(subject.scans, subject.run.definition.tolerance);
  if (!misfit.empty()) return end_without_survey(subject, RunState::refused, misfit);
  if (!subject.reference) {
    return end_without_survey(subject, RunState::done,
                              "There is no earlier epoch to compare with: this one is the first.");
  }
  note(subject,
       "compared with epoch " + std::to_string(subject.reference->id.value) + ", \"" + subject.reference->name + "\"");
  const std::optional<LoadedEpoch> before = load(subject, subject.reference_scans, arena);
  if (!before) return;
  std::optional<LoadedEpoch> after = load(subject, subject.scans, arena);
  if (!after) return;
  const CompareParameters parameters = default_parameters(subject.site.profile, Grouping::consensus);
  const RegistrationTolerance& tolerance = subject.run.definition.tolerance;
  const auto refused = register_epoch(*after, *before, {subject.control, parameters, tolerance}, arena);
  if (refused) return end_without_survey(subject, RunState::refused, *refused);
  note_registration(subject, *after);
  if (!is_wanted(subject)) return;
  const SurveyInput input{.before = {before->epoch, before->about},
                          .after = {after->epoch, after->about},
                          .zones = subject.zones,
                          .definition = subject.run.definition,
                          .parameters = parameters,
                          .program_version = program_version_};
  const SurveyResult result = arena.execute([&] { return survey_between(input); });
  for (const std::string& warning : result.warnings) note(subject, "warning: " + warning);
  commit(subject, result);
}

std::optional<LoadedEpoch> SurveyRunner::load(const Subject& subject, const std::vector<ScanRecord>& scans,
                                              tbb::task_arena& arena) const {
  const CompareParameters parameters = default_parameters(subject.site.profile, Grouping::consensus);
  LoadedEpoch loaded;
  for (const ScanRecord& scan : scans) {
    if (!is_wanted(subject)) return std::nullopt;
    loaded.scans.push_back(loader_.load(scan, subject.site, parameters, arena));
  }
  for (std::size_t k = 0; k < scans.size(); ++k) {
    const ScanRecord& scan = scans[k];
    loaded.epoch.add(loaded.scans[k].view(), static_cast<std::uint32_t>(scan.vantage.value));
    loaded.about.push_back({.scan = scan.id,
                            .station = scan.vantage,
                            .sensor = scan.sensor,
                            .captured_at = scan.captured_at,
                            .points = scan.points,
                            .sha256 = scan.sha256,
                            .world_from_sensor = loaded.scans[k].world_from_sensor,
                            .registration = scan.registration.state,
                            .residual_m = scan.registration.residual_m,
                            .uncertainty = loaded.scans[k].pose_uncertainty});
  }
  return loaded;
}

void SurveyRunner::end_without_survey(Subject& subject, RunState state, const std::string& why) {
  note(subject, why);
  const Time now = now_();
  store_.write([&](Transaction& transaction) {
    RunEnd end{
        .state = state, .why = why, .log = subject.log, .epoch = subject.run.epoch, .reference = {}, .survey = {}};
    const bool makes_epoch = !subject.run.epoch && (state == RunState::done || state == RunState::refused);
    if (makes_epoch) {
      EpochRecord epoch = epoch_of_run(subject.run, subject.site, subject.scans);
      if (state == RunState::refused) {
        epoch.state = EpochState::refused;
        epoch.why = why;
      }
      end.epoch = insert_epoch(transaction, epoch, now).id;
    }
    if (!finish_run(transaction, subject.run.id, end, now)) {
      throw Conflict("the run of the survey was ended by somebody else");
    }
    if (subject.schedule) report_run(transaction, *subject.schedule, end, now);
    insert_event(transaction, {.at = now,
                               .type = "survey." + std::string(to_string(state)),
                               .site = subject.run.site,
                               .text = "Run " + std::to_string(subject.run.id.value) + " of a survey: " + why});
  });
  spdlog::log(state == RunState::done ? spdlog::level::info : spdlog::level::warn, "survey run {}: {}",
              subject.run.id.value, why);
}

void SurveyRunner::commit(Subject& subject, const SurveyResult& result) {
  UnownedPayloads written(store_.payloads());
  const Time after_at = subject.scans.front().captured_at;
  const PayloadRef models = written.add(put_survey(store_.payloads(), subject.site.id, after_at, result));
  const std::uint64_t stored_bytes = store_.payloads().stored_bytes(models);
  const Time now = now_();
  const SurveyId made = store_.write([&](Transaction& transaction) {
    RunEnd end{.state = RunState::done,
               .why = {},
               .log = subject.log,
               .epoch = subject.run.epoch,
               .reference = subject.reference->id,
               .survey = {}};
    if (!end.epoch) {
      end.epoch = insert_epoch(transaction, epoch_of_run(subject.run, subject.site, subject.scans), now).id;
    }
    const SurveyRecord survey = insert_survey(transaction,
                                              {.id = {},
                                               .site = subject.site.id,
                                               .schedule = subject.run.schedule,
                                               .run = subject.run.id,
                                               .before = subject.reference->id,
                                               .after = *end.epoch,
                                               .before_at = subject.reference_scans.front().captured_at,
                                               .after_at = after_at,
                                               .made_at = now,
                                               .models = models,
                                               .stored_bytes = stored_bytes},
                                              result);
    end.survey = survey.id;
    if (!finish_run(transaction, subject.run.id, end, now)) {
      throw Conflict("the run of the survey was ended by somebody else");
    }
    if (subject.schedule) {
      report_run(transaction, *subject.schedule, end, now);
      judge_levels(transaction, *subject.schedule, survey, result, now);
    }
    insert_event(transaction, {.at = now,
                               .type = "survey.done",
                               .site = subject.site.id,
                               .text = "Survey " + std::to_string(survey.id.value) +
                                       " is done: " + std::to_string(result.changes.size()) + " changes were found."});
    return survey.id;
  });
  written.keep();
  spdlog::info("survey {} of site {} is done: {} changes", made.value, subject.site.name, result.changes.size());
}

void SurveyRunner::note_registration(Subject& subject, const LoadedEpoch& epoch) const {
  for (const SurveyedScan& scan : epoch.about) {
    char text[160];
    std::snprintf(text, sizeof text, "scan %lld fits with a residual of %.1f mm, uncertain by %.1f mm and %.4f degrees",
                  static_cast<long long>(scan.scan.value), 1000.0 * scan.residual_m.value_or(0.0),
                  1000.0 * scan.uncertainty.position_m, scan.uncertainty.angle_rad * 180.0 / std::numbers::pi);
    note(subject, text);
  }
}

void SurveyRunner::note(Subject& subject, const std::string& text) const { subject.log.push_back({now_(), text}); }

}  // namespace raywatch
