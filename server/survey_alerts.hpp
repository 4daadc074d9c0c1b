#pragma once

#include <string>

#include "core/survey.hpp"
#include "storage/schedules.hpp"
#include "storage/survey_runs.hpp"
#include "storage/surveys.hpp"

namespace raywatch {

/// Tells that a night brought no survey, once for each reason until it is over; a run that is done settles all of them.
void report_run(Transaction& transaction, const ScheduleRecord& schedule, const RunEnd& end, Time now);

/// Judges the figures of a survey by the thresholds of its schedule. A level that rises opens an alert, or raises the
/// one that stands; one that falls lowers it; green resolves it. Each once, when the level changes.
void judge_levels(Transaction& transaction, const ScheduleRecord& schedule, const SurveyRecord& survey,
                  const SurveyResult& result, Time now);

}  // namespace raywatch
