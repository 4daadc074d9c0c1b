#include "storage/local_time.hpp"

#include <date/tz.h>

#include <algorithm>

#include "core/error.hpp"

namespace raywatch {
namespace {

const date::time_zone& zone_named(const std::string& time_zone) {
  try {
    return *date::locate_zone(time_zone);
  } catch (const std::runtime_error&) {
    throw InvalidInput("The time zone " + time_zone + " is not known on this machine; install tzdata.");
  }
}

/// Local times reach farther than moments do: what lies beyond is the last or first one there is.
Time within_reach(date::sys_seconds time) {
  return std::clamp(time, std::chrono::ceil<std::chrono::seconds>(Time::min()),
                    std::chrono::floor<std::chrono::seconds>(Time::max()));
}

}  // namespace

LocalMoment local_moment(Time time, const std::string& time_zone) {
  const auto local = zone_named(time_zone).to_local(date::floor<std::chrono::seconds>(time));
  const auto day = date::floor<date::days>(local);
  return {.weekday = static_cast<std::uint8_t>(date::weekday(day).iso_encoding() - 1),
          .second = static_cast<std::uint32_t>((local - day).count())};
}

ZoneClock zone_clock(const std::string& time_zone) {
  const date::time_zone& zone = zone_named(time_zone);
  return {.to_local =
              [&zone](Time time) {
                return LocalSeconds(zone.to_local(date::floor<std::chrono::seconds>(time)).time_since_epoch());
              },
          // Of a skipped time, `choose` takes the moment at which the clocks go forward.
          .to_utc = [&zone](LocalSeconds local) -> Time {
            return within_reach(zone.to_sys(date::local_seconds(local.time_since_epoch()), date::choose::earliest));
          }};
}

std::string local_text(Time time, const std::string& time_zone) {
  return date::format("%F %T %Z", date::make_zoned(&zone_named(time_zone), date::floor<std::chrono::seconds>(time)));
}

}  // namespace raywatch
