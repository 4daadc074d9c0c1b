#include "api/name_rules.hpp"

#include <algorithm>
#include <filesystem>
#include <string_view>

#include "core/error.hpp"

namespace raywatch {
namespace {

bool is_zone_character(char c) {
  return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' || c == '-' ||
         c == '+' || c == '/';
}

}  // namespace

bool is_control(char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7F; }

std::string checked_name(const std::string& name) {
  if (name.empty() || name.size() > 100) throw InvalidInput("must have 1 to 100 bytes");
  if (name == "." || name == "..") throw InvalidInput("must not be '.' or '..', which addresses leave out");
  if (name.front() == ' ' || name.back() == ' ') throw InvalidInput("must not start or end with a blank");
  if (std::ranges::any_of(name, [](char c) { return is_control(c) || c == '/' || c == '\\'; })) {
    throw InvalidInput("must not have slashes or control characters");
  }
  return name;
}

std::string checked_actor(const std::string& name) {
  if (name.empty() || name.size() > 100) throw InvalidInput("must have 1 to 100 bytes");
  if (std::ranges::any_of(name, is_control)) throw InvalidInput("must not have control characters");
  return name;
}

std::string checked_note(const std::string& note) {
  if (note.size() > 2000) throw InvalidInput("must have at most 2000 bytes");
  return note;
}

std::string checked_time_zone(const std::string& name) {
  static const std::filesystem::path zones = "/usr/share/zoneinfo";
  if (name == "UTC") return name;
  const bool well_formed =
      !name.empty() && name.size() <= 64 && name.front() != '/' && std::ranges::all_of(name, is_zone_character);
  std::error_code error;
  if (!well_formed || !std::filesystem::is_regular_file(zones / name, error)) {
    throw InvalidInput("must be the IANA name of a time zone, such as Europe/Berlin");
  }
  return name;
}

}  // namespace raywatch
