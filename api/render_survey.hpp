#pragma once

// Heavy: only .cpp files include this.
#include "api/json.hpp"
#include "core/survey.hpp"
#include "storage/epochs.hpp"
#include "storage/schedules.hpp"
#include "storage/survey_runs.hpp"
#include "storage/surveys.hpp"

namespace raywatch {

/// @{ The records of surveys, as JSON; see render.hpp. Places are in the coordinates of the site.
Json render(const SurveyDefinition& definition);
Json render(const Snapshot& snapshot, const ScheduleRecord& schedule, const std::optional<Time>& next_run_at);
Json render(const Snapshot& snapshot, const RunRecord& run);
Json render(const Snapshot& snapshot, const EpochRecord& epoch);
/// With the total of its figures.
Json render(const ListedSurvey& survey);
/// What it rests on: scans, parameters, registration.
Json render_ground(const Snapshot& snapshot, const SurveyRecord& survey, const SurveyResult& result);
Json render(const ZoneFigures& figures);
Json render(const SurveyChange& change, const SurveyResult& survey, const Eigen::Vector3d& origin_m);
/// @}

/// @{ What an id stands for. @throws NotFound.
ScheduleRecord schedule_with(const Snapshot& snapshot, ScheduleId id);
RunRecord run_with(const Snapshot& snapshot, RunId id);
EpochRecord epoch_with(const Snapshot& snapshot, EpochId id);
SurveyRecord survey_with(const Snapshot& snapshot, SurveyId id);
/// @}

}  // namespace raywatch
