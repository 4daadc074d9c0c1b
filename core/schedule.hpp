#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace raywatch {

/// A moment as clocks on the wall show it, in whatever time zone that is.
struct LocalMoment {
  std::uint8_t weekday = 0;  ///< 0: Monday
  std::uint32_t second = 0;  ///< since midnight
};

/// Hours of some days of the week. A window whose end is not after its start runs on into the next morning, and belongs
/// to the day on which it starts.
struct ScheduleWindow {
  std::array<bool, 7> days{true, true, true, true, true, true, true};  ///< Monday first
  std::uint16_t from_minute = 0;                                       ///< of the day, 0..1439
  std::uint16_t to_minute = 1440;                                      ///< exclusive, 1..1440
};

/// When a rule holds: in any of the windows; always when there are none.
using Schedule = std::vector<ScheduleWindow>;

bool holds_at(const Schedule& schedule, const LocalMoment& moment);

/// "mon" ... "sun". @throws InvalidInput for other texts.
std::size_t parse_weekday(std::string_view name);
std::string_view weekday_name(std::size_t weekday);

/// "HH:MM", 00:00 to 24:00, as a minute of the day. @throws InvalidInput.
std::uint16_t parse_minute_of_day(std::string_view text);
std::string format_minute_of_day(std::uint16_t minute);

}  // namespace raywatch
