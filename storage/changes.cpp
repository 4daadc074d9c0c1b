#include <array>
#include <limits>

#include "storage/change_columns.hpp"
#include "storage/comparison_rows.hpp"
#include "storage/comparisons.hpp"
#include "storage/cursor.hpp"
#include "storage/scans.hpp"
#include "storage/snapshot.hpp"
#include "storage/spatial.hpp"

namespace raywatch {
namespace {

constexpr std::string_view kChangeList = "changes";
const std::string kChangeColumns =
    "c.id, c.comparison, c.place, c.site, c.scan, c.captured_at, c.track, c.kind, c.centroid_x_m, c.centroid_y_m, "
    "c.centroid_z_m, c.min_x_m, c.min_y_m, c.min_z_m, c.max_x_m, c.max_y_m, c.max_z_m, c.box_pose, c.box_x_m, "
    "c.box_y_m, c.box_z_m, c.volume_m3, c.points, c.confidence, c.free, c.supported, c.unknown";

ChangeRecord read_change(Statement& row) {
  ChangeRecord record;
  record.id = row.take<ChangeId>();
  record.comparison = row.take<ComparisonId>();
  record.place = row.take<std::int32_t>();
  record.site = row.take<SiteId>();
  record.scan = row.take<ScanId>();
  record.captured_at = row.take<Time>();
  record.track = row.take<std::optional<TrackId>>();
  record.change = take_change(row);
  return record;
}

void insert_bounds(Database& database, ChangeId id, SiteId site, const Eigen::AlignedBox3d& box) {
  const auto site_key = static_cast<double>(site.value);
  Statement row(database, "INSERT INTO change_bounds VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?)");
  row.bind(id, tree_min(site_key), tree_max(site_key));
  for (int axis = 0; axis < 3; ++axis) row.bind(tree_min(box.min()[axis]), tree_max(box.max()[axis]));
  row.next();
}

ChangeId insert_change(Database& database, const ComparisonRecord& comparison, Time captured_at, std::int64_t place,
                       const Change& change) {
  const PoseBytes box_pose = box_pose_bytes(change);
  {
    Statement row(database,
                  "INSERT INTO changes (comparison, place, site, scan, captured_at, watching, kind, centroid_x_m, "
                  "centroid_y_m, centroid_z_m, min_x_m, min_y_m, min_z_m, max_x_m, max_y_m, max_z_m, box_pose, "
                  "box_x_m, box_y_m, box_z_m, volume_m3, points, confidence, free, supported, unknown) VALUES "
                  "(?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)");
    row.bind(comparison.id, place, comparison.site, comparison.scan, captured_at, comparison.watching);
    bind_change(row, change, box_pose);
    row.next();
  }
  const ChangeId id{database.last_id()};
  insert_bounds(database, id, comparison.site, change.bounds_m);
  return id;
}

using ChangeKey = std::array<std::int64_t, 3>;  ///< captured_at, comparison, place
ChangeKey key_of_change(const ChangeRecord& record) {
  return {record.captured_at.time_since_epoch().count(), record.comparison.value, record.place};
}

/// The part of the list to read: from <= captured_at, and behind a key (older, or of that time and with a later rest).
struct ChangeSpan {
  std::int64_t from;
  ChangeKey after;
};

ChangeSpan span_of(const ChangeFilter& filter, const PageRequest& page) {
  constexpr std::int64_t kMin = std::numeric_limits<std::int64_t>::min();
  constexpr std::int64_t kMax = std::numeric_limits<std::int64_t>::max();
  const std::int64_t from = filter.from ? filter.from->time_since_epoch().count() : kMin;
  // Behind every change of the time `to`; without `to`, before all.
  const ChangeKey start =
      filter.to ? ChangeKey{filter.to->time_since_epoch().count(), kMax, kMax} : ChangeKey{kMax, 0, 0};
  const ChangeKey cursor = key_before(page, kChangeList, start);
  // A cursor was given within the same `to`; the earlier time goes farther.
  return {from, cursor[0] <= start[0] ? cursor : start};
}

struct Query {
  std::string from;   ///< tables, with the index to use
  std::string where;  ///< conditions, each followed by AND
};

/// The conditions of a filter that are the same whatever index serves it.
std::string conditions(const ChangeFilter& filter) {
  std::string where;
  if (filter.site) where += "c.site = ?1 AND ";
  if (!filter.comparison) where += filter.watching ? "c.watching = 1 AND " : "c.watching = 0 AND ";
  if (filter.comparison) where += "c.comparison = ?2 AND ";
  if (filter.track) where += "c.track = ?16 AND ";
  if (filter.kind) where += "c.kind = ?3 AND ";
  if (filter.min_volume_m3) where += "c.volume_m3 >= ?4 AND ";
  if (filter.box_m) {
    where +=
        "c.min_x_m <= ?6 AND c.max_x_m >= ?5 AND c.min_y_m <= ?8 AND c.max_y_m >= ?7 AND c.min_z_m <= ?10 AND "
        "c.max_z_m >= ?9 AND ";
  }
  return where;
}

const std::string kInBox =
    "b.site_min <= ?1 AND b.site_max >= ?1 AND b.x_min <= ?6 AND b.x_max >= ?5 AND b.y_min <= ?8 AND b.y_max >= ?7 AND "
    "b.z_min <= ?10 AND b.z_max >= ?9 ";

void bind_filter(Statement& rows, const ChangeFilter& filter) {
  const Eigen::AlignedBox3d box = filter.box_m.value_or(Eigen::AlignedBox3d());
  rows.bind(filter.site, filter.comparison, filter.kind ? std::optional(to_string(*filter.kind)) : std::nullopt,
            filter.min_volume_m3);
  for (int axis = 0; axis < 3; ++axis) rows.bind(box.min()[axis], box.max()[axis]);
}

/// From this number of hits on, the newest of them are found faster by walking through time than by sorting all.
constexpr std::int64_t kManyHits = 5000;

bool has_few_hits(const Snapshot& snapshot, const ChangeFilter& filter) {
  Statement row(database_of(snapshot),
                "SELECT count(*) FROM (SELECT 1 FROM change_bounds AS b WHERE " + kInBox + "LIMIT ?11)");
  bind_filter(row, filter);
  row.bind(kManyHits).next();
  return row.take<std::int64_t>() < kManyHits;
}

std::string tables(const Snapshot& snapshot, const ChangeFilter& filter) {
  if (filter.comparison) return "changes AS c INDEXED BY changes_by_comparison WHERE ";
  if (filter.track) return "changes AS c INDEXED BY changes_by_track WHERE ";
  if (filter.box_m && has_few_hits(snapshot, filter)) {
    return "change_bounds AS b CROSS JOIN changes AS c ON c.id = b.id WHERE " + kInBox + "AND ";
  }
  if (filter.site) return "changes AS c INDEXED BY changes_by_site WHERE ";
  return "changes AS c INDEXED BY changes_by_time WHERE ";
}

/// All changes of a comparison have one time, so that its index has them in order.
std::string order(const ChangeFilter& filter) {
  return filter.comparison ? "c.place" : "c.captured_at DESC, c.comparison, c.place";
}

}  // namespace

std::vector<ChangeId> insert_changes(Transaction& transaction, const ComparisonRecord& comparison,
                                     const std::vector<Change>& changes) {
  const Time captured_at = find_scan(transaction, comparison.scan).value().captured_at;
  std::vector<ChangeId> ids;
  for (const Change& change : changes) {
    const auto place = static_cast<std::int64_t>(ids.size());
    ids.push_back(insert_change(database_of(transaction), comparison, captured_at, place, change));
  }
  return ids;
}

Page<ChangeRecord> list_changes(const Snapshot& snapshot, const ChangeFilter& filter, const PageRequest& page) {
  if (filter.box_m && !filter.site) throw InvalidInput("a box needs a site", {{"box", "needs \"site\""}});
  const ChangeSpan span = span_of(filter, page);
  Statement rows(
      database_of(snapshot),
      "SELECT " + kChangeColumns + " FROM " + tables(snapshot, filter) + conditions(filter) +
          "c.captured_at BETWEEN ?11 AND ?12 AND (c.captured_at < ?12 OR (c.comparison, c.place) > (?13, ?14)) "
          "ORDER BY " +
          order(filter) + " LIMIT ?15");
  bind_filter(rows, filter);
  rows.bind(span.from, span.after[0], span.after[1], span.after[2], rows_to_read(page));
  if (filter.track) rows.bind(*filter.track);
  std::vector<ChangeRecord> changes;
  while (rows.next()) changes.push_back(read_change(rows));
  return make_page(std::move(changes), page, kChangeList, key_of_change);
}

void set_track(Transaction& transaction, ChangeId id, TrackId track) {
  database_of(transaction).run("UPDATE changes SET track = ? WHERE id = ?", track, id);
}

std::vector<ChangeRecord> changes_of_track(const Snapshot& snapshot, TrackId track, ScanId scan) {
  Statement rows(database_of(snapshot),
                 "SELECT " + kChangeColumns +
                     " FROM changes AS c INDEXED BY changes_by_track WHERE c.track = ?1 AND "
                     "c.captured_at = (SELECT captured_at FROM scans WHERE id = ?2) AND c.scan = ?2 "
                     "AND c.watching = 1 ORDER BY c.comparison, c.place");
  rows.bind(track, scan);
  std::vector<ChangeRecord> changes;
  while (rows.next()) changes.push_back(read_change(rows));
  return changes;
}

std::optional<ChangeRecord> find_change(const Snapshot& snapshot, ChangeId id) {
  Statement row(database_of(snapshot), "SELECT " + kChangeColumns + " FROM changes AS c WHERE c.id = ?");
  if (!row.bind(id).next()) return std::nullopt;
  return read_change(row);
}

}  // namespace raywatch
