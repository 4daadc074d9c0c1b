#include "core/nearest_name.hpp"

#include <algorithm>
#include <utility>
#include <vector>

namespace raywatch {
namespace {

std::size_t own_letters(std::string_view name) { return name.size() - (name.rfind('.') + 1); }

/// Whether one of the names begins with all of the other, and that says something.
bool goes_on(std::string_view a, std::string_view b) {
  constexpr std::size_t kTelling = 3;
  return std::min(own_letters(a), own_letters(b)) >= kTelling && (a.starts_with(b) || b.starts_with(a));
}

}  // namespace

// Optimal string alignment: three rows of the table of distances between the prefixes of both words.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before_last(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::swap(before_last, last);
    std::swap(last, row);
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t replaced = last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, replaced});
      const bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (swapped) row[j] = std::min(row[j], before_last[j - 2] + 1);
    }
  }
  return row[b.size()];
}

std::optional<std::string> nearest_name(std::string_view wrong, std::span<const std::string> known) {
  constexpr std::size_t kLongestName = 128;
  if (wrong.size() > kLongestName) return std::nullopt;
  std::optional<std::string> nearest;
  std::pair<bool, std::size_t> least;  // what goes on comes before all else
  for (const std::string& name : known) {
    const std::pair<bool, std::size_t> difference{!goes_on(wrong, name), edit_distance(wrong, name)};
    const std::size_t tolerated = std::max<std::size_t>(1, std::min(own_letters(wrong), own_letters(name)) / 3);
    if (difference.first && difference.second > tolerated) continue;
    if (!nearest || difference < least) {
      nearest = name;
      least = difference;
    }
  }
  return nearest;
}

std::string suggestion(std::string_view wrong, std::span<const std::string> known) {
  if (const auto near = nearest_name(wrong, known)) return "; did you mean '" + *near + "'?";
  if (known.empty()) return "; none is known here";
  std::string list = "; known are ";
  for (std::size_t i = 0; i < known.size(); ++i) list += (i == 0 ? "" : ", ") + known[i];
  return list;
}

}  // namespace raywatch
