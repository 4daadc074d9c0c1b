#pragma once

#include <bitset>
#include <chrono>
#include <functional>
#include <optional>
#include <string_view>
#include <vector>

#include "core/time.hpp"

namespace raywatch {

/// A moment as the clocks of some time zone show it.
using LocalSeconds = std::chrono::local_time<std::chrono::seconds>;
using LocalMinutes = std::chrono::local_time<std::chrono::minutes>;

/// The clocks of a time zone; the data comes from outside (storage/local_time.hpp).
struct ZoneClock {
  std::function<LocalSeconds(Time)> to_local;
  /// Of a local time that is skipped when clocks go forward, the moment at which they do; of one that comes twice, the
  /// first.
  std::function<Time(LocalSeconds)> to_utc;
};

/// When something runs, by the minute: minute, hour, day of the month, month, day of the week (0: Sunday).
struct CronExpression {
  std::bitset<60> minutes;
  std::bitset<24> hours;
  std::bitset<32> days;    ///< 1..31
  std::bitset<13> months;  ///< 1..12
  std::bitset<7> weekdays;
  /// Both day fields name days: then either is enough, as in cron(8). Otherwise both must hold.
  bool either_day = false;
};

/// Reads five fields, each a list of `*`, a value, or a range `a-b`, with a step `/n`; months and days of the week also
/// by the first three letters of their names, Sunday as 0 or 7. Or one of @hourly, @daily, @midnight, @weekly,
/// @monthly,
/// @yearly, @annually. As crontab(5), but for names in lists and ranges, which are allowed here.
/// @throws InvalidInput naming the field `cron` and what is wrong in it, also when no such day exists (30 February).
CronExpression parse_cron(std::string_view text);

/// The first local time after `after` that the expression names, as a calendar without time zone has it. Nothing when
/// there is none within 30 years.
std::optional<LocalMinutes> next_local(const CronExpression& cron, LocalMinutes after);

/// The first run after `after`. Each local time that the expression names runs once: one that clocks skip runs when the
/// skipped time ends (together with others of that gap and with that minute's own), one that comes twice runs the first
/// time. Therefore an hourly schedule makes a pause of two hours when clocks go back.
std::optional<Time> next_run(const CronExpression& cron, const ZoneClock& zone, Time after);

/// The runs after `after`, up to and with `until`, in order; at most `most`.
std::vector<Time> runs_between(const CronExpression& cron, const ZoneClock& zone, Time after, Time until,
                               std::size_t most);

}  // namespace raywatch
