#pragma once

#include <tbb/task_arena.h>

#include <functional>
#include <memory>

#include "core/choose_priors.hpp"
#include "core/time.hpp"
#include "server/index_cache.hpp"
#include "server/progress_board.hpp"
#include "server/scan_loader.hpp"
#include "server/scan_registrar.hpp"
#include "server/watcher.hpp"
#include "storage/comparisons.hpp"
#include "storage/scans.hpp"
#include "storage/store.hpp"

namespace raywatch {

struct ComparisonRunnerConfig {
  Duration previous_limit{};  ///< scans older than this are no `previous` reference
  ChoiceParameters choice;
  RegistrarConfig registrar = {};
  WatchConfig watch = {};
};

/// Carries out queued comparisons: the way of a scan from its priors to its committed changes. Thread-safe.
class ComparisonRunner {
 public:
  ComparisonRunner(Store& store, IndexCache& cache, ProgressBoard& progress, const ComparisonRunnerConfig& config,
                   std::function<Time()> now);

  /// Runs a started job and commits its result, once. Computes in `arena`; must not be called from inside it.
  /// @throws core/error.hpp when it cannot; nothing is stored then and the job is still started.
  void run(const Job& job, tbb::task_arena& arena);

 private:
  struct Subject;
  struct Choice;
  struct LoadedPriors;

  Subject read_subject(const Job& job) const;
  /// Refines the scan's pose, the first time that it is compared.
  void register_scan(Subject& subject, LoadedScan& scan, tbb::task_arena& arena, ComparisonResult& result) const;
  Choice choose(const Subject& subject, const LoadedScan& scan, tbb::task_arena& arena) const;
  /// Scans that were asked for by name are used as they are, or it is said why not.
  static void warn_of_named(const Subject& subject, const Choice& choice, ComparisonResult& result);
  LoadedPriors load_priors(const Subject& subject, const Choice& choice, tbb::task_arena& arena,
                           ComparisonResult& result) const;
  /// Asks the scan what watching must know of it, when this is a watching comparison.
  Glance look(const Subject& subject, const LoadedScan& scan, std::span<const ScanView> priors,
              const Comparison& comparison, tbb::task_arena& arena) const;
  void commit(const Job& job, const Subject& subject, ComparisonResult result, const ComparisonPoints& points,
              const Glance& glance);

  Store& store_;
  ScanLoader loader_;
  ScanRegistrar registrar_;
  Watcher watcher_;
  ProgressBoard& progress_;
  ComparisonRunnerConfig config_;
  std::function<Time()> now_;
};

}  // namespace raywatch
