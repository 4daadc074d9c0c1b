#include "api/query.hpp"

#include <algorithm>

#include "core/nearest_name.hpp"

namespace raywatch {

Query::Query(std::string_view query) {
  if (query.empty()) return;
  for (const std::string_view part : split(query, '&')) {
    if (part.empty()) continue;
    const std::size_t equals = part.find('=');
    const auto name = percent_decoded(part.substr(0, equals), true);
    const auto value = equals == std::string_view::npos ? std::optional<std::string>("")
                                                        : percent_decoded(part.substr(equals + 1), true);
    if (!name) {
      fail("", "a parameter's name has a broken %-escape or is not UTF-8");
    } else if (!value) {
      fail(*name, "has a broken %-escape or is not UTF-8");
    } else if (has(*name)) {
      fail(*name, "is given more than once");
    } else {
      values_.emplace_back(*name, *value);
    }
  }
}

bool Query::has(std::string_view name) const {
  return std::ranges::any_of(values_, [&](const auto& value) { return value.first == name; });
}

std::optional<std::string> Query::text(std::string_view name) {
  if (std::ranges::find(known_, name) == known_.end()) known_.emplace_back(name);
  const auto found = std::ranges::find_if(values_, [&](const auto& value) { return value.first == name; });
  if (found == values_.end()) return std::nullopt;
  if (found->second.empty()) {
    fail(name, "is empty");
    return std::nullopt;
  }
  return found->second;
}

std::optional<double> Query::real(std::string_view name, const RealBounds& bounds) {
  const auto given = text(name);
  if (!given) return std::nullopt;
  const auto value = parse_finite(*given);
  const auto wrong = value ? complaint(*value, bounds) : std::optional<std::string>("must be a finite number");
  if (wrong) fail(name, *wrong);
  return wrong ? std::nullopt : value;
}

std::optional<std::int64_t> Query::integer(std::string_view name, const IntegerBounds& bounds) {
  const auto given = text(name);
  if (!given) return std::nullopt;
  const auto value = parse_integer(*given);
  const auto wrong =
      value ? complaint(*value, bounds) : complaint_of_no_integer(parse_finite(*given).value_or(0.0), bounds);
  if (wrong) fail(name, *wrong);
  return wrong ? std::nullopt : value;
}

std::optional<Time> Query::time(std::string_view name) {
  return parsed(name, [](std::string value) {
    const std::size_t blank = value.rfind(' ');
    if (blank != std::string::npos && blank > std::string_view("2026-01-01").size()) value[blank] = '+';
    return parse_rfc3339(value);
  });
}

TimeRange Query::time_range() {
  const TimeRange range{time("from"), time("to")};
  if (range.from && range.to && *range.from >= *range.to) fail("to", "must be later than 'from'");
  return range;
}

std::optional<std::vector<double>> Query::reals(std::string_view name, std::size_t count) {
  const auto given = text(name);
  if (!given) return std::nullopt;
  std::vector<double> values;
  for (const std::string_view part : split(*given, ','))
    if (const auto value = parse_finite(without_blanks(part))) values.push_back(*value);
  if (values.size() == count && std::ranges::count(*given, ',') == static_cast<std::ptrdiff_t>(count) - 1) {
    return values;
  }
  fail(name, "must be " + std::to_string(count) + " finite numbers with commas between them");
  return std::nullopt;
}

std::optional<Eigen::Vector3d> Query::vector3(std::string_view name) {
  const auto values = reals(name, 3);
  if (!values) return std::nullopt;
  return Eigen::Vector3d((*values)[0], (*values)[1], (*values)[2]);
}

std::optional<Eigen::AlignedBox3d> Query::box(std::string_view name) {
  const auto values = reals(name, 6);
  if (!values) return std::nullopt;
  const Eigen::Map<const Eigen::Vector3d> low(values->data()), high(values->data() + 3);
  if ((low.array() > high.array()).any()) {
    fail(name, "must have its lower corner first");
    return std::nullopt;
  }
  return Eigen::AlignedBox3d(low, high);
}

std::optional<std::vector<std::string>> Query::list(std::string_view name) {
  const auto given = text(name);
  if (!given) return std::nullopt;
  std::vector<std::string> items;
  for (const std::string_view part : split(*given, ',')) {
    if (part.empty()) {
      fail(name, "has an empty entry");
      return std::nullopt;
    }
    items.emplace_back(part);
  }
  return items;
}

PageRequest Query::page() {
  PageRequest request;
  if (const auto limit = integer("limit", {.min = 1, .max = 1000})) request.limit = static_cast<std::size_t>(*limit);
  request.cursor = text("cursor");
  return request;
}

void Query::require(std::string_view name) {
  if (!has(name)) fail(name, "is required");
}

void Query::finish() {
  for (const auto& [name, value] : values_)
    if (std::ranges::find(known_, name) == known_.end()) fail(name, "unknown parameter" + suggestion(name, known_));
  errors_.throw_if_any();
}

}  // namespace raywatch
