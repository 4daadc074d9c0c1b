#pragma once

#include <chrono>
#include <cstdint>
#include <string>
#include <vector>

#include "core/ids.hpp"
#include "core/time.hpp"
#include "storage/store.hpp"

namespace raywatch {

/// A day as the clocks of a time zone have it: 23 or 25 hours when they are changed.
struct CalendarDay {
  std::chrono::year_month_day date;
  Time from, to;  ///< from included, to not
};

/// The days of a time zone that [from, to) touches, in order.
/// @param time_zone IANA name. @throws InvalidInput when it is not known here.
std::vector<CalendarDay> days_between(Time from, Time to, const std::string& time_zone);

/// What happened at a site in a span of time.
struct SpanCounts {
  std::uint64_t scans = 0;   ///< captured in it
  std::uint64_t tracks = 0;  ///< first seen in it
  std::uint64_t alerts = 0;  ///< opened in it
};
/// @param from included. @param to not.
SpanCounts counts_between(const Snapshot& snapshot, SiteId site, Time from, Time to);

}  // namespace raywatch
