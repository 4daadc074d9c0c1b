#pragma once

#include <optional>

#include "storage/schedules.hpp"
#include "storage/survey_runs.hpp"

namespace raywatch {

/// The run of a schedule for a due time, not stored yet: its window ends then.
RunRecord run_of(const ScheduleRecord& schedule, Time due_at);
/// When the schedule runs next, with its grace; nothing while it is disabled.
std::optional<Time> next_run_of(const ScheduleRecord& schedule, Time now);

}  // namespace raywatch
