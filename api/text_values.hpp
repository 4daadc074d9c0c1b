#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace raywatch {

/// Closed bounds of a number; `exclusive_min` opens the lower one.
struct RealBounds {
  double min = std::numeric_limits<double>::lowest();
  double max = std::numeric_limits<double>::max();
  bool exclusive_min = false;
};
struct IntegerBounds {
  std::int64_t min = std::numeric_limits<std::int64_t>::min();
  std::int64_t max = std::numeric_limits<std::int64_t>::max();
};

/// What is wrong with a number ("must be at least 0"); nothing when it is within its bounds.
std::optional<std::string> complaint(double value, const RealBounds& bounds);
std::optional<std::string> complaint(std::int64_t value, const IntegerBounds& bounds);
/// What is wrong with a number that is no integer of 64 bits: it is not whole, or far beyond the bounds.
std::string complaint_of_no_integer(double value, const IntegerBounds& bounds);

/// The whole text as a finite number.
std::optional<double> parse_finite(std::string_view text);
std::optional<std::int64_t> parse_integer(std::string_view text);

std::vector<std::string_view> split(std::string_view text, char separator);
std::string_view without_blanks(std::string_view text);  ///< without blanks and tabs around it
std::string lower(std::string_view text);                ///< ASCII
bool is_utf8(std::string_view text);

/// Decodes %XX, and '+' as a blank when asked. Nothing when an escape is malformed or the result is no UTF-8.
std::optional<std::string> percent_decoded(std::string_view text, bool plus_is_blank);
/// Encodes everything but unreserved characters.
std::string percent_encoded(std::string_view text);

/// Shortest text that reads back as the same number.
std::string to_text(double value);

}  // namespace raywatch
