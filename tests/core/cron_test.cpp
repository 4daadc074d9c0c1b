#include "core/cron.hpp"

#include <doctest/doctest.h>
#include <rapidcheck.h>

#include "core/error.hpp"
#include "storage/local_time.hpp"

namespace raywatch {
namespace {

using namespace std::chrono_literals;
namespace chrono = std::chrono;

std::vector<std::string> texts(const std::vector<Time>& times) {
  std::vector<std::string> result;
  for (const Time time : times) result.push_back(format_rfc3339(time));
  return result;
}

std::vector<std::string> runs(const char* cron, const char* zone, const char* after, const char* until) {
  return texts(runs_between(parse_cron(cron), zone_clock(zone), parse_rfc3339(after), parse_rfc3339(until), 1000));
}

using Texts = std::vector<std::string>;

std::string complaint(const char* cron) {
  try {
    parse_cron(cron);
  } catch (const InvalidInput& error) {
    REQUIRE(error.fields().front().field == "cron");
    return error.fields().front().message;
  }
  return "";
}

/// The definition, minute by minute: a minute runs when the expression names what its clocks show, unless they showed
/// it before; and at the end of a gap when the expression names a time in it.
std::vector<Time> runs_by_definition(const CronExpression& cron, const ZoneClock& zone, Time after, Time until) {
  const auto names = [&](LocalMinutes local) { return next_local(cron, local - 1min) == local; };
  const auto local_at = [&](Time time) { return chrono::floor<chrono::minutes>(zone.to_local(time)); };
  std::vector<Time> result;
  LocalMinutes latest = local_at(after);
  for (Time time = after - 3h; time <= after; time += 1min) latest = std::max(latest, local_at(time));
  for (Time time = after + 1min; time <= until; time += 1min) {
    bool due = false;
    for (; latest < local_at(time); latest += 1min) due = due || names(latest + 1min);
    if (due) result.push_back(time);
  }
  return result;
}

TEST_CASE("lists, ranges, steps, names and words are understood") {
  CHECK(runs("0 2 * * *", "UTC", "2026-03-01T02:00:00Z", "2026-03-03T02:00:00Z") ==
        Texts{"2026-03-02T02:00:00Z", "2026-03-03T02:00:00Z"});
  CHECK(runs("*/20,5 6-7 * * *", "UTC", "2026-03-01T00:00:00Z", "2026-03-01T07:00:00Z") ==
        Texts{"2026-03-01T06:00:00Z", "2026-03-01T06:05:00Z", "2026-03-01T06:20:00Z", "2026-03-01T06:40:00Z",
              "2026-03-01T07:00:00Z"});
  CHECK(runs("0 0 * feb-MAR Mon", "UTC", "2026-02-20T00:00:00Z", "2026-03-03T00:00:00Z") ==
        Texts{"2026-02-23T00:00:00Z", "2026-03-02T00:00:00Z"});
  CHECK(runs("0 0 29 2 *", "UTC", "2026-01-01T00:00:00Z", "2033-01-01T00:00:00Z") ==
        Texts{"2028-02-29T00:00:00Z", "2032-02-29T00:00:00Z"});
  CHECK(runs("@weekly", "UTC", "2026-03-01T00:00:00Z", "2026-03-15T00:00:00Z") ==
        runs("0 0 * * 7", "UTC", "2026-03-01T00:00:00Z", "2026-03-15T00:00:00Z"));
  CHECK(runs("10-20/5 1 1 1 *", "UTC", "2026-01-01T00:00:00Z", "2026-02-01T00:00:00Z").size() == 3);
}

TEST_CASE("of two days that are named either is enough, but a star names none") {
  // The Fridays of March 2026 are 6, 13, 20 and 27; the 14th is a Saturday.
  CHECK(runs("0 0 14 3 fri", "UTC", "2026-03-01T00:00:00Z", "2026-04-01T00:00:00Z").size() == 5);
  CHECK(runs("0 0 */2 3 fri", "UTC", "2026-03-01T00:00:00Z", "2026-04-01T00:00:00Z") ==
        Texts{"2026-03-13T00:00:00Z", "2026-03-27T00:00:00Z"});
}

TEST_CASE("what is wrong is said, and in which field") {
  CHECK(complaint("* * * *").find("five fields") != std::string::npos);
  CHECK(complaint("60 * * * *") == "minute: \"60\": must be 0 to 59");
  CHECK(complaint("* * 0 * *") == "day of the month: \"0\": must be 1 to 31");
  CHECK(complaint("* 5-2 * * *") == "hour: \"5-2\": the range runs backwards");
  CHECK(complaint("*/0 * * * *") == "minute: \"*/0\": a step must be at least 1");
  CHECK(complaint("5/2 * * * *") == "minute: \"5/2\": a step needs * or a range before it");
  CHECK(complaint("* * * foo *") == "month: \"foo\": is no value");
  CHECK(complaint("1,, * * * *") == "minute: \"\": is no value");
  CHECK(complaint("0 0 30 2 *") == "day of the month: none of the months has such a day");
  CHECK(complaint("@often").find("@daily") != std::string::npos);
}

TEST_CASE("a time that clocks skip runs once, when the gap ends") {
  // Berlin, 2026-03-29: 02:00 becomes 03:00 at 01:00 UTC.
  CHECK(runs("30 2 * * *", "Europe/Berlin", "2026-03-28T12:00:00Z", "2026-03-30T12:00:00Z") ==
        Texts{"2026-03-29T01:00:00Z", "2026-03-30T00:30:00Z"});
  CHECK(runs("*/20 2-3 29 3 *", "Europe/Berlin", "2026-03-28T12:00:00Z", "2026-03-30T12:00:00Z") ==
        Texts{"2026-03-29T01:00:00Z", "2026-03-29T01:20:00Z", "2026-03-29T01:40:00Z"});
}

TEST_CASE("a time that comes twice runs once, the first time") {
  // Berlin, 2026-10-25: 03:00 becomes 02:00 at 01:00 UTC.
  CHECK(runs("30 2 * * *", "Europe/Berlin", "2026-10-24T12:00:00Z", "2026-10-26T12:00:00Z") ==
        Texts{"2026-10-25T00:30:00Z", "2026-10-26T01:30:00Z"});
  CHECK(runs("@hourly", "Europe/Berlin", "2026-10-24T23:00:00Z", "2026-10-25T03:00:00Z") ==
        Texts{"2026-10-25T00:00:00Z", "2026-10-25T02:00:00Z", "2026-10-25T03:00:00Z"});
}

TEST_CASE("zones with odd changes: half an hour, at midnight, a whole day") {
  // Lord Howe goes forward by half an hour at 02:00 on 2026-10-04, which is 15:30 UTC of the day before.
  CHECK(runs("15 2 4 10 *", "Australia/Lord_Howe", "2026-10-01T00:00:00Z", "2026-10-09T00:00:00Z") ==
        Texts{"2026-10-03T15:30:00Z"});
  // Chile skips midnight: on 2026-09-06 00:00 becomes 01:00, at 04:00 UTC.
  CHECK(runs("@daily", "America/Santiago", "2026-09-05T12:00:00Z", "2026-09-06T12:00:00Z") ==
        Texts{"2026-09-06T04:00:00Z"});
  // Samoa had no 30 December 2011.
  CHECK(runs("0 12 30 12 *", "Pacific/Apia", "2011-12-28T00:00:00Z", "2012-01-05T00:00:00Z") ==
        Texts{"2011-12-30T10:00:00Z"});
}

TEST_CASE("around every change of the clocks, runs are those of the definition") {
  struct Change {
    const char* zone;
    const char* at;
  };
  const std::vector<Change> changes{
      {"Europe/Berlin", "2026-03-29T01:00:00Z"},       {"Europe/Berlin", "2026-10-25T01:00:00Z"},
      {"America/New_York", "2026-03-08T07:00:00Z"},    {"America/New_York", "2026-11-01T06:00:00Z"},
      {"Australia/Lord_Howe", "2026-10-03T15:30:00Z"}, {"Australia/Lord_Howe", "2026-04-04T15:00:00Z"},
      {"America/Santiago", "2026-09-06T04:00:00Z"},    {"America/Santiago", "2026-04-05T03:00:00Z"},
      {"Asia/Kolkata", "2026-06-01T00:00:00Z"}};
  CHECK(rc::check([&] {
    const Change change = changes[*rc::gen::inRange<std::size_t>(0, changes.size())];
    const std::string minute = *rc::gen::element(std::string("*/7"), std::string("0"), std::string("15,45"));
    const std::string hour =
        *rc::gen::element(std::string("*"), std::string("0-3"), std::string("*/2"), std::string("2"));
    const CronExpression cron = parse_cron(minute + " " + hour + " * * *");
    const ZoneClock zone = zone_clock(change.zone);
    const Time after = parse_rfc3339(change.at) + chrono::minutes(*rc::gen::inRange(-300, 100));
    const Time until = after + 6h;
    RC_ASSERT(texts(runs_between(cron, zone, after, until, 1000)) ==
              texts(runs_by_definition(cron, zone, after, until)));
  }));
}

TEST_CASE("asking again from any moment gives the same runs, never one twice") {
  const CronExpression cron = parse_cron("*/10 * * * *");
  const ZoneClock zone = zone_clock("Europe/Berlin");
  CHECK(rc::check([&] {
    const Time after = parse_rfc3339("2026-10-25T00:00:00Z") + chrono::seconds(*rc::gen::inRange(-9000, 9000));
    const Time run = next_run(cron, zone, after).value();
    RC_ASSERT(run > after);
    const Time between = after + chrono::seconds(*rc::gen::inRange<std::int64_t>(0, (run - after) / 1s));
    RC_ASSERT(next_run(cron, zone, between).value() == run);
  }));
}

TEST_CASE("no more runs are listed than asked for") {
  const Time from = parse_rfc3339("2026-01-01T00:00:00Z");
  CHECK(runs_between(parse_cron("* * * * *"), zone_clock("UTC"), from, from + 24h, 5).size() == 5);
}

}  // namespace
}  // namespace raywatch
