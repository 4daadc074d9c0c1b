#include "server/commands/number_options.hpp"

#include <CLI/CLI.hpp>
#include <string>

namespace raywatch {
namespace {

std::string shown(const RealBounds& bounds) {
  return (bounds.exclusive_min ? "above " : "") + to_text(bounds.min) + " to " + to_text(bounds.max);
}

std::string shown(const IntegerBounds& bounds) {
  return std::to_string(bounds.min) + " to " + std::to_string(bounds.max);
}

}  // namespace

CLI::Validator within(const RealBounds& bounds) {
  const auto check = [bounds](std::string& text) -> std::string {
    const auto value = parse_finite(text);
    return value ? complaint(*value, bounds).value_or("") : "must be a finite number, not " + text;
  };
  return {check, shown(bounds)};
}

CLI::Validator within(const IntegerBounds& bounds) {
  const auto check = [bounds](std::string& text) -> std::string {
    const auto value = parse_integer(text);
    // The library would read "010" as an octal number.
    if (!value || std::to_string(*value) != text) return "must be a whole number, not " + text;
    return complaint(*value, bounds).value_or("");
  };
  return {check, shown(bounds)};
}

}  // namespace raywatch
