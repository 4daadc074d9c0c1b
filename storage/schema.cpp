#include <array>

#include "storage/delivery_schema.hpp"
#include "storage/migrations.hpp"
#include "storage/retention_schema.hpp"
#include "storage/survey_schema.hpp"
#include "storage/watch_schema.hpp"

namespace raywatch {
namespace {

// Conventions: times are nanoseconds since 1970 in UTC; places are metres relative to the origin of their site unless
// the name says "reported"; enumerations are their names; `payload_file`, `payload_key` lead to a payload.
// AUTOINCREMENT: an id is never used again. References to things that may be deleted while the record stays (priors,
// candidates, registrations) are plain numbers.
//
// R*Trees keep 32-bit floats: bounds are rounded outwards and widened on the way in (storage/spatial.hpp), and every
// hit is checked again in double. Their first dimension is the site, so that sites do not meet.
constexpr std::string_view kMetadata1 = R"sql(
CREATE TABLE sites (
  id INTEGER PRIMARY KEY AUTOINCREMENT,
  name TEXT NOT NULL UNIQUE,
  time_zone TEXT NOT NULL,
  profile TEXT NOT NULL,
  epsg INTEGER,
  origin_x_m REAL, origin_y_m REAL, origin_z_m REAL,
  created_at INTEGER NOT NULL
) STRICT;

CREATE TABLE sensors (
  id INTEGER PRIMARY KEY AUTOINCREMENT,
  name TEXT NOT NULL UNIQUE,
  site INTEGER NOT NULL REFERENCES sites (id),
  pose BLOB,                      -- 7 doubles, see pose_bytes()
  known TEXT NOT NULL,            -- JSON
  estimated TEXT NOT NULL,        -- JSON
  interval_s REAL,
  created_at INTEGER NOT NULL
) STRICT;
CREATE INDEX sensors_by_site ON sensors (site);

CREATE TABLE vantages (
  id INTEGER PRIMARY KEY AUTOINCREMENT,
  site INTEGER NOT NULL REFERENCES sites (id),
  x_m REAL NOT NULL, y_m REAL NOT NULL, z_m REAL NOT NULL,
  scans INTEGER NOT NULL,
  first_captured_at INTEGER,
  last_captured_at INTEGER
) STRICT;
CREATE INDEX vantages_by_site ON vantages (site);
CREATE VIRTUAL TABLE vantage_places USING rtree (id, site_min, site_max, x_min, x_max, y_min, y_max, z_min, z_max);

CREATE TABLE scans (
  id INTEGER PRIMARY KEY AUTOINCREMENT,
  site INTEGER NOT NULL REFERENCES sites (id),
  sensor INTEGER NOT NULL REFERENCES sensors (id),
  vantage INTEGER NOT NULL REFERENCES vantages (id),
  captured_at INTEGER NOT NULL,
  received_at INTEGER NOT NULL,
  points INTEGER NOT NULL,
  sha256 TEXT NOT NULL,
  reported_pose BLOB NOT NULL,
  registration_state TEXT NOT NULL,
  registration_correction BLOB NOT NULL,
  registration_residual_m REAL,
  registration_against INTEGER,
  estimated TEXT NOT NULL,        -- JSON
  grid_rows INTEGER, grid_columns INTEGER,
  has_intensity INTEGER NOT NULL,
  pinned INTEGER NOT NULL,
  note TEXT NOT NULL,
  state TEXT NOT NULL,
  failure TEXT NOT NULL,
  payload_file TEXT NOT NULL, payload_key INTEGER NOT NULL,
  stored_bytes INTEGER NOT NULL
) STRICT;
CREATE UNIQUE INDEX scans_by_sensor ON scans (sensor, captured_at);
CREATE INDEX scans_by_vantage ON scans (vantage, captured_at);
CREATE INDEX scans_by_vantage_and_sensor ON scans (vantage, sensor, captured_at);
CREATE INDEX scans_by_site ON scans (site, captured_at);
CREATE INDEX scans_by_time ON scans (captured_at);
CREATE INDEX scans_by_payload ON scans (payload_file, payload_key);

CREATE TABLE comparisons (
  id INTEGER PRIMARY KEY AUTOINCREMENT,
  scan INTEGER NOT NULL REFERENCES scans (id),
  site INTEGER NOT NULL REFERENCES sites (id),
  state TEXT NOT NULL,
  failure TEXT NOT NULL DEFAULT '',
  reference TEXT NOT NULL,        -- JSON
  parameters TEXT NOT NULL,       -- JSON
  counts TEXT NOT NULL DEFAULT '[]',      -- JSON, one number a point class
  testable REAL NOT NULL DEFAULT 0,
  changes INTEGER NOT NULL DEFAULT 0,
  timings_ms TEXT NOT NULL DEFAULT '{}',  -- JSON
  warnings TEXT NOT NULL DEFAULT '[]',    -- JSON
  payload_file TEXT NOT NULL DEFAULT '', payload_key INTEGER NOT NULL DEFAULT 0,
  created_at INTEGER NOT NULL,
  finished_at INTEGER
) STRICT;
CREATE INDEX comparisons_by_scan ON comparisons (scan);
CREATE INDEX comparisons_by_site ON comparisons (site);
CREATE INDEX comparisons_by_state ON comparisons (state);
CREATE INDEX comparisons_by_site_and_state ON comparisons (site, state);
CREATE INDEX comparisons_by_payload ON comparisons (payload_file, payload_key);

CREATE TABLE comparison_priors (
  comparison INTEGER NOT NULL REFERENCES comparisons (id),
  place INTEGER NOT NULL,
  scan INTEGER NOT NULL,
  vantage INTEGER NOT NULL,
  overlap REAL NOT NULL,
  added INTEGER NOT NULL,
  removed INTEGER NOT NULL,
  PRIMARY KEY (comparison, place)
) STRICT, WITHOUT ROWID;
CREATE INDEX comparison_priors_by_scan ON comparison_priors (scan);

CREATE TABLE comparison_candidates (
  comparison INTEGER NOT NULL REFERENCES comparisons (id),
  place INTEGER NOT NULL,
  scan INTEGER NOT NULL,
  vantage INTEGER NOT NULL,
  distance_m REAL NOT NULL,
  age INTEGER NOT NULL,
  overlap REAL NOT NULL,
  gain REAL NOT NULL,
  chosen INTEGER NOT NULL,
  reason TEXT NOT NULL,
  PRIMARY KEY (comparison, place)
) STRICT, WITHOUT ROWID;

CREATE TABLE jobs (
  id INTEGER PRIMARY KEY AUTOINCREMENT,
  comparison INTEGER NOT NULL UNIQUE REFERENCES comparisons (id),
  scan INTEGER NOT NULL,
  site INTEGER NOT NULL,
  captured_at INTEGER NOT NULL,
  started INTEGER NOT NULL,
  attempts INTEGER NOT NULL
) STRICT;
CREATE INDEX jobs_by_turn ON jobs (site, started, captured_at);
CREATE INDEX jobs_by_started ON jobs (started);

CREATE TABLE changes (
  id INTEGER PRIMARY KEY AUTOINCREMENT,
  comparison INTEGER NOT NULL REFERENCES comparisons (id),
  place INTEGER NOT NULL,
  site INTEGER NOT NULL,
  scan INTEGER NOT NULL,
  captured_at INTEGER NOT NULL,
  kind TEXT NOT NULL,
  centroid_x_m REAL NOT NULL, centroid_y_m REAL NOT NULL, centroid_z_m REAL NOT NULL,
  min_x_m REAL NOT NULL, min_y_m REAL NOT NULL, min_z_m REAL NOT NULL,
  max_x_m REAL NOT NULL, max_y_m REAL NOT NULL, max_z_m REAL NOT NULL,
  box_pose BLOB NOT NULL,         -- centre and world_from_box
  box_x_m REAL NOT NULL, box_y_m REAL NOT NULL, box_z_m REAL NOT NULL,
  volume_m3 REAL NOT NULL,
  points INTEGER NOT NULL,
  confidence REAL NOT NULL, free REAL NOT NULL, supported REAL NOT NULL, unknown REAL NOT NULL
) STRICT;
-- The columns after the sorting ones let the other filters be answered without reading the records.
CREATE UNIQUE INDEX changes_by_comparison ON changes (comparison, place);
CREATE INDEX changes_by_site ON changes (site, captured_at DESC, comparison, place, kind, volume_m3);
CREATE INDEX changes_by_time ON changes (captured_at DESC, comparison, place, kind, volume_m3);
CREATE VIRTUAL TABLE change_bounds USING rtree (id, site_min, site_max, x_min, x_max, y_min, y_max, z_min, z_max);
)sql";

/// How well poses were refined. A row without an uncertainty was not looked at; one of state "none" that was is an
/// anchor, and there are few of them among many scans.
constexpr std::string_view kMetadata2 = R"sql(
ALTER TABLE scans ADD COLUMN registration_inliers REAL;
ALTER TABLE scans ADD COLUMN registration_uncertainty_m REAL;
ALTER TABLE scans ADD COLUMN registration_uncertainty_rad REAL;
CREATE INDEX anchors_by_vantage ON scans (vantage, captured_at)
  WHERE registration_state = 'none' AND registration_uncertainty_m IS NOT NULL;
)sql";

