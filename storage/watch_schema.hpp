#pragma once

#include <string_view>

namespace raywatch {

/// The third version of the metadata: what watching adds. The conventions are those of schema.cpp.
///
/// A comparison, and a change of it, is "watching" when it is the one by which tracks are kept: that of an upload with
/// the baseline. Scans, changes and comparisons that tracks and alerts name may be deleted before them; these are plain
/// numbers. The default rule of sites that were there before is that of `default_rule`.
inline constexpr std::string_view kMetadata3 = R"sql(
ALTER TABLE comparisons ADD COLUMN watching INTEGER NOT NULL DEFAULT 0;
ALTER TABLE changes ADD COLUMN watching INTEGER NOT NULL DEFAULT 0;
ALTER TABLE changes ADD COLUMN track INTEGER;
DROP INDEX changes_by_site;
DROP INDEX changes_by_time;
CREATE INDEX changes_by_site ON changes (site, watching, captured_at DESC, comparison, place, kind, volume_m3);
CREATE INDEX changes_by_time ON changes (watching, captured_at DESC, comparison, place, kind, volume_m3);
CREATE INDEX changes_by_track ON changes (track, scan) WHERE track IS NOT NULL;

CREATE TABLE baselines (
  site INTEGER NOT NULL REFERENCES sites (id),
  version INTEGER NOT NULL,
  kind TEXT NOT NULL,
  made_at INTEGER NOT NULL,
  actor TEXT NOT NULL,
  note TEXT NOT NULL,
  PRIMARY KEY (site, version)
) STRICT, WITHOUT ROWID;

-- An entry belongs to the versions from its first to before its last. Entries with a region that came with one version
-- speak together about that region.
CREATE TABLE baseline_entries (
  id INTEGER PRIMARY KEY AUTOINCREMENT,
  site INTEGER NOT NULL REFERENCES sites (id),
  scan INTEGER NOT NULL,
  vantage INTEGER NOT NULL,
  origin TEXT NOT NULL,
  min_x_m REAL, min_y_m REAL, min_z_m REAL, max_x_m REAL, max_y_m REAL, max_z_m REAL,
  from_version INTEGER NOT NULL,
  until_version INTEGER
) STRICT;
CREATE INDEX baseline_entries_by_site ON baseline_entries (site);
CREATE INDEX baseline_entries_now ON baseline_entries (site, vantage) WHERE until_version IS NULL;
CREATE INDEX baseline_patches_now ON baseline_entries (site) WHERE until_version IS NULL AND min_x_m IS NOT NULL;
CREATE INDEX baseline_entries_by_scan ON baseline_entries (scan) WHERE until_version IS NULL;

-- The order in which scans were watched. Only those of the role "tracked" told something about tracks.
CREATE TABLE watched_scans (
  turn INTEGER PRIMARY KEY AUTOINCREMENT,
  scan INTEGER NOT NULL,
  site INTEGER NOT NULL REFERENCES sites (id),
  sensor INTEGER NOT NULL,
  vantage INTEGER NOT NULL,
  captured_at INTEGER NOT NULL,
  role TEXT NOT NULL
) STRICT;
CREATE INDEX watched_scans_by_scan ON watched_scans (scan);
CREATE INDEX watched_scans_by_sensor ON watched_scans (sensor, captured_at) WHERE role = 'tracked';
CREATE INDEX watched_scans_by_site ON watched_scans (site, captured_at) WHERE role = 'tracked';
CREATE INDEX watched_scans_by_vantage ON watched_scans (vantage, turn) WHERE role = 'tracked';

CREATE TABLE tracks (
  id INTEGER PRIMARY KEY AUTOINCREMENT,
  site INTEGER NOT NULL REFERENCES sites (id),
  state TEXT NOT NULL,
  followed INTEGER NOT NULL,
  first_scan INTEGER NOT NULL,
  last_scan INTEGER NOT NULL,
  ended_scan INTEGER,
  latest_change INTEGER NOT NULL,
  moved_from INTEGER, moved_to INTEGER,
  first_seen_at INTEGER NOT NULL,
  last_seen_at INTEGER NOT NULL,
  last_told_at INTEGER NOT NULL,
  ended_at INTEGER,
  seen INTEGER NOT NULL, absent INTEGER NOT NULL,
  recent INTEGER NOT NULL, remembered INTEGER NOT NULL,
  anchor_min_x_m REAL NOT NULL, anchor_min_y_m REAL NOT NULL, anchor_min_z_m REAL NOT NULL,
  anchor_max_x_m REAL NOT NULL, anchor_max_y_m REAL NOT NULL, anchor_max_z_m REAL NOT NULL,
  sample BLOB NOT NULL,           -- x, y, z as 32-bit floats
  kind TEXT NOT NULL,
  centroid_x_m REAL NOT NULL, centroid_y_m REAL NOT NULL, centroid_z_m REAL NOT NULL,
  min_x_m REAL NOT NULL, min_y_m REAL NOT NULL, min_z_m REAL NOT NULL,
  max_x_m REAL NOT NULL, max_y_m REAL NOT NULL, max_z_m REAL NOT NULL,
  box_pose BLOB NOT NULL,
  box_x_m REAL NOT NULL, box_y_m REAL NOT NULL, box_z_m REAL NOT NULL,
  volume_m3 REAL NOT NULL,
  points INTEGER NOT NULL,
  confidence REAL NOT NULL, free REAL NOT NULL, supported REAL NOT NULL, unknown REAL NOT NULL
) STRICT;
CREATE INDEX tracks_by_site ON tracks (site);
CREATE INDEX tracks_by_state ON tracks (state);
CREATE INDEX tracks_by_site_and_state ON tracks (site, state);
CREATE INDEX tracks_by_first_seen ON tracks (site, first_seen_at);
CREATE INDEX tracks_followed ON tracks (site) WHERE followed = 1;

-- What the scans of one vantage showed of a track, as long as it was the same: all tracked scans of the vantage between
-- two turns.
CREATE TABLE sight_runs (
  track INTEGER NOT NULL REFERENCES tracks (id),
  vantage INTEGER NOT NULL,
  first_turn INTEGER NOT NULL,
  last_turn INTEGER NOT NULL,
  sight TEXT NOT NULL,
  scans INTEGER NOT NULL,
  PRIMARY KEY (track, vantage, first_turn)
) STRICT, WITHOUT ROWID;

CREATE TABLE zones (
  id INTEGER PRIMARY KEY AUTOINCREMENT,
  site INTEGER NOT NULL REFERENCES sites (id),
  name TEXT NOT NULL,
  kind TEXT NOT NULL,
  polygon TEXT NOT NULL,          -- JSON, [[x, y], ...]
  z_min_m REAL NOT NULL, z_max_m REAL NOT NULL,
  created_at INTEGER NOT NULL,
  edited_at INTEGER NOT NULL
) STRICT;
CREATE UNIQUE INDEX zones_by_name ON zones (site, name);
CREATE INDEX zones_by_site ON zones (site);

CREATE TABLE zone_coverage (
  zone INTEGER NOT NULL REFERENCES zones (id),
  turn INTEGER NOT NULL,
  share REAL NOT NULL,
  PRIMARY KEY (zone, turn)
) STRICT, WITHOUT ROWID;

CREATE TABLE rules (
  id INTEGER PRIMARY KEY AUTOINCREMENT,
  site INTEGER NOT NULL REFERENCES sites (id),
  zone INTEGER REFERENCES zones (id),
  name TEXT NOT NULL,
  spec TEXT NOT NULL,             -- JSON
  created_at INTEGER NOT NULL,
  edited_at INTEGER NOT NULL
) STRICT;
CREATE UNIQUE INDEX rules_by_name ON rules (site, name);
CREATE INDEX rules_by_site ON rules (site);
CREATE INDEX rules_by_zone ON rules (zone) WHERE zone IS NOT NULL;

CREATE TABLE silences (
  id INTEGER PRIMARY KEY AUTOINCREMENT,
  site INTEGER NOT NULL REFERENCES sites (id),
  zone INTEGER, sensor INTEGER,
  from_at INTEGER NOT NULL,
  until_at INTEGER NOT NULL,
  actor TEXT NOT NULL,
  note TEXT NOT NULL,
  created_at INTEGER NOT NULL
) STRICT;
CREATE INDEX silences_by_site ON silences (site, until_at);

-- One a track and rule; of system alerts, one that stands a cause and subject.
CREATE TABLE alerts (
  id INTEGER PRIMARY KEY AUTOINCREMENT,
  site INTEGER NOT NULL REFERENCES sites (id),
  cause TEXT NOT NULL,
  subject TEXT NOT NULL,
  title TEXT NOT NULL,
  state TEXT NOT NULL,
  severity TEXT NOT NULL,
  track INTEGER, rule INTEGER, zone INTEGER, sensor INTEGER, scan INTEGER,
  rule_name TEXT NOT NULL,
  rule_spec TEXT NOT NULL,        -- JSON, the rule as it was when the alert opened
  auto_resolve INTEGER NOT NULL,
  resolved_as_gone INTEGER NOT NULL,
  opened_at INTEGER NOT NULL,
  edited_at INTEGER NOT NULL,
  snoozed_until INTEGER
) STRICT;
CREATE UNIQUE INDEX alerts_by_track ON alerts (track, rule) WHERE track IS NOT NULL;
CREATE INDEX alerts_by_site ON alerts (site);
CREATE INDEX alerts_by_state ON alerts (state);
CREATE INDEX alerts_by_site_and_state ON alerts (site, state);
CREATE UNIQUE INDEX alerts_standing ON alerts (site, cause, subject) WHERE track IS NULL AND state <> 'resolved';
CREATE INDEX alerts_snoozed ON alerts (snoozed_until) WHERE state = 'snoozed';

CREATE TABLE alert_steps (
  alert INTEGER NOT NULL REFERENCES alerts (id),
  place INTEGER NOT NULL,
  at INTEGER NOT NULL,
  actor TEXT NOT NULL,
  action TEXT NOT NULL,
  note TEXT NOT NULL,
  state TEXT NOT NULL,
  severity TEXT NOT NULL,
  scan INTEGER,
  PRIMARY KEY (alert, place)
) STRICT, WITHOUT ROWID;

CREATE TABLE events (
  id INTEGER PRIMARY KEY AUTOINCREMENT,
  at INTEGER NOT NULL,
  type TEXT NOT NULL,
  site INTEGER,
  scan INTEGER, comparison INTEGER, track INTEGER, alert INTEGER, zone INTEGER, rule INTEGER, sensor INTEGER,
  text TEXT NOT NULL
) STRICT;

INSERT INTO rules (site, zone, name, spec, created_at, edited_at)
  SELECT id, NULL, 'anything that lasts', CASE profile
    WHEN 'survey' THEN '{"scans":1,"of":1}'
    ELSE '{"scans":2,"of":3,"seconds":20.0}' END, created_at, created_at FROM sites;
)sql";

}  // namespace raywatch
