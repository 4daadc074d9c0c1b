#pragma once

#include <string_view>

namespace raywatch {

/// The seventh version of the metadata: surveys. The conventions are those of schema.cpp.
///
/// What was surveyed stays when its schedule, its scans or a zone are deleted: these are plain numbers, but for the
/// site. Of a figure, zone 0 is the total. `before_at` and `after_at` are those of the first scans of the epochs.
inline constexpr std::string_view kMetadata7 = R"sql(
CREATE TABLE schedules (
  id INTEGER PRIMARY KEY AUTOINCREMENT,
  site INTEGER NOT NULL REFERENCES sites (id),
  name TEXT NOT NULL,
  enabled INTEGER NOT NULL,
  spec TEXT NOT NULL,             -- JSON
  fixed_epoch INTEGER,            -- that all its surveys are compared with
  looked_until INTEGER NOT NULL,  -- runs that were due until then were made, or skipped
  created_at INTEGER NOT NULL,
  edited_at INTEGER NOT NULL
) STRICT;
CREATE UNIQUE INDEX schedules_by_name ON schedules (site, name);
CREATE INDEX schedules_by_site ON schedules (site);
CREATE INDEX schedules_enabled ON schedules (id) WHERE enabled = 1;

CREATE TABLE survey_runs (
  id INTEGER PRIMARY KEY AUTOINCREMENT,
  site INTEGER NOT NULL REFERENCES sites (id),
  schedule INTEGER,
  due_at INTEGER NOT NULL,
  from_at INTEGER NOT NULL,
  to_at INTEGER NOT NULL,
  definition TEXT NOT NULL,       -- JSON
  state TEXT NOT NULL,
  attempts INTEGER NOT NULL,
  why TEXT NOT NULL,
  log TEXT NOT NULL,              -- JSON
  epoch INTEGER, reference INTEGER, survey INTEGER,
  created_at INTEGER NOT NULL,
  started_at INTEGER,
  finished_at INTEGER
) STRICT;
CREATE INDEX survey_runs_by_site ON survey_runs (site);
CREATE INDEX survey_runs_by_schedule ON survey_runs (schedule);
CREATE INDEX survey_runs_by_due ON survey_runs (schedule, due_at);
CREATE INDEX survey_runs_waiting ON survey_runs (due_at, id) WHERE state = 'queued';
CREATE INDEX survey_runs_running ON survey_runs (id) WHERE state = 'running';

CREATE TABLE epochs (
  id INTEGER PRIMARY KEY AUTOINCREMENT,
  site INTEGER NOT NULL REFERENCES sites (id),
  schedule INTEGER,
  name TEXT NOT NULL,
  from_at INTEGER NOT NULL,
  to_at INTEGER NOT NULL,
  state TEXT NOT NULL,
  why TEXT NOT NULL,              -- it was refused
  accepted_by TEXT, accepted_note TEXT, accepted_at INTEGER,
  created_at INTEGER NOT NULL
) STRICT;
CREATE INDEX epochs_by_end ON epochs (to_at);
CREATE INDEX epochs_by_site ON epochs (site, to_at);
CREATE INDEX epochs_by_schedule ON epochs (schedule, to_at);
CREATE INDEX epochs_accepted ON epochs (site) WHERE state = 'accepted';

CREATE TABLE epoch_scans (
  epoch INTEGER NOT NULL REFERENCES epochs (id),
  place INTEGER NOT NULL,
  scan INTEGER NOT NULL,
  PRIMARY KEY (epoch, place)
) STRICT, WITHOUT ROWID;
CREATE INDEX epoch_scans_by_scan ON epoch_scans (scan);

CREATE TABLE surveys (
  id INTEGER PRIMARY KEY AUTOINCREMENT,
  site INTEGER NOT NULL REFERENCES sites (id),
  schedule INTEGER,
  run INTEGER NOT NULL,
  before_epoch INTEGER NOT NULL,
  after_epoch INTEGER NOT NULL,
  before_at INTEGER NOT NULL,
  after_at INTEGER NOT NULL,
  made_at INTEGER NOT NULL,
  result TEXT NOT NULL,           -- JSON
  changes TEXT NOT NULL,          -- JSON
  payload_file TEXT NOT NULL, payload_key INTEGER NOT NULL,
  stored_bytes INTEGER NOT NULL
) STRICT;
CREATE INDEX surveys_by_site ON surveys (site);
CREATE INDEX surveys_by_schedule ON surveys (schedule);
CREATE INDEX surveys_by_payload ON surveys (payload_file, payload_key);

CREATE TABLE survey_figures (
  survey INTEGER NOT NULL REFERENCES surveys (id),
  zone INTEGER NOT NULL,
  figure TEXT NOT NULL,
  site INTEGER NOT NULL,
  schedule INTEGER NOT NULL,      -- 0: none
  after_at INTEGER NOT NULL,
  value REAL NOT NULL,
  low REAL, high REAL,
  level TEXT,                     -- where the schedule has thresholds for it
  PRIMARY KEY (survey, zone, figure)
) STRICT, WITHOUT ROWID;
CREATE INDEX survey_figures_by_series ON survey_figures (site, schedule, zone, figure, after_at);

CREATE TABLE survey_levels (
  schedule INTEGER NOT NULL,
  zone INTEGER NOT NULL,
  figure TEXT NOT NULL,
  level TEXT NOT NULL,
  pending TEXT NOT NULL,
  count INTEGER NOT NULL,
  PRIMARY KEY (schedule, zone, figure)
) STRICT, WITHOUT ROWID;
)sql";

}  // namespace raywatch
