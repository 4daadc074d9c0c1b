#pragma once

#include <string>

#include "core/cron.hpp"
#include "core/schedule.hpp"
#include "core/time.hpp"

namespace raywatch {

/// The moment as clocks of a time zone show it, by the time zone data of this machine.
/// @param time_zone IANA name. @throws InvalidInput when it is not known here.
LocalMoment local_moment(Time time, const std::string& time_zone);
/// The same for people, with the zone's abbreviation: "2026-03-01 09:05:12 CET".
std::string local_text(Time time, const std::string& time_zone);

/// The clocks of a time zone, by the time zone data of this machine. May be kept and used by any thread.
/// @param time_zone IANA name. @throws InvalidInput when it is not known here.
ZoneClock zone_clock(const std::string& time_zone);

}  // namespace raywatch