/// What a track was made of by time, and what was told on a day.
constexpr std::string_view kMetadata6 = R"sql(
DROP INDEX changes_by_track;
CREATE INDEX changes_by_track ON changes (track, captured_at DESC, comparison, place) WHERE track IS NOT NULL;
CREATE INDEX alerts_by_opening ON alerts (site, opened_at);
)sql";

/// A local mine grid, in which results of a site go out.
constexpr std::string_view kMetadata8 = R"sql(
ALTER TABLE sites ADD COLUMN mine_grid TEXT;  -- JSON
)sql";

// A chunk's key is its payload's key times 2^20 plus its place: all chunks of a payload lie together, in order. The
// bounds stand before the data, so that they are read without it; they are empty where no point has a direction.
constexpr std::string_view kPayload1 = R"sql(
CREATE TABLE payloads (
  id INTEGER PRIMARY KEY AUTOINCREMENT,
  kind TEXT NOT NULL,             -- scan, comparison
  points INTEGER NOT NULL,
  chunks INTEGER NOT NULL,
  has_intensity INTEGER NOT NULL,
  grid_rows INTEGER, grid_columns INTEGER,
  prior_points INTEGER NOT NULL,
  stored_bytes INTEGER NOT NULL
) STRICT;

CREATE TABLE panoramas (
  payload INTEGER PRIMARY KEY REFERENCES payloads (id),
  data BLOB NOT NULL
) STRICT;

