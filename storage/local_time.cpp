#include "storage/local_time.hpp"

#include <date/tz.h>

#include "core/error.hpp"

namespace raywatch {

LocalMoment local_moment(Time time, const std::string& time_zone) {
  try {
    const auto local = date::locate_zone(time_zone)->to_local(date::floor<std::chrono::seconds>(time));
    const auto day = date::floor<date::days>(local);
    return {.weekday = static_cast<std::uint8_t>(date::weekday(day).iso_encoding() - 1),
            .second = static_cast<std::uint32_t>((local - day).count())};
  } catch (const std::runtime_error&) {
    throw InvalidInput("The time zone " + time_zone + " is not known on this machine; install tzdata.");
  }
}

}  // namespace raywatch
