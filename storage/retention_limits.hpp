#pragma once

#include <cstdint>
#include <optional>

namespace raywatch {

/// How long, and how much, is kept of a site's scans. Of a site, nothing means "as configured for all sites", and 0 "no
/// such limit here"; of what is in force (`limits_in_force`), nothing means "no such limit".
struct RetentionLimits {
  std::optional<std::uint64_t> max_age_days;    ///< since the receipt; capture times may be wrong, or long ago
  std::optional<std::uint64_t> max_bytes;       ///< of the site's payload files
  std::optional<std::uint64_t> min_free_bytes;  ///< of the disk
  friend bool operator==(const RetentionLimits&, const RetentionLimits&) = default;
};

/// What holds at a site.
RetentionLimits limits_in_force(const RetentionLimits& of_site, const RetentionLimits& defaults);

/// Whether anything may ever be deleted.
inline bool is_on(const RetentionLimits& in_force) {
  return in_force.max_age_days || in_force.max_bytes || in_force.min_free_bytes;
}

}  // namespace raywatch
