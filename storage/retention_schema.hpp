#pragma once

#include <string_view>

namespace raywatch {

/// The fifth version of the metadata: what retention needs. The conventions are those of schema.cpp.
///
/// In `sites`, null is "as configured for all sites", and 0 "not at this site". A deletion is a record of what is gone:
/// its scan, site and sensor are plain numbers.
inline constexpr std::string_view kMetadata5 = R"sql(
ALTER TABLE sites ADD COLUMN retention_max_age_days INTEGER;
ALTER TABLE sites ADD COLUMN retention_max_bytes INTEGER;
ALTER TABLE sites ADD COLUMN retention_min_free_bytes INTEGER;
ALTER TABLE comparisons ADD COLUMN stored_bytes INTEGER NOT NULL DEFAULT 0;
CREATE INDEX scans_by_receipt ON scans (site, received_at, id);
CREATE INDEX scans_pinned ON scans (site) WHERE pinned = 1;

CREATE TABLE deletions (
  id INTEGER PRIMARY KEY AUTOINCREMENT,
  at INTEGER NOT NULL,
  day INTEGER NOT NULL,           -- of `at`, since 1970
  what TEXT NOT NULL,
  reason TEXT NOT NULL,
  site INTEGER,
  sensor INTEGER, scan INTEGER, captured_at INTEGER, received_at INTEGER,
  records INTEGER NOT NULL,
  bytes INTEGER NOT NULL
) STRICT;
CREATE INDEX deletions_by_site ON deletions (site);
CREATE INDEX deletions_of_logs ON deletions (what, day) WHERE scan IS NULL;
)sql";

}  // namespace raywatch
