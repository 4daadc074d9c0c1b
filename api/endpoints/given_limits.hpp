#pragma once

#include <optional>

#include "api/json_object.hpp"
#include "storage/retention_limits.hpp"

namespace raywatch::endpoints {

/// The limits that a request gives: a number, null for "as configured for all sites", or nothing.
struct GivenLimits {
  using Given = std::optional<std::optional<std::uint64_t>>;
  Given max_age_days, max_bytes, min_free_bytes;

  /// What is not given stays.
  RetentionLimits applied_to(const RetentionLimits& before) const {
    return {.max_age_days = max_age_days.value_or(before.max_age_days),
            .max_bytes = max_bytes.value_or(before.max_bytes),
            .min_free_bytes = min_free_bytes.value_or(before.min_free_bytes)};
  }
};

inline GivenLimits parse_limits(JsonObject& body) {
  const auto given = [&](const char* name, std::int64_t most) -> GivenLimits::Given {
    if (const auto number = body.integer(name, {.min = 0, .max = most})) {
      return std::optional(static_cast<std::uint64_t>(*number));
    }
    if (body.is_null(name)) return std::optional<std::uint64_t>();
    return std::nullopt;
  };
  constexpr std::int64_t kMostBytes = std::int64_t{1} << 60, kMostDays = 36'500;
  return {.max_age_days = given("max_age_days", kMostDays),
          .max_bytes = given("max_bytes", kMostBytes),
          .min_free_bytes = given("min_free_bytes", kMostBytes)};
}

}  // namespace raywatch::endpoints
