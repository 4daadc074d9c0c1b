#include "storage/schedule_runs.hpp"

#include <algorithm>

#include "core/cron.hpp"
#include "storage/local_time.hpp"

namespace raywatch {

RunRecord run_of(const ScheduleRecord& schedule, Time due_at) {
  RunRecord run;
  run.site = schedule.site;
  run.schedule = schedule.id;
  run.due_at = due_at;
  run.from = due_at - schedule.plan.window;
  run.to = due_at;
  run.definition = schedule.plan.definition;
  return run;
}

std::optional<Time> next_run_of(const ScheduleRecord& schedule, Time now) {
  if (!schedule.enabled) return std::nullopt;
  const Time after = std::max(schedule.looked_until, now - schedule.plan.grace);
  const std::optional<Time> due = next_run(parse_cron(schedule.plan.cron), zone_clock(schedule.plan.time_zone), after);
  return due ? std::optional(*due + schedule.plan.grace) : std::nullopt;
}

}  // namespace raywatch
