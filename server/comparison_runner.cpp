#include "server/comparison_runner.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <iterator>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "core/compare.hpp"
#include "core/error.hpp"
#include "core/panorama.hpp"
#include "core/prior_groups.hpp"
#include "server/reference_resolver.hpp"
#include "server/stopwatch.hpp"
#include "server/unowned_payloads.hpp"
#include "storage/events.hpp"
#include "storage/payloads.hpp"
#include "storage/sites.hpp"

namespace raywatch {
namespace {

template <class T>
T existing(std::optional<T> found, const char* what) {
  if (!found) throw NotFound(std::string("the ") + what + " does not exist any more");
  return std::move(*found);
}

/// The entry of a comparison that runs, on the board as long as it does.
class Progress {
 public:
  Progress(ProgressBoard& board, ComparisonId id) : board_(board), id_(id) { board_.set(id_, 0.0); }
  ~Progress() { board_.remove(id_); }
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  void set(double share) { board_.set(id_, share); }

 private:
  ProgressBoard& board_;
  ComparisonId id_;
};

ComparisonCandidate candidate_record(const ScanRecord& scan, const CandidateAssessment& assessment) {
  return {.scan = scan.id,
          .vantage = scan.vantage,
          .distance_m = assessment.distance_m,
          .age = assessment.age,
          .overlap = assessment.overlap,
          .gain = assessment.gain,
          .chosen = assessment.chosen,
          .reason = assessment.reason};
}

/// For each prior, whether it and those before it were learned as normal at one time: what it alone saw was passing.
/// What an operator added to the baseline, or another vantage learned later, is normal by itself.
std::vector<bool> normal_together(std::span<const LoadedScan> scans, std::span<const ComparisonPrior> priors,
                                  const std::set<ScanId>& learned) {
  constexpr std::chrono::hours kOneTime{24};
  std::vector<bool> result;
  for (std::size_t p = 0; p < scans.size(); ++p) {
    const auto belongs = [&](std::size_t q) {
      const Duration earlier = between(scans[q].captured_at, scans[p].captured_at);
      return earlier < Duration::zero() || (learned.contains(priors[q].scan) && earlier <= kOneTime);
    };
    bool together = true;
    for (std::size_t q = 0; q < scans.size(); ++q) together = together && belongs(q);
    result.push_back(together);
  }
  return result;
}

void log_registration(const ScanRecord& scan, const ComparisonResult& result) {
  if (!result.registration) return;
  const RegistrationState state = result.registration->state;
  if (state != RegistrationState::moved && state != RegistrationState::bad) return;
  spdlog::warn("scan {}: registration {}: {}", scan.id.value, to_string(state), result.warnings.front());
}

}  // namespace

/// What a job is about.
struct ComparisonRunner::Subject {
  ComparisonRecord comparison;
  ScanRecord scan;
  Site site;
};

/// The scans that were offered, and what was found about each.
struct ComparisonRunner::Choice {
  std::vector<ScanRecord> offered;
  std::vector<CandidateAssessment> assessments;
  std::set<ScanId> learned;            ///< of those offered: among the first of their vantage
  std::vector<BaselinePatch> patches;  ///< of the reference `baseline`, whose scans speak within a region only
};

/// The priors in memory. The groups refer to the scans.
struct ComparisonRunner::LoadedPriors {
  std::vector<LoadedScan> scans;
  std::vector<PriorGroup> groups;
};

ComparisonRunner::ComparisonRunner(Store& store, IndexCache& cache, ProgressBoard& progress,
                                   const ComparisonRunnerConfig& config, std::function<Time()> now)
    : store_(store),
      loader_(store, cache),
      registrar_(store, loader_, config.registrar),
      watcher_(config.watch),
      progress_(progress),
      config_(config),
      now_(std::move(now)) {}

void ComparisonRunner::run(const Job& job, tbb::task_arena& arena) {
  Stopwatch watch;
  Progress progress(progress_, job.comparison);
  ComparisonResult result;

  Subject subject = read_subject(job);
  const CompareParameters& parameters = subject.comparison.parameters;
  LoadedScan scan = loader_.load(subject.scan, subject.site, parameters, arena);
  double load_ms = watch.lap_ms();
  progress.set(0.05);

  register_scan(subject, scan, arena, result);
  result.timings_ms["align"] = watch.lap_ms();
  progress.set(0.1);

  const Choice choice = choose(subject, scan, arena);
  warn_of_named(subject, choice, result);
  result.timings_ms["choose"] = watch.lap_ms();
  progress.set(0.2);

  const LoadedPriors priors = load_priors(subject, choice, arena, result);
  load_ms += watch.lap_ms();
  result.timings_ms["load"] = load_ms;
  progress.set(0.5);

  const std::vector<ScanView> views = all_priors(priors.groups);
  Detection detection = arena.execute([&] { return detect_in_regions(scan.view(), priors.groups, parameters); });
  result.timings_ms["detect"] = watch.lap_ms();
  progress.set(0.8);

  Comparison comparison =
      arena.execute([&] { return form_changes(scan.view(), views, parameters, std::move(detection)); });
  result.timings_ms["cluster"] = watch.lap_ms();
  progress.set(0.9);

  const Glance glance = look(subject, scan, views, comparison, arena);
  if (subject.comparison.watching) result.timings_ms["watch"] = watch.lap_ms();
  result.timings_ms["total"] = watch.total_ms();

  for (std::size_t i = 0; i < result.priors.size(); ++i) {
    result.priors[i].added = comparison.priors[i].added;
    result.priors[i].removed = comparison.priors[i].removed;
  }
  std::ranges::copy(comparison.counts, result.counts.begin());
  result.testable = comparison.testable;
  result.changes = std::move(comparison.changes);
  std::ranges::move(comparison.warnings, std::back_inserter(result.warnings));
  commit(job, subject, std::move(result),
         {std::move(comparison.classes), std::move(comparison.free), std::move(comparison.supported),
          std::move(comparison.change_of), std::move(comparison.prior_points)},
         glance);
}

ComparisonRunner::Subject ComparisonRunner::read_subject(const Job& job) const {
  return store_.read([&](const Snapshot& snapshot) -> Subject {
    return {existing(find_comparison(snapshot, job.comparison), "comparison"),
            existing(find_scan(snapshot, job.scan), "scan"), existing(find_site(snapshot, job.site), "site")};
  });
}

void ComparisonRunner::register_scan(Subject& subject, LoadedScan& scan, tbb::task_arena& arena,
                                     ComparisonResult& result) const {
  const CompareParameters& parameters = subject.comparison.parameters;
  if (!refines_poses(parameters)) return;
  Registration& registration = subject.scan.registration;
  if (!registration.uncertainty) {
    scan.place(subject.scan, subject.site, false);
    ScanRegistration found = registrar_(subject.scan, subject.site, parameters, scan, arena);
    registration = found.registration;
    result.registration = registration;
    result.warnings = std::move(found.warnings);
    scan.place(subject.scan, subject.site, true);
  }
  std::ranges::copy(registration_warnings(subject.scan), std::back_inserter(result.warnings));
}

ComparisonRunner::Choice ComparisonRunner::choose(const Subject& subject, const LoadedScan& scan,
                                                  tbb::task_arena& arena) const {
  const Reference& reference = subject.comparison.reference;
  // Two scans that see equally far overlap nowhere when they are farther apart than this.
  const double radius_m = 2.0 * reach_m(*loader_.panorama(subject.scan));
  const ReferenceLimits limits{.radius_m = radius_m,
                               .contemporary_tolerance = subject.comparison.parameters.contemporary_tolerance,
                               .previous_limit = config_.previous_limit};
  const bool refined = refines_poses(subject.comparison.parameters);
  Choice choice;
  store_.read([&](const Snapshot& snapshot) {
    choice.offered = resolve_reference(snapshot, subject.scan, subject.site, reference, limits);
    if (!std::holds_alternative<BaselineReference>(reference)) return;
    choice.patches = resolve_patches(snapshot, subject.scan, subject.site, radius_m);
    choice.learned = learned_among(snapshot, subject.site.id, choice.offered);
  });
  std::vector<PriorCandidate> candidates;
  for (const ScanRecord& offered : choice.offered) {
    const bool fits = !refined || offered.registration.state != RegistrationState::bad || is_explicit(reference);
    candidates.push_back(
        {.world_from_sensor = refined ? local_pose(offered, subject.site) : reported_local_pose(offered, subject.site),
         .captured_at = offered.captured_at,
         .coverage = loader_.panorama(offered),
         .required = is_explicit(reference),
         .refused = fits ? "" : "its registration is bad"});
  }
  const std::vector<Eigen::Vector3d> sample_m = sample_world_points(
      scan.indexed->points, scan.world_from_sensor, scan.indexed->index.usable(), config_.choice.sample_points);
  choice.assessments = arena.execute(
      [&] { return choose_priors(sample_m, scan.world_from_sensor, scan.captured_at, candidates, config_.choice); });
  return choice;
}

void ComparisonRunner::warn_of_named(const Subject& subject, const Choice& choice, ComparisonResult& result) {
  if (!is_explicit(subject.comparison.reference)) return;
  for (std::size_t i = 0; i < choice.offered.size(); ++i) {
    const ScanRecord& named = choice.offered[i];
    const std::string name = "Scan " + std::to_string(named.id.value);
    if (!choice.assessments[i].chosen) {
      result.warnings.push_back(name + " was asked for and is not used: " + choice.assessments[i].reason + ".");
    } else if (refines_poses(subject.comparison.parameters) && named.registration.state == RegistrationState::bad) {
      result.warnings.push_back(name +
                                " does not fit onto the earlier ones: its registration is bad. As it was asked for, it "
                                "is used at its pose as reported.");
    }
  }
}

ComparisonRunner::LoadedPriors ComparisonRunner::load_priors(const Subject& subject, const Choice& choice,
                                                             tbb::task_arena& arena, ComparisonResult& result) const {
  LoadedPriors priors;
  const auto add = [&](const ScanRecord& scan, double overlap, PriorGroup& group) {
    priors.scans.push_back(loader_.load(scan, subject.site, subject.comparison.parameters, arena));
    group.priors.push_back(priors.scans.back().view());
    result.priors.push_back({.scan = scan.id, .vantage = scan.vantage, .overlap = overlap});
  };
  PriorGroup everywhere;
  for (std::size_t i = 0; i < choice.offered.size(); ++i) {
    const CandidateAssessment& assessment = choice.assessments[i];
    result.candidates.push_back(candidate_record(choice.offered[i], assessment));
    if (assessment.chosen) add(choice.offered[i], assessment.overlap, everywhere);
  }
  everywhere.normal_together = normal_together(priors.scans, result.priors, choice.learned);
  priors.groups.push_back(std::move(everywhere));
  for (const BaselinePatch& patch : choice.patches) {
    PriorGroup group{.priors = {}, .region_m = patch.region_m};
    for (const ScanRecord& scan : patch.scans) add(scan, 0.0, group);
    priors.groups.push_back(std::move(group));
  }
  return priors;
}

Glance ComparisonRunner::look(const Subject& subject, const LoadedScan& scan, std::span<const ScanView> priors,
                              const Comparison& comparison, tbb::task_arena& arena) const {
  if (!subject.comparison.watching) return {};
  const SiteView site =
      store_.read([&](const Snapshot& snapshot) { return watcher_.view_site(snapshot, subject.site.id); });
  return arena.execute(
      [&] { return watcher_.look(site, scan.view(), priors, comparison, subject.comparison.parameters); });
}

void ComparisonRunner::commit(const Job& job, const Subject& subject, ComparisonResult result,
                              const ComparisonPoints& points, const Glance& glance) {
  UnownedPayloads written(store_.payloads());
  result.payload = written.add(store_.payloads().put_comparison(subject.site.id, subject.scan.captured_at, points));
  result.stored_bytes = store_.payloads().stored_bytes(result.payload);
  const Time now = now_();
  const bool is_first = store_.write([&](Transaction& transaction) {
    const std::optional<std::vector<ChangeId>> changes = finish_job(transaction, job, result, now);
    if (!changes) return false;
    if (subject.comparison.watching) {
      watcher_.commit(transaction,
                      {subject.scan, subject.site, job.comparison, result.testable, result.changes, *changes}, glance,
                      now);
    }
    insert_event(transaction, {.at = now,
                               .type = "comparison.done",
                               .site = job.site,
                               .scan = job.scan,
                               .comparison = job.comparison,
                               .sensor = subject.scan.sensor,
                               .text = std::to_string(result.changes.size()) + " changes were found."});
    return true;
  });
  if (!is_first) return;
  written.keep();
  log_registration(subject.scan, result);
  spdlog::info("comparison {}: scan {} compared with {} others in {:.0f} ms: {} changes", job.comparison.value,
               subject.scan.id.value, result.priors.size(), result.timings_ms.at("total"), result.changes.size());
}

}  // namespace raywatch
