#include "server/schedule_clock.hpp"

#include <doctest/doctest.h>
#include <rapidcheck.h>

#include <algorithm>

#include "core/cron.hpp"
#include "storage/all_of_list.hpp"
#include "storage/local_time.hpp"
#include "storage/schedule_runs.hpp"
#include "storage/sites.hpp"
#include "tests/support/temp_dir.hpp"

namespace raywatch {
namespace {

using namespace std::chrono_literals;

/// A store with one schedule, looked at by hand.
class ClockedPlace {
 public:
  explicit ClockedPlace(SchedulePlan plan, Time since) {
    store_.write([&](Transaction& t) {
      ScheduleRecord schedule;
      schedule.site = insert_site(t, {.name = "pit", .time_zone = plan.time_zone}, since).id;
      schedule.name = "nightly";
      schedule.plan = std::move(plan);
      schedule.looked_until = since;
      id_ = insert_schedule(t, schedule, since).id;
    });
  }

  /// By a clock of its own, as after a restart.
  void look(Time now) { ScheduleClock(store_).look(now); }
  void look(const char* now) { look(parse_rfc3339(now)); }

  std::vector<RunRecord> runs(RunState state) {
    std::vector<RunRecord> all = store_.read([&](const Snapshot& s) {
      return all_of_list([&](const PageRequest& page) { return list_runs(s, {.site = {}, .schedule = id_}, page); });
    });
    std::erase_if(all, [&](const RunRecord& run) { return run.state != state; });
    std::ranges::reverse(all);
    return all;
  }
  std::vector<Time> queued() {
    std::vector<Time> due;
    for (const RunRecord& run : runs(RunState::queued)) due.push_back(run.due_at);
    return due;
  }
  void end(RunId run, RunState state) {
    store_.write([&](Transaction& t) {
      start_run(t, run, Time{});
      finish_run(t, run, {.state = state, .why = "", .log = {}}, Time{});
    });
  }
  ScheduleRecord schedule() {
    return store_.read([&](const Snapshot& s) { return find_schedule(s, id_).value(); });
  }
  Store& store() { return store_; }

