#pragma once

#include <string>

namespace raywatch {

/// The name of a site or sensor: 1 to 100 bytes of UTF-8 that can stand in an address.
/// @throws InvalidInput.
std::string checked_name(const std::string& name);

/// @throws InvalidInput unless it is an IANA time zone that this machine knows.
std::string checked_time_zone(const std::string& name);

}  // namespace raywatch
