#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "core/track.hpp"
#include "storage/page.hpp"
#include "storage/store.hpp"

namespace raywatch {

/// What a scan did for the tracks of its site.
enum class WatchRole : std::uint8_t {
  tracked,    ///< it told something about them
  learning,   ///< it became part of what is normal; alerts wait
  late,       ///< later scans had moved the tracks already
  suspect,    ///< something changed in a control zone
  misplaced,  ///< it does not fit onto the others
};
std::string_view to_string(WatchRole role);

/// A scan among those that were watched, in their order.
struct WatchedScan {
  std::int64_t turn = 0;
  ScanId scan;
  SiteId site;
  SensorId sensor;
  VantageId vantage;
  Time captured_at;
  WatchRole role = WatchRole::tracked;
};
/// @returns the turn; the argument's is ignored.
std::int64_t insert_watched_scan(Transaction& transaction, const WatchedScan& scan);
std::optional<WatchedScan> find_watched_scan(const Snapshot& snapshot, ScanId scan);
/// The capture time of the latest tracked scan of a site, or of a sensor.
std::optional<Time> tracked_until(const Snapshot& snapshot, SiteId site);
std::optional<Time> tracked_until(const Snapshot& snapshot, SensorId sensor);

/// A track as stored; places are local.
struct TrackRecord {
  Track track;
  SiteId site;
  ScanId first_scan, last_scan;  ///< that saw it
  std::optional<ScanId> ended_scan;
  ChangeId latest_change;
  std::optional<TrackId> moved_from, moved_to;  ///< the track of the same object at its other place
};

TrackId insert_track(Transaction& transaction, const TrackRecord& track);
void update_track(Transaction& transaction, const TrackRecord& track);
void link_moved(Transaction& transaction, TrackId from, TrackId to);
std::optional<TrackRecord> find_track(const Snapshot& snapshot, TrackId id);
/// Those of a site that later scans may add to, by id.
std::vector<TrackRecord> followed_tracks(const Snapshot& snapshot, SiteId site);
/// Those of a site that were first seen in [from, to], by id.
std::vector<TrackRecord> tracks_begun(const Snapshot& snapshot, SiteId site, Time from, Time to);

struct TrackFilter {
  std::optional<SiteId> site;
  std::optional<TrackState> state;
  std::optional<ChangeKind> kind;
  std::optional<Time> from, to;  ///< seen last at `from` or later, and first before `to`
};
/// Newest first.
Page<TrackRecord> list_tracks(const Snapshot& snapshot, const TrackFilter& filter, const PageRequest& page);

/// What the scans of one vantage showed of a track, as long as it was the same.
struct SightRun {
  VantageId vantage;
  std::int64_t first_turn = 0, last_turn = 0;
  Sight sight = Sight::seen;
  std::uint64_t scans = 0;
  ScanId first_scan, last_scan;
  Time first_at, last_at;
};
/// Notes what a tracked scan showed of a track. Every tracked scan of a vantage must be noted, in order.
void note_sight(Transaction& transaction, TrackId track, const WatchedScan& scan, Sight sight);
/// By their first turn.
std::vector<SightRun> sight_runs(const Snapshot& snapshot, TrackId track);

/// One sight of a track by one scan.
struct SightOfScan {
  std::int64_t turn = 0;
  ScanId scan;
  SensorId sensor;
  Time captured_at;
  Sight sight = Sight::seen;
};
/// All that told something, in the order in which they were watched.
std::vector<SightOfScan> telling_sights(const Snapshot& snapshot, TrackId track);

}  // namespace raywatch
