#pragma once

#include <string_view>

namespace raywatch {

/// The fourth version of the metadata: what is told to others. The conventions are those of schema.cpp.
///
/// A delivery is one event on its way to one channel. It is made in the transaction that makes the event, and keeps its
/// channel's number and kind when the channel is deleted.
inline constexpr std::string_view kMetadata4 = R"sql(
CREATE TABLE channels (
  id INTEGER PRIMARY KEY AUTOINCREMENT,
  name TEXT NOT NULL UNIQUE,
  kind TEXT NOT NULL,
  settings TEXT NOT NULL,         -- JSON, with secrets
  enabled INTEGER NOT NULL,
  site INTEGER REFERENCES sites (id),
  min_severity TEXT NOT NULL,
  events TEXT NOT NULL,           -- JSON, patterns
  per_minute INTEGER NOT NULL,
  revision INTEGER NOT NULL,
  trouble TEXT NOT NULL,
  failing_since INTEGER,
  actor TEXT NOT NULL,
  created_at INTEGER NOT NULL,
  edited_at INTEGER NOT NULL
) STRICT;
CREATE INDEX channels_by_site ON channels (site);

CREATE TABLE deliveries (
  id INTEGER PRIMARY KEY AUTOINCREMENT,
  channel INTEGER NOT NULL,
  kind TEXT NOT NULL,
  event INTEGER NOT NULL,
  alert INTEGER,
  step INTEGER,                   -- of the alert
  type TEXT NOT NULL,
  message_id TEXT NOT NULL,
  body TEXT NOT NULL,             -- JSON; empty until it was first sent
  state TEXT NOT NULL,
  attempts INTEGER NOT NULL,
  created_at INTEGER NOT NULL,
  queued_at INTEGER NOT NULL,
  next_attempt_at INTEGER NOT NULL,
  last_attempt_at INTEGER,
  ended_at INTEGER,
  took_ms REAL,
  response_code INTEGER,
  error TEXT NOT NULL
) STRICT;
CREATE INDEX deliveries_pending ON deliveries (channel, next_attempt_at) WHERE state = 'pending';
CREATE INDEX deliveries_sending ON deliveries (channel) WHERE state = 'sending';
CREATE INDEX deliveries_by_state ON deliveries (state);
CREATE INDEX deliveries_by_channel ON deliveries (channel);
CREATE INDEX deliveries_by_channel_and_state ON deliveries (channel, state);
CREATE INDEX deliveries_by_alert ON deliveries (alert) WHERE alert IS NOT NULL;
CREATE INDEX deliveries_by_end ON deliveries (ended_at) WHERE ended_at IS NOT NULL;
)sql";

}  // namespace raywatch