CREATE TABLE chunks (
  id INTEGER PRIMARY KEY,
  azimuth_min_rad REAL, azimuth_max_rad REAL,
  elevation_min_rad REAL, elevation_max_rad REAL,
  range_min_m REAL, range_max_m REAL,
  data BLOB NOT NULL
) STRICT;
)sql";

/// The bounds alone, so that finding the chunks of one direction does not read the data of all others.
constexpr std::string_view kPayload2 = R"sql(
CREATE INDEX chunk_bounds ON chunks (id, azimuth_min_rad, azimuth_max_rad, elevation_min_rad, elevation_max_rad,
  range_min_m, range_max_m) WHERE azimuth_min_rad IS NOT NULL;
)sql";

constexpr std::array kMetadataSteps{kMetadata1, kMetadata2, kMetadata3, kMetadata4,
                                    kMetadata5, kMetadata6, kMetadata7, kMetadata8};
constexpr std::array kPayloadSteps{kPayload1, kPayload2};

}  // namespace

const Migrations& metadata_migrations() {
  static const Migrations migrations{.application_id = 0x52577631, .page_bytes = 4096, .steps = kMetadataSteps};
  return migrations;
}

const Migrations& payload_migrations() {
  static const Migrations migrations{.application_id = 0x52577030, .page_bytes = 16384, .steps = kPayloadSteps};
  return migrations;
}

}  // namespace raywatch
