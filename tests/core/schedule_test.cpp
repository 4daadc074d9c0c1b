#include "core/schedule.hpp"

#include <doctest/doctest.h>
#include <rapidcheck.h>

#include "core/error.hpp"

namespace raywatch {
namespace {

constexpr std::uint8_t kFriday = 4, kSaturday = 5, kSunday = 6, kMonday = 0;

LocalMoment at(std::uint8_t weekday, const char* time) { return {weekday, parse_minute_of_day(time) * 60u}; }

ScheduleWindow window(std::initializer_list<std::size_t> days, const char* from, const char* to) {
  ScheduleWindow result{.days = {}, .from_minute = parse_minute_of_day(from), .to_minute = parse_minute_of_day(to)};
  for (const std::size_t day : days) result.days[day] = true;
  return result;
}

TEST_CASE("without windows a schedule always holds") { CHECK(holds_at({}, at(kFriday, "12:00"))); }

TEST_CASE("hours of a day begin with their first minute and end before their last") {
  const Schedule office{window({kFriday}, "08:00", "17:30")};
  CHECK_FALSE(holds_at(office, at(kFriday, "07:59")));
  CHECK(holds_at(office, at(kFriday, "08:00")));
  CHECK(holds_at(office, at(kFriday, "17:29")));
  CHECK_FALSE(holds_at(office, at(kFriday, "17:30")));
  CHECK_FALSE(holds_at(office, at(kSaturday, "12:00")));
}

TEST_CASE("a night belongs to the day on which it begins, also from Sunday to Monday") {
  const Schedule nights{window({kFriday, kSunday}, "22:00", "06:00")};
  CHECK(holds_at(nights, at(kFriday, "23:00")));
  CHECK(holds_at(nights, at(kSaturday, "05:59")));
  CHECK_FALSE(holds_at(nights, at(kSaturday, "06:00")));
  CHECK_FALSE(holds_at(nights, at(kSaturday, "23:00")));
  CHECK(holds_at(nights, at(kMonday, "02:00")));
  CHECK_FALSE(holds_at(nights, at(kFriday, "02:00")));
}

TEST_CASE("two windows that complete each other hold at every moment, and never both") {
  CHECK(rc::check([] {
    const auto minutes =
        *rc::gen::pair(rc::gen::inRange<std::uint16_t>(0, 1440), rc::gen::inRange<std::uint16_t>(0, 1440));
    RC_PRE(minutes.first != minutes.second);
    const ScheduleWindow one{.from_minute = minutes.first, .to_minute = minutes.second};
    const ScheduleWindow other{.from_minute = minutes.second, .to_minute = minutes.first};
    const LocalMoment moment{*rc::gen::inRange<std::uint8_t>(0, 7), *rc::gen::inRange<std::uint32_t>(0, 86400)};
    RC_ASSERT(holds_at({one}, moment) != holds_at({other}, moment));
    RC_ASSERT(holds_at({one, other}, moment));
  }));
}

TEST_CASE("days and hours are written as people write them, and nothing else is taken") {
  CHECK(parse_weekday("sun") == 6);
  CHECK(weekday_name(0) == "mon");
  CHECK(format_minute_of_day(parse_minute_of_day("24:00")) == "24:00");
  CHECK(format_minute_of_day(parse_minute_of_day("06:05")) == "06:05");
  for (const char* wrong : {"24:01", "6:05", "06:60", "06-05", "", "06:055"}) {
    CHECK_THROWS_AS(parse_minute_of_day(wrong), InvalidInput);
  }
  CHECK_THROWS_AS(parse_weekday("Sunday"), InvalidInput);
}

}  // namespace
}  // namespace raywatch
