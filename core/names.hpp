#pragma once

#include <array>
#include <string>
#include <string_view>
#include <utility>

#include "core/error.hpp"

namespace raywatch {

/// The names of an enumeration's values, as they stand in JSON, on the command line and in messages.
template <class Enum, std::size_t N>
using Names = std::array<std::pair<Enum, std::string_view>, N>;

template <class Enum, std::size_t N>
std::string_view name_of(const Names<Enum, N>& names, Enum value) {
  for (const auto& [known, name] : names) {
    if (known == value) return name;
  }
  return "unknown";
}

/// @throws InvalidInput naming `what` and the known names.
template <class Enum, std::size_t N>
Enum value_of(const Names<Enum, N>& names, std::string_view text, const char* what) {
  std::string list;
  for (const auto& [value, name] : names) {
    if (name == text) return value;
    list += list.empty() ? "" : ", ";
    list += name;
  }
  const std::string message = "\"" + std::string(text.substr(0, 64)) + "\" is none of " + list;
  throw InvalidInput("Unknown " + std::string(what) + ": " + message + ".", {{what, message}});
}

}  // namespace raywatch
