#include "storage/deletions.hpp"

#include <algorithm>
#include <array>
#include <limits>

#include "core/names.hpp"
#include "storage/cursor.hpp"
#include "storage/events.hpp"
#include "storage/snapshot.hpp"

namespace raywatch {
namespace {

constexpr std::string_view kDeletionList = "deletions";
constexpr Names<DeletionReason, 4> kReasons{{{DeletionReason::by_operator, "operator"},
                                             {DeletionReason::age, "age"},
                                             {DeletionReason::bytes, "bytes"},
                                             {DeletionReason::free_disk, "free_disk"}}};
const std::string kSelectDeletions =
    "SELECT id, at, what, reason, site, sensor, scan, captured_at, received_at, records, bytes FROM deletions ";
constexpr std::array<const char*, 2> kLogs{"events", "deletions"};

DeletionRecord read_deletion(Statement& row) {
  DeletionRecord record;
  record.id = row.take<std::int64_t>();
  record.at = row.take<Time>();
  record.what = row.take<std::string>();
  record.reason = value_of(kReasons, row.take<std::string>(), "reason");
  record.site = row.take<std::optional<SiteId>>();
  record.sensor = row.take<std::optional<SensorId>>();
  record.scan = row.take<std::optional<ScanId>>();
  record.captured_at = row.take<std::optional<Time>>();
  record.received_at = row.take<std::optional<Time>>();
  record.records = row.take<std::uint64_t>();
  record.bytes = row.take<std::uint64_t>();
  return record;
}

std::int64_t day_of(Time time) { return std::chrono::floor<std::chrono::days>(time).time_since_epoch().count(); }

const char* sentence_of(DeletionReason reason) {
  switch (reason) {
    case DeletionReason::by_operator:
      return "A scan was deleted by request.";
    case DeletionReason::age:
      return "A scan was deleted: it was older than what is kept.";
    case DeletionReason::bytes:
      return "A scan was deleted: the site had more than what is kept.";
    case DeletionReason::free_disk:
      break;
  }
  return "A scan was deleted: the disk had less room than what is kept free.";
}

/// The id before which a log's rows are older than `horizon`, among the first `kLogRowsAtOnce`; the latest row stays,
/// so that the log still says up to where it went.
std::optional<std::int64_t> end_of_old_rows(Database& database, const std::string& log, Time horizon) {
  const auto latest = database.find<std::optional<std::int64_t>>("SELECT max(id) FROM " + log).value();
  const auto oldest = database.find<std::optional<std::int64_t>>("SELECT min(id) FROM " + log).value();
  if (!latest) return std::nullopt;
  // Ids rise without gaps: what was rolled back took none.
  const std::int64_t limit = std::min(*latest, *oldest + static_cast<std::int64_t>(kLogRowsAtOnce));
  const auto first_young = database.find<std::optional<std::int64_t>>(
      "SELECT min(id) FROM " + log + " WHERE id < ? AND at >= ?", limit, horizon);
  const std::int64_t end = first_young.value().value_or(limit);
  return end > *oldest ? std::optional(end) : std::nullopt;
}

/// One record a day and log: there is no need to know more of what is no scan.
void record_pruned(Transaction& transaction, const std::string& log, std::uint64_t records, Time now) {
  Database& database = database_of(transaction);
  database.run(
      "UPDATE deletions INDEXED BY deletions_of_logs SET at = ?, records = records + ? "
      "WHERE what = ? AND day = ? AND scan IS NULL",
      now, records, log, day_of(now));
  if (database.changed_rows() > 0) return;
  insert_deletion(transaction, {.at = now, .what = log, .reason = DeletionReason::age, .records = records});
}

}  // namespace

std::string_view to_string(DeletionReason reason) { return name_of(kReasons, reason); }

void insert_deletion(Transaction& transaction, const DeletionRecord& deletion) {
  database_of(transaction)
      .run(
          "INSERT INTO deletions (at, day, what, reason, site, sensor, scan, captured_at, received_at, records, bytes) "
          "VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)",
          deletion.at, day_of(deletion.at), deletion.what, to_string(deletion.reason), deletion.site, deletion.sensor,
          deletion.scan, deletion.captured_at, deletion.received_at, deletion.records, deletion.bytes);
}

void record_deleted_scan(Transaction& transaction, const ScanRecord& scan, std::uint64_t bytes, DeletionReason reason,
                         Time now) {
  insert_deletion(transaction, {.at = now,
                                .what = "scan",
                                .reason = reason,
                                .site = scan.site,
                                .sensor = scan.sensor,
                                .scan = scan.id,
                                .captured_at = scan.captured_at,
                                .received_at = scan.received_at,
                                .bytes = bytes});
  insert_event(transaction, {.at = now,
                             .type = "scan.deleted",
                             .site = scan.site,
                             .scan = scan.id,
                             .sensor = scan.sensor,
                             .text = sentence_of(reason)});
}

Page<DeletionRecord> list_deletions(const Snapshot& snapshot, std::optional<SiteId> site, const PageRequest& page) {
  const auto [before] = key_before<1>(page, kDeletionList, {std::numeric_limits<std::int64_t>::max()});
  Statement rows(database_of(snapshot), kSelectDeletions +
                                            (site ? "INDEXED BY deletions_by_site WHERE site = ? AND " : "WHERE ") +
                                            "id < ? ORDER BY id DESC LIMIT ?");
  if (site) rows.bind(*site);
  rows.bind(before, rows_to_read(page));
  std::vector<DeletionRecord> deletions;
  while (rows.next()) deletions.push_back(read_deletion(rows));
  return make_page(std::move(deletions), page, kDeletionList, [](const DeletionRecord& d) { return std::array{d.id}; });
}

std::uint64_t prune_logs(Transaction& transaction, Time horizon, Time now) {
  Database& database = database_of(transaction);
  std::uint64_t pruned = 0;
  for (const std::string log : kLogs) {
    const auto end = end_of_old_rows(database, log, horizon);
    if (!end) continue;
    database.run("DELETE FROM " + log + " WHERE id < ?", *end);
    const auto records = static_cast<std::uint64_t>(database.changed_rows());
    record_pruned(transaction, log, records, now);
    pruned += records;
  }
  return pruned;
}

bool has_old_logs(const Snapshot& snapshot, Time horizon) {
  for (const std::string log : kLogs) {
    if (end_of_old_rows(database_of(snapshot), log, horizon)) return true;
  }
  return false;
}

}  // namespace raywatch
