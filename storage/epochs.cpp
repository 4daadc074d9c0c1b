#include "storage/epochs.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <limits>
#include <map>

#include "core/names.hpp"
#include "storage/all_of_list.hpp"
#include "storage/cursor.hpp"
#include "storage/schedules.hpp"
#include "storage/sites.hpp"
#include "storage/snapshot.hpp"
#include "storage/survey_runs.hpp"

namespace raywatch {
namespace {

constexpr std::string_view kEpochList = "epochs";
constexpr Names<EpochState, 3> kEpochStates{
    {{EpochState::usable, "usable"}, {EpochState::accepted, "accepted"}, {EpochState::refused, "refused"}}};
const std::string kSelectEpochs =
    "SELECT id, site, schedule, name, from_at, to_at, state, why, accepted_by, accepted_note, accepted_at, created_at "
    "FROM epochs ";

std::vector<ScanId> scans_of(const Snapshot& snapshot, EpochId id) {
  Statement rows(database_of(snapshot), "SELECT scan FROM epoch_scans WHERE epoch = ? ORDER BY place");
  rows.bind(id);
  std::vector<ScanId> scans;
  while (rows.next()) scans.push_back(rows.take<ScanId>());
  return scans;
}

EpochRecord read_epoch(const Snapshot& snapshot, Statement& row) {
  EpochRecord epoch;
  epoch.id = row.take<EpochId>();
  epoch.site = row.take<SiteId>();
  epoch.schedule = row.take<std::optional<ScheduleId>>();
  epoch.name = row.take<std::string>();
  epoch.from = row.take<Time>();
  epoch.to = row.take<Time>();
  epoch.state = value_of(kEpochStates, row.take<std::string>(), "state");
  epoch.why = row.take<std::string>();
  const auto by = row.take<std::optional<std::string>>();
  const auto note = row.take<std::optional<std::string>>();
  const auto at = row.take<std::optional<Time>>();
  if (by && at) epoch.accepted = EpochAcceptance{*by, note.value_or(""), *at};
  epoch.created_at = row.take<Time>();
  epoch.scans = scans_of(snapshot, epoch.id);
  return epoch;
}

void add_scans_of(const Snapshot& snapshot, std::optional<EpochId> epoch, std::vector<ScanId>& all) {
  if (!epoch) return;
  const std::vector<ScanId> scans = scans_of(snapshot, *epoch);
  all.insert(all.end(), scans.begin(), scans.end());
}

/// What a schedule will compare its next epoch with.
void add_next_references(const Snapshot& snapshot, const ScheduleRecord& schedule, std::vector<ScanId>& all) {
  const SurveyReference& reference = schedule.plan.definition.reference;
  add_scans_of(snapshot, reference.epoch, all);
  EpochSearch search{.site = schedule.site, .schedule = schedule.id, .until = Time::max()};
  std::optional<EpochRecord> epoch = latest_epoch(snapshot, search);
  if (reference.policy == ReferencePolicy::accepted || !epoch) return;
  // Of the days before the latest all are needed yet, and one day more, as clocks change.
  const Time oldest = shifted(epoch->to, -std::chrono::days(reference.days > 0 ? reference.days + 1 : 0));
  for (; epoch && epoch->to >= oldest; epoch = latest_epoch(snapshot, search)) {
    add_scans_of(snapshot, epoch->id, all);
    search.until = epoch->to - Duration(1);
  }
}

void add_unfinished(const Snapshot& snapshot, const RunRecord& run, std::vector<ScanId>& all) {
  add_scans_of(snapshot, run.epoch, all);
  add_scans_of(snapshot, run.reference, all);
  Statement rows(
      database_of(snapshot),
      "SELECT id FROM scans INDEXED BY scans_by_site WHERE site = ? AND captured_at >= ? AND captured_at < ?");
  rows.bind(run.site, run.from, run.to);
  while (rows.next()) all.push_back(rows.take<ScanId>());
}

}  // namespace

std::vector<ScanRecord> scans_of_window(const Snapshot& snapshot, const EpochWindow& window) {
  std::map<VantageId, std::size_t> of_vantage;
  std::vector<ScanRecord> chosen;
  std::optional<std::string> cursor;
  std::size_t looked_at = 0;
  do {
    const Page<ScanRecord> page = list_scans(snapshot, {.site = window.site, .from = window.from, .to = window.to},
                                             {.limit = 1000, .cursor = cursor});
    for (const ScanRecord& scan : page.items) {
      const bool wanted =
          window.sensors.empty() || std::ranges::find(window.sensors, scan.sensor) != window.sensors.end();
      if (!wanted || chosen.size() == kMostScansOfEpoch || of_vantage[scan.vantage] == kMostScansOfVantage) continue;
      ++of_vantage[scan.vantage];
      chosen.push_back(scan);
    }
    looked_at += page.items.size();
    const bool enough = chosen.size() == kMostScansOfEpoch || looked_at >= kMostScansLookedAt;
    cursor = enough ? std::nullopt : page.next;
  } while (cursor);
  std::ranges::reverse(chosen);
  return chosen;
}

bool is_window_unsettled(const Snapshot& snapshot, const EpochWindow& window) {
  const std::vector<ScanRecord> scans = scans_of_window(snapshot, window);
  return std::ranges::any_of(scans, [](const ScanRecord& scan) {
    return scan.state == ScanState::queued || scan.state == ScanState::comparing;
  });
}

std::string_view to_string(EpochState state) { return name_of(kEpochStates, state); }

EpochRecord insert_epoch(Transaction& transaction, const EpochRecord& epoch, Time now) {
  transaction.impl().require_room_for_records();
  if (!find_site(transaction, epoch.site)) throw NotFound("there is no site " + std::to_string(epoch.site.value));
  Database& database = database_of(transaction);
  database.run(
      "INSERT INTO epochs (site, schedule, name, from_at, to_at, state, why, created_at) VALUES (?, ?, ?, ?, ?, ?, ?, "
      "?)",
      epoch.site, epoch.schedule, epoch.name, epoch.from, epoch.to, to_string(epoch.state), epoch.why, now);
  const EpochId id{database.last_id()};
  std::int64_t place = 0;
  for (const ScanId scan : epoch.scans) database.run("INSERT INTO epoch_scans VALUES (?, ?, ?)", id, place++, scan);
  return find_epoch(transaction, id).value();
}

std::optional<EpochRecord> find_epoch(const Snapshot& snapshot, EpochId id) {
  Statement row(database_of(snapshot), kSelectEpochs + "WHERE id = ?");
  if (!row.bind(id).next()) return std::nullopt;
  return read_epoch(snapshot, row);
}

Page<EpochRecord> list_epochs(const Snapshot& snapshot, std::optional<SiteId> site, const PageRequest& page) {
  constexpr std::int64_t kMax = std::numeric_limits<std::int64_t>::max();
  const auto [before_to, before_id] = key_before<2>(page, kEpochList, {kMax, kMax});
  Statement rows(database_of(snapshot),
                 kSelectEpochs +
                     (site ? "INDEXED BY epochs_by_site WHERE site = ? AND " : "INDEXED BY epochs_by_end WHERE ") +
                     "(to_at, id) < (?, ?) ORDER BY to_at DESC, id DESC LIMIT ?");
  if (site) rows.bind(*site);
  rows.bind(before_to, before_id, rows_to_read(page));
  std::vector<EpochRecord> epochs;
  while (rows.next()) epochs.push_back(read_epoch(snapshot, rows));
  return make_page(std::move(epochs), page, kEpochList, [](const EpochRecord& e) {
    return std::array<std::int64_t, 2>{e.to.time_since_epoch().count(), e.id.value};
  });
}

EpochRecord accept_epoch(Transaction& transaction, EpochId id, const EpochAcceptance& acceptance) {
  const EpochRecord epoch = find_epoch(transaction, id).value();
  if (epoch.state == EpochState::refused) throw Conflict("the epoch was refused: " + epoch.why);
  database_of(transaction)
      .run("UPDATE epochs SET state = 'accepted', accepted_by = ?, accepted_note = ?, accepted_at = ? WHERE id = ?",
           acceptance.by, acceptance.note, acceptance.at, id);
  return find_epoch(transaction, id).value();
}

void delete_epoch(Transaction& transaction, EpochId id) {
  const EpochRecord epoch = find_epoch(transaction, id).value();
  for (const ScheduleRecord& schedule :
       all_of_list([&](const PageRequest& page) { return list_schedules(transaction, epoch.site, page); })) {
    if (schedule.plan.definition.reference.epoch == id) {
      throw Conflict("the schedule \"" + schedule.name + "\" is compared with this epoch; change the schedule first");
    }
  }
  for (const RunRecord& run : unfinished_runs(transaction, epoch.site)) {
    if (run.epoch == id || run.reference == id) throw Conflict("a survey of this epoch is not finished");
  }
  database_of(transaction).run("DELETE FROM epoch_scans WHERE epoch = ?", id);
  database_of(transaction).run("DELETE FROM epochs WHERE id = ?", id);
}

std::optional<EpochRecord> latest_epoch(const Snapshot& snapshot, const EpochSearch& search) {
  Statement row(database_of(snapshot), kSelectEpochs +
                                           (search.schedule ? "INDEXED BY epochs_by_schedule WHERE schedule = ?"
                                                            : "INDEXED BY epochs_by_site WHERE site = ?") +
                                           " AND to_at <= ? AND to_at > ? AND state " +
                                           (search.accepted ? "= 'accepted'" : "<> 'refused'") +
                                           " ORDER BY to_at DESC, id DESC LIMIT 1");
  row.bind(search.schedule ? search.schedule->value : search.site.value, search.until,
           search.from.value_or(Time::min()));
  if (!row.next()) return std::nullopt;
  return read_epoch(snapshot, row);
}

std::vector<ScanId> scans_that_surveys_need(const Snapshot& snapshot, SiteId site) {
  std::vector<ScanId> all;
  Statement rows(database_of(snapshot),
                 "SELECT epoch_scans.scan FROM epochs INDEXED BY epochs_accepted CROSS JOIN epoch_scans "
                 "ON epoch_scans.epoch = epochs.id WHERE epochs.site = ? AND epochs.state = 'accepted'");
  rows.bind(site);
  while (rows.next()) all.push_back(rows.take<ScanId>());
  for (const ScheduleRecord& schedule :
       all_of_list([&](const PageRequest& page) { return list_schedules(snapshot, site, page); })) {
    add_next_references(snapshot, schedule, all);
  }
  for (const RunRecord& run : unfinished_runs(snapshot, site)) add_unfinished(snapshot, run, all);
  return all;
}

bool is_in_accepted_epoch(const Snapshot& snapshot, ScanId scan) {
  return database_of(snapshot)
      .find<int>(
          "SELECT 1 FROM epoch_scans INDEXED BY epoch_scans_by_scan CROSS JOIN epochs ON epochs.id = "
          "epoch_scans.epoch WHERE epoch_scans.scan = ? AND epochs.state = 'accepted' LIMIT 1",
          scan)
      .has_value();
}

}  // namespace raywatch
