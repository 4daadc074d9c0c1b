#include "server/schedule_clock.hpp"

#include <vector>

#include "core/cron.hpp"
#include "storage/local_time.hpp"
#include "storage/schedule_runs.hpp"

namespace raywatch {
namespace {

/// So many due times are looked at in one transaction.
constexpr std::size_t kDueAtOnce = 256;

/// What is to be done of some due times.
struct Sorted {
  std::vector<Time> made, skipped;
};

Sorted sort_by_catch_up(const ScheduleRecord& schedule, const std::vector<Time>& due, Time now) {
  Sorted sorted;
  const bool more_to_come = due.size() == kDueAtOnce;
  for (const Time at : due) {
    const bool punctual = now - at - schedule.plan.grace <= kPunctual;
    const bool latest = at == due.back() && !more_to_come;
    const CatchUp catch_up = schedule.plan.catch_up;
    const bool make = punctual || catch_up == CatchUp::all || (catch_up == CatchUp::latest && latest);
    (make ? sorted.made : sorted.skipped).push_back(at);
  }
  return sorted;
}

/// One record for all, however many they are.
void insert_skipped(Transaction& transaction, const ScheduleRecord& schedule, const std::vector<Time>& skipped,
                    Time now) {
  if (skipped.empty()) return;
  RunRecord run = run_of(schedule, skipped.back());
  run.from = skipped.front() - schedule.plan.window;
  run.state = RunState::skipped;
  run.why = std::to_string(skipped.size()) + (skipped.size() == 1 ? " run was" : " runs were") + " missed: due from " +
            local_text(skipped.front(), schedule.plan.time_zone) + " to " +
            local_text(skipped.back(), schedule.plan.time_zone) + ". The schedule does not catch up on them.";
  insert_run(transaction, run, now);
}

std::size_t make_due(Transaction& transaction, const ScheduleRecord& schedule, const std::vector<Time>& due, Time now) {
  const Sorted sorted = sort_by_catch_up(schedule, due, now);
  insert_skipped(transaction, schedule, sorted.skipped, now);
  std::size_t made = 0;
  for (const Time at : sorted.made) {
    if (has_useful_run(transaction, schedule.id, at)) continue;
    insert_run(transaction, run_of(schedule, at), now);
    ++made;
  }
  set_looked_until(transaction, schedule.id, due.back());
  return made;
}

}  // namespace

std::size_t ScheduleClock::look(Time now) {
  std::size_t made = 0;
  for (ScheduleRecord schedule : store_.read([](const Snapshot& snapshot) { return enabled_schedules(snapshot); })) {
    const CronExpression cron = parse_cron(schedule.plan.cron);
    const ZoneClock zone = zone_clock(schedule.plan.time_zone);
    if (schedule.looked_until > now) {  // the clock was put back
      schedule.looked_until = now;
      store_.write([&](Transaction& transaction) { set_looked_until(transaction, schedule.id, now); });
    }
    for (;;) {
      const std::vector<Time> due =
          runs_between(cron, zone, schedule.looked_until, now - schedule.plan.grace, kDueAtOnce);
      if (due.empty()) break;
      made += store_.write([&](Transaction& transaction) { return make_due(transaction, schedule, due, now); });
      schedule.looked_until = due.back();
    }
  }
  return made;
}

}  // namespace raywatch
