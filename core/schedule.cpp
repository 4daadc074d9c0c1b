#include "core/schedule.hpp"

#include <algorithm>
#include <cstdio>

#include "core/error.hpp"

namespace raywatch {
namespace {

constexpr std::array<std::string_view, 7> kWeekdays{"mon", "tue", "wed", "thu", "fri", "sat", "sun"};
constexpr std::uint32_t kSecondsPerMinute = 60;

bool holds_at(const ScheduleWindow& window, const LocalMoment& moment) {
  const std::uint32_t from = window.from_minute * kSecondsPerMinute, to = window.to_minute * kSecondsPerMinute;
  const std::size_t today = moment.weekday, yesterday = (moment.weekday + 6u) % 7;
  if (from < to) return window.days[today] && moment.second >= from && moment.second < to;
  return (window.days[today] && moment.second >= from) || (window.days[yesterday] && moment.second < to);
}

bool is_digit(char c) { return c >= '0' && c <= '9'; }

}  // namespace

bool holds_at(const Schedule& schedule, const LocalMoment& moment) {
  return schedule.empty() || std::any_of(schedule.begin(), schedule.end(),
                                         [&](const ScheduleWindow& window) { return holds_at(window, moment); });
}

std::size_t parse_weekday(std::string_view name) {
  const auto found = std::find(kWeekdays.begin(), kWeekdays.end(), name);
  if (found == kWeekdays.end()) throw InvalidInput("must be mon, tue, wed, thu, fri, sat or sun");
  return static_cast<std::size_t>(found - kWeekdays.begin());
}

std::string_view weekday_name(std::size_t weekday) { return kWeekdays.at(weekday); }

std::uint16_t parse_minute_of_day(std::string_view text) {
  const bool formed = text.size() == 5 && is_digit(text[0]) && is_digit(text[1]) && text[2] == ':' &&
                      is_digit(text[3]) && is_digit(text[4]);
  const int hour = formed ? (text[0] - '0') * 10 + text[1] - '0' : 0;
  const int minute = formed ? (text[3] - '0') * 10 + text[4] - '0' : 0;
  if (!formed || minute > 59 || hour * 60 + minute > 1440) {
    throw InvalidInput("must be a time of the day, 00:00 to 24:00");
  }
  return static_cast<std::uint16_t>(hour * 60 + minute);
}

std::string format_minute_of_day(std::uint16_t minute) {
  char text[16];
  std::snprintf(text, sizeof text, "%02d:%02d", minute / 60, minute % 60);
  return text;
}

}  // namespace raywatch
