#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/survey.hpp"
#include "storage/epochs.hpp"
#include "storage/scans.hpp"
#include "storage/schedules.hpp"
#include "storage/sites.hpp"
#include "storage/survey_runs.hpp"

namespace raywatch {

// What a run of a survey works on, as the store has it.

/// The earlier epoch that a run is compared with: the one that it names, or that its definition asks for. Nothing:
/// there is none. @throws NotFound when a named one is gone.
std::optional<EpochRecord> reference_epoch(const Snapshot& snapshot, const RunRecord& run, const Site& site);
/// The scans of an epoch. @throws NotFound naming one that was deleted.
std::vector<ScanRecord> scans_with(const Snapshot& snapshot, const EpochRecord& epoch);
/// The zones of a run: those that it names, or all of kind `volume`. @throws NotFound, InvalidInput.
std::vector<SurveyZone> survey_zones(const Snapshot& snapshot, const RunRecord& run);
EpochRecord epoch_of_run(const RunRecord& run, const Site& site, const std::vector<ScanRecord>& scans);

/// Why the scans are not enough for a survey; empty when they are.
std::string what_is_missing(const Snapshot& snapshot, const std::vector<ScanRecord>& scans,
                            const std::optional<ScheduleRecord>& schedule);
/// Which scans are not registered well enough; empty when all are.
std::string what_is_misplaced(const std::vector<ScanRecord>& scans, const RegistrationTolerance& tolerance);

}  // namespace raywatch
