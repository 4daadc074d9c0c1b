#pragma once

#include <string>

namespace raywatch {

/// Whether it is a control character of ASCII.
bool is_control(char c);

/// The name of a site or sensor: 1 to 100 bytes of UTF-8 that can stand in an address.
/// @throws InvalidInput.
std::string checked_name(const std::string& name);

/// Who does something: 1 to 100 bytes of UTF-8 without control characters. @throws InvalidInput.
std::string checked_actor(const std::string& name);
/// Why: at most 2000 bytes. @throws InvalidInput.
std::string checked_note(const std::string& note);

/// @throws InvalidInput unless it is an IANA time zone that this machine knows.
std::string checked_time_zone(const std::string& name);

}  // namespace raywatch
