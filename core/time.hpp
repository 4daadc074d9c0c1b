#pragma once

#include <chrono>
#include <string>
#include <string_view>

namespace raywatch {

/// A moment in UTC. Nanoseconds in 64 bits reach from 1677 to 2262.
using Time = std::chrono::sys_time<std::chrono::nanoseconds>;
using Duration = std::chrono::nanoseconds;

/// From one moment to another, negative when the other is earlier. Moments may lie farther apart than a duration
/// reaches (292 years); then it is the longest one.
Duration between(Time from, Time to);

/// The moment so much later, or earlier when `by` is negative; the last or first one there is when it lies beyond.
Time shifted(Time time, Duration by);

/// Reads an RFC 3339 time with any offset ("2026-03-01T02:10:00.5+01:00"). Fractions finer than a nanosecond are cut.
/// @throws InvalidInput when the text is no such time, a field is out of range, or the year is outside 1678..2261.
Time parse_rfc3339(std::string_view text);

/// The moment in UTC with as many fraction digits as it needs ("2026-03-01T01:10:00.5Z").
std::string format_rfc3339(Time time);

}  // namespace raywatch
