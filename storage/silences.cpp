#include <array>
#include <limits>

#include "storage/cursor.hpp"
#include "storage/rules.hpp"
#include "storage/sites.hpp"
#include "storage/snapshot.hpp"

namespace raywatch {
namespace {

constexpr std::string_view kSilenceList = "silences";
const std::string kSelectSilences =
    "SELECT id, site, zone, sensor, from_at, until_at, actor, note, created_at FROM silences ";

SilenceRecord read_silence(Statement& row) {
  SilenceRecord record;
  record.id = row.take<SilenceId>();
  record.site = row.take<SiteId>();
  record.silence.zone = row.take<std::optional<ZoneId>>();
  record.silence.sensor = row.take<std::optional<SensorId>>();
  record.silence.from = row.take<Time>();
  record.silence.until = row.take<Time>();
  record.by = row.take<std::string>();
  record.note = row.take<std::string>();
  record.created_at = row.take<Time>();
  return record;
}

}  // namespace

SilenceRecord insert_silence(Transaction& transaction, const SilenceRecord& record, Time now) {
  transaction.impl().require_room_for_records();
  if (!find_site(transaction, record.site)) throw NotFound("there is no site " + std::to_string(record.site.value));
  const Silence& silence = record.silence;
  Database& database = database_of(transaction);
  database.run(
      "INSERT INTO silences (site, zone, sensor, from_at, until_at, actor, note, created_at) "
      "VALUES (?, ?, ?, ?, ?, ?, ?, ?)",
      record.site, silence.zone, silence.sensor, silence.from, silence.until, record.by, record.note, now);
  return find_silence(transaction, SilenceId{database.last_id()}).value();
}

std::optional<SilenceRecord> find_silence(const Snapshot& snapshot, SilenceId id) {
  Statement row(database_of(snapshot), kSelectSilences + "WHERE id = ?");
  if (!row.bind(id).next()) return std::nullopt;
  return read_silence(row);
}

Page<SilenceRecord> list_silences(const Snapshot& snapshot, std::optional<SiteId> site, const PageRequest& page) {
  const auto [before] = key_before<1>(page, kSilenceList, {std::numeric_limits<std::int64_t>::max()});
  // Silences are made by people: there are few, and walking through those of other sites costs little.
  Statement rows(database_of(snapshot),
                 kSelectSilences + "WHERE id < ?1 AND (?2 IS NULL OR site = ?2) ORDER BY id DESC LIMIT ?3");
  rows.bind(before, site, rows_to_read(page));
  std::vector<SilenceRecord> list;
  while (rows.next()) list.push_back(read_silence(rows));
  return make_page(std::move(list), page, kSilenceList, [](const SilenceRecord& s) { return std::array{s.id.value}; });
}

std::vector<Silence> silences_after(const Snapshot& snapshot, SiteId site, Time moment) {
  Statement rows(database_of(snapshot),
                 kSelectSilences + "INDEXED BY silences_by_site WHERE site = ? AND until_at > ? ORDER BY until_at, id");
  rows.bind(site, moment);
  std::vector<Silence> list;
  while (rows.next()) list.push_back(read_silence(rows).silence);
  return list;
}

void delete_silence(Transaction& transaction, SilenceId id) {
  database_of(transaction).run("DELETE FROM silences WHERE id = ?", id);
}

}  // namespace raywatch