 private:
  TempDir folder_;
  Store store_{{.data_dir = folder_.path(), .readers = 1, .min_free_bytes = 0}};
  ScheduleId id_;
};

SchedulePlan plan_of(const std::string& cron, CatchUp catch_up, const std::string& zone = "Europe/Berlin") {
  return {.cron = cron, .time_zone = zone, .window = 6h, .grace = 10min, .catch_up = catch_up};
}

std::vector<Time> expected(const std::string& cron, const std::string& zone, Time after, Time until) {
  return runs_between(parse_cron(cron), zone_clock(zone), after, until, 10'000);
}

std::vector<std::string> texts(const std::vector<Time>& times) {
  std::vector<std::string> result;
  for (const Time time : times) result.push_back(format_rfc3339(time));
  return result;
}
using Texts = std::vector<std::string>;

TEST_CASE("a run is made when its due time and its grace are over, with the window before it") {
  ClockedPlace place(plan_of("30 5 * * *", CatchUp::latest, "UTC"), parse_rfc3339("2026-03-01T00:00:00Z"));
  place.look("2026-03-01T05:39:59Z");
  CHECK(place.queued().empty());
  CHECK(next_run_of(place.schedule(), parse_rfc3339("2026-03-01T05:39:59Z")) == parse_rfc3339("2026-03-01T05:40:00Z"));
  place.look("2026-03-01T05:40:00Z");
  place.look("2026-03-01T05:41:00Z");
  REQUIRE(place.queued() == std::vector{parse_rfc3339("2026-03-01T05:30:00Z")});
  const RunRecord run = place.runs(RunState::queued).front();
  CHECK(run.from == parse_rfc3339("2026-02-28T23:30:00Z"));
  CHECK(run.to == parse_rfc3339("2026-03-01T05:30:00Z"));
  CHECK(next_run_of(place.schedule(), parse_rfc3339("2026-03-01T05:41:00Z")) == parse_rfc3339("2026-03-02T05:40:00Z"));
}

TEST_CASE("what was missed is caught up on: all of it, the latest, or none") {
  const Time since = parse_rfc3339("2026-03-01T00:00:00Z"), now = parse_rfc3339("2026-03-04T12:00:00Z");
  ClockedPlace all(plan_of("0 5 * * *", CatchUp::all, "UTC"), since);
  all.look(now);
  CHECK(all.queued().size() == 4);
  CHECK(all.runs(RunState::skipped).empty());

  ClockedPlace latest(plan_of("0 5 * * *", CatchUp::latest, "UTC"), since);
  latest.look(now);
  CHECK(latest.queued() == std::vector{parse_rfc3339("2026-03-04T05:00:00Z")});
  REQUIRE(latest.runs(RunState::skipped).size() == 1);
  CHECK(latest.runs(RunState::skipped).front().why.starts_with("3 runs were missed"));

  ClockedPlace none(plan_of("0 5 * * *", CatchUp::skip, "UTC"), since);
  none.look(now);
  CHECK(none.queued().empty());
  CHECK(none.runs(RunState::skipped).size() == 1);
  none.look("2026-03-05T05:12:00Z");
  CHECK(none.queued() == std::vector{parse_rfc3339("2026-03-05T05:00:00Z")});
}

TEST_CASE("a schedule that is disabled makes no run") {
  ClockedPlace place(plan_of("0 5 * * *", CatchUp::all), parse_rfc3339("2026-03-01T00:00:00Z"));
  ScheduleRecord schedule = place.schedule();
  schedule.enabled = false;
  place.store().write([&](Transaction& t) { replace_schedule(t, schedule, Time{}); });
  place.look("2026-03-08T00:00:00Z");
  CHECK(place.queued().empty());
  CHECK_FALSE(next_run_of(place.schedule(), parse_rfc3339("2026-03-08T00:00:00Z")));
}

TEST_CASE("a clock that was put back makes again only what brought nothing") {
  ClockedPlace place(plan_of("0 5 * * *", CatchUp::all, "UTC"), parse_rfc3339("2026-03-01T00:00:00Z"));
  place.look("2026-03-02T06:00:00Z");
  const std::vector<RunRecord> runs = place.runs(RunState::queued);
  REQUIRE(runs.size() == 2);
  place.end(runs[0].id, RunState::done);
  place.end(runs[1].id, RunState::no_scans);  // of a night that, by the right clock, is still to come
  place.look("2026-02-28T12:00:00Z");
  CHECK(place.queued().empty());
  place.look("2026-03-02T06:00:00Z");
  CHECK(texts(place.queued()) == Texts{"2026-03-02T05:00:00Z"});
}

TEST_CASE("many missed runs are all made") {
  ClockedPlace place(plan_of("*/5 * * * *", CatchUp::all, "UTC"), parse_rfc3339("2026-03-01T00:00:00Z"));
  place.look("2026-03-03T00:10:00Z");
  CHECK(place.queued().size() == 2 * 288);
  ClockedPlace latest(plan_of("*/5 * * * *", CatchUp::latest, "UTC"), parse_rfc3339("2026-03-01T00:00:00Z"));
  latest.look("2026-03-03T01:00:00Z");
  CHECK(texts(latest.queued()) == Texts{"2026-03-03T00:35:00Z", "2026-03-03T00:40:00Z", "2026-03-03T00:45:00Z",
                                        "2026-03-03T00:50:00Z"});  // all that are punctual
}

TEST_CASE("whenever it is looked at, right across changes of the clocks, every run is made once and in order") {
  CHECK(rc::check([] {
    const std::string zone = *rc::gen::element<std::string>("Europe/Berlin", "Australia/Lord_Howe", "America/Santiago",
                                                            "Australia/Perth", "UTC");
    const std::string cron =
        *rc::gen::element<std::string>("30 2 * * *", "0 */6 * * *", "15 0,3 * * mon-fri", "59 23 1 * *");
    const Time since =
        parse_rfc3339(*rc::gen::element("2026-03-20T00:00:00Z", "2026-09-28T07:00:00Z", "2026-10-20T13:17:00Z"));
    ClockedPlace place(plan_of(cron, CatchUp::all, zone), since);
    Time now = since;
    for (const int hours : *rc::gen::resize(12, rc::gen::container<std::vector<int>>(rc::gen::inRange(-5, 80)))) {
      place.look(std::max<Time>(since, now + std::chrono::hours(hours)));  // also backwards
      now = std::max<Time>(now, now + std::chrono::hours(hours));
    }
    RC_ASSERT(texts(place.queued()) == texts(expected(cron, zone, since, now - 10min)));
  }));
}

}  // namespace
}  // namespace raywatch
