#include "storage/tracks.hpp"

#include <array>
#include <bit>
#include <cstring>
#include <limits>
#include <span>

#include "storage/change_columns.hpp"
#include "storage/cursor.hpp"
#include "storage/snapshot.hpp"

namespace raywatch {
namespace {

constexpr std::string_view kTrackList = "tracks";
const std::string kSelectTracks =
    "SELECT id, site, state, first_scan, last_scan, ended_scan, latest_change, moved_from, moved_to, first_seen_at, "
    "last_seen_at, last_told_at, ended_at, seen, absent, recent, remembered, anchor_min_x_m, anchor_min_y_m, "
    "anchor_min_z_m, anchor_max_x_m, anchor_max_y_m, anchor_max_z_m, sample, kind, centroid_x_m, centroid_y_m, "
    "centroid_z_m, min_x_m, min_y_m, min_z_m, max_x_m, max_y_m, max_z_m, box_pose, box_x_m, box_y_m, box_z_m, "
    "volume_m3, points, confidence, free, supported, unknown FROM tracks ";

using Sample = std::vector<Eigen::Vector3f>;

std::span<const std::uint8_t> bytes_of(const Sample& sample) {
  return {reinterpret_cast<const std::uint8_t*>(sample.data()), sample.size() * sizeof(Eigen::Vector3f)};
}

Sample sample_of(std::span<const std::uint8_t> bytes) {
  if (bytes.size() % sizeof(Eigen::Vector3f) != 0) throw CorruptData("the points of a track have a wrong length");
  Sample sample(bytes.size() / sizeof(Eigen::Vector3f));
  if (!bytes.empty()) std::memcpy(static_cast<void*>(sample.data()), bytes.data(), bytes.size());
  return sample;
}

TrackRecord read_track(Statement& row) {
  TrackRecord record;
  Track& track = record.track;
  track.id = row.take<TrackId>();
  record.site = row.take<SiteId>();
  track.state = parse_track_state(row.take<std::string>());
  record.first_scan = row.take<ScanId>();
  record.last_scan = row.take<ScanId>();
  record.ended_scan = row.take<std::optional<ScanId>>();
  record.latest_change = row.take<ChangeId>();
  record.moved_from = row.take<std::optional<TrackId>>();
  record.moved_to = row.take<std::optional<TrackId>>();
  track.first_seen_at = row.take<Time>();
  track.last_seen_at = row.take<Time>();
  track.last_told_at = row.take<Time>();
  track.ended_at = row.take<std::optional<Time>>();
  track.seen = row.take<std::uint64_t>();
  track.absent = row.take<std::uint64_t>();
  track.recent = std::bit_cast<std::uint64_t>(row.take<std::int64_t>());
  track.remembered = row.take<std::uint32_t>();
  track.anchor_m = take_box(row);
  track.sample_m = sample_of(row.take<std::span<const std::uint8_t>>());
  track.latest = take_change(row);
  track.kind = track.latest.kind;
  return record;
}

/// What changes while a track is followed, but for its latest change.
void bind_course(Statement& row, const TrackRecord& record) {
  const Track& track = record.track;
  row.bind(to_string(track.state), is_followed(track), record.last_scan, record.ended_scan, record.latest_change,
           track.last_seen_at, track.last_told_at, track.ended_at, track.seen, track.absent,
           std::bit_cast<std::int64_t>(track.recent), track.remembered, bytes_of(track.sample_m));
}

std::vector<TrackRecord> all_of(Statement& rows) {
  std::vector<TrackRecord> tracks;
  while (rows.next()) tracks.push_back(read_track(rows));
  return tracks;
}

std::string index_of(const TrackFilter& filter) {
  if (filter.site && filter.state) return "INDEXED BY tracks_by_site_and_state WHERE site = ? AND state = ? AND ";
  if (filter.site) return "INDEXED BY tracks_by_site WHERE site = ? AND ";
  if (filter.state) return "INDEXED BY tracks_by_state WHERE state = ? AND ";
  return "WHERE ";
}

/// The index has the tracks in the order of the list; the rest is asked of each.
std::string where(const TrackFilter& filter) {
  std::string where = index_of(filter);
  if (filter.kind) where += "kind = ? AND ";
  if (filter.from) where += "last_seen_at >= ? AND ";
  if (filter.to) where += "first_seen_at < ? AND ";
  return where;
}

}  // namespace

TrackId insert_track(Transaction& transaction, const TrackRecord& record) {
  const Track& track = record.track;
  const PoseBytes box_pose = box_pose_bytes(track.latest);
  Database& database = database_of(transaction);
  Statement row(database,
                "INSERT INTO tracks (state, followed, last_scan, ended_scan, latest_change, last_seen_at, "
                "last_told_at, ended_at, seen, absent, recent, remembered, sample, kind, centroid_x_m, "
                "centroid_y_m, centroid_z_m, min_x_m, min_y_m, min_z_m, max_x_m, max_y_m, max_z_m, box_pose, box_x_m, "
                "box_y_m, box_z_m, volume_m3, points, confidence, free, supported, unknown, site, first_scan, "
                "first_seen_at, anchor_min_x_m, anchor_min_y_m, anchor_min_z_m, anchor_max_x_m, anchor_max_y_m, "
                "anchor_max_z_m) VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, "
                "?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)");
  bind_course(row, record);
  bind_change(row, track.latest, box_pose);
  row.bind(record.site, record.first_scan, track.first_seen_at);
  for (const Eigen::Vector3d& v : {track.anchor_m.min(), track.anchor_m.max()}) row.bind(v.x(), v.y(), v.z());
  row.next();
  return TrackId{database.last_id()};
}

void update_track(Transaction& transaction, const TrackRecord& record) {
  const PoseBytes box_pose = box_pose_bytes(record.track.latest);
  Statement row(database_of(transaction),
                "UPDATE tracks SET state = ?, followed = ?, last_scan = ?, ended_scan = ?, latest_change = ?, "
                "last_seen_at = ?, last_told_at = ?, ended_at = ?, seen = ?, absent = ?, recent = ?, "
                "remembered = ?, sample = ?, kind = ?, centroid_x_m = ?, centroid_y_m = ?, centroid_z_m = ?, "
                "min_x_m = ?, min_y_m = ?, min_z_m = ?, max_x_m = ?, max_y_m = ?, max_z_m = ?, box_pose = ?, "
                "box_x_m = ?, box_y_m = ?, box_z_m = ?, volume_m3 = ?, points = ?, confidence = ?, free = ?, "
                "supported = ?, unknown = ? WHERE id = ?");
  bind_course(row, record);
  bind_change(row, record.track.latest, box_pose);
  row.bind(record.track.id);
  row.next();
}

void link_moved(Transaction& transaction, TrackId from, TrackId to) {
  Database& database = database_of(transaction);
  database.run("UPDATE tracks SET moved_to = ? WHERE id = ?", to, from);
  database.run("UPDATE tracks SET moved_from = ? WHERE id = ?", from, to);
}

std::optional<TrackRecord> find_track(const Snapshot& snapshot, TrackId id) {
  Statement row(database_of(snapshot), kSelectTracks + "WHERE id = ?");
  if (!row.bind(id).next()) return std::nullopt;
  return read_track(row);
}

std::vector<TrackRecord> followed_tracks(const Snapshot& snapshot, SiteId site) {
  Statement rows(database_of(snapshot),
                 kSelectTracks + "INDEXED BY tracks_followed WHERE site = ? AND followed = 1 ORDER BY id");
  rows.bind(site);
  return all_of(rows);
}

std::vector<TrackRecord> tracks_begun(const Snapshot& snapshot, SiteId site, Time from, Time to) {
  Statement rows(database_of(snapshot),
                 kSelectTracks +
                     "INDEXED BY tracks_by_first_seen WHERE site = ? AND first_seen_at BETWEEN ? AND ? "
                     "ORDER BY first_seen_at, id");
  rows.bind(site, from, to);
  return all_of(rows);
}

Page<TrackRecord> list_tracks(const Snapshot& snapshot, const TrackFilter& filter, const PageRequest& page) {
  const auto [before] = key_before<1>(page, kTrackList, {std::numeric_limits<std::int64_t>::max()});
  Statement rows(database_of(snapshot), kSelectTracks + where(filter) + "id < ? ORDER BY id DESC LIMIT ?");
  if (filter.site) rows.bind(*filter.site);
  if (filter.state) rows.bind(to_string(*filter.state));
  if (filter.kind) rows.bind(to_string(*filter.kind));
  if (filter.from) rows.bind(*filter.from);
  if (filter.to) rows.bind(*filter.to);
  rows.bind(before, rows_to_read(page));
  return make_page(all_of(rows), page, kTrackList, [](const TrackRecord& t) { return std::array{t.track.id.value}; });
}

}  // namespace raywatch
