#pragma once

#include <tbb/task_arena.h>

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/survey.hpp"
#include "server/scan_loader.hpp"

namespace raywatch {

/// The scans of an epoch in memory, as a survey takes them.
struct LoadedEpoch {
  std::vector<LoadedScan> scans;
  std::vector<SurveyedScan> about;
  EpochScans epoch;
};

/// What scans are registered on, and how well they must be.
struct StableGround {
  std::vector<Prism> control;    ///< none: what a first comparison of the epochs finds unchanged
  CompareParameters parameters;  ///< of that comparison
  RegistrationTolerance tolerance;
};

/// Refines the poses of a later epoch's scans against those of the earlier one on stable ground (`register_on`), and
/// notes what came of each. Computes in `arena`. @returns why a scan must not be used, when one must not.
std::optional<std::string> register_epoch(LoadedEpoch& after, const LoadedEpoch& before, const StableGround& ground,
                                          tbb::task_arena& arena);

}  // namespace raywatch
