#include "api/field_errors.hpp"

#include <algorithm>
#include <optional>

#include "core/nearest_name.hpp"

namespace raywatch {
namespace {

std::optional<std::string> nearest(std::string_view name, std::span<const std::string> known) {
  constexpr std::size_t longest_name = 64;
  if (known.empty() || name.size() > longest_name) return std::nullopt;
  const auto distance = [&](const std::string& candidate) { return edit_distance(name, candidate); };
  const auto best = std::ranges::min_element(known, {}, distance);
  const std::size_t tolerated = std::max<std::size_t>(2, best->size() / 2);
  if (distance(*best) > tolerated) return std::nullopt;
  return *best;
}

}  // namespace

void FieldErrors::add(std::string_view field, std::string_view message) {
  errors_.push_back({std::string(field), std::string(message)});
}

void FieldErrors::throw_if_any() const {
  if (errors_.empty()) return;
  std::string summary;
  for (const FieldError& error : errors_) {
    if (!summary.empty()) summary += "; ";
    summary += error.field.empty() ? error.message : error.field + ": " + error.message;
  }
  throw InvalidInput(summary, errors_);
}

std::string suggestion(std::string_view name, std::span<const std::string> known) {
  if (const auto near = nearest(name, known)) return "; did you mean '" + *near + "'?";
  if (known.empty()) return "; none is known here";
  std::string list = "; known are ";
  for (std::size_t i = 0; i < known.size(); ++i) list += (i == 0 ? "" : ", ") + known[i];
  return list;
}

}  // namespace raywatch
