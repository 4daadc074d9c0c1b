#include "storage/schedules.hpp"

#include <array>

#include "core/names.hpp"
#include "storage/cursor.hpp"
#include "storage/sites.hpp"
#include "storage/snapshot.hpp"
#include "storage/survey_json.hpp"

namespace raywatch {
namespace {

constexpr std::string_view kScheduleList = "schedules";
constexpr Names<CatchUp, 3> kCatchUps{{{CatchUp::all, "all"}, {CatchUp::latest, "latest"}, {CatchUp::skip, "skip"}}};
const std::string kSelectSchedules =
    "SELECT id, site, name, enabled, spec, looked_until, created_at, edited_at FROM schedules ";

ScheduleRecord read_schedule(Statement& row) {
  ScheduleRecord record;
  record.id = row.take<ScheduleId>();
  record.site = row.take<SiteId>();
  record.name = row.take<std::string>();
  record.enabled = row.take<bool>();
  record.plan = plan_from_json(row.take<std::string>());
  record.looked_until = row.take<Time>();
  record.created_at = row.take<Time>();
  record.edited_at = row.take<Time>();
  return record;
}

void require_free_name(const Snapshot& snapshot, const ScheduleRecord& schedule) {
  const auto other = database_of(snapshot).find<ScheduleId>(
      "SELECT id FROM schedules INDEXED BY schedules_by_name WHERE site = ? AND name = ?", schedule.site,
      schedule.name);
  if (other && *other != schedule.id) {
    throw Conflict("the site has a schedule named \"" + schedule.name + "\" already");
  }
}

}  // namespace

std::string_view to_string(CatchUp catch_up) { return name_of(kCatchUps, catch_up); }
CatchUp parse_catch_up(std::string_view name) { return value_of(kCatchUps, name, "catch_up"); }

ScheduleRecord insert_schedule(Transaction& transaction, const ScheduleRecord& schedule, Time now) {
  transaction.impl().require_room_for_records();
  if (!find_site(transaction, schedule.site)) {
    throw NotFound("there is no site " + std::to_string(schedule.site.value));
  }
  require_free_name(transaction, schedule);
  Database& database = database_of(transaction);
  database.run(
      "INSERT INTO schedules (site, name, enabled, spec, fixed_epoch, looked_until, created_at, edited_at) "
      "VALUES (?, ?, ?, ?, ?, ?, ?, ?)",
      schedule.site, schedule.name, schedule.enabled, plan_json(schedule.plan),
      schedule.plan.definition.reference.epoch, schedule.looked_until, now, now);
  return find_schedule(transaction, ScheduleId{database.last_id()}).value();
}

std::optional<ScheduleRecord> find_schedule(const Snapshot& snapshot, ScheduleId id) {
  Statement row(database_of(snapshot), kSelectSchedules + "WHERE id = ?");
  if (!row.bind(id).next()) return std::nullopt;
  return read_schedule(row);
}

Page<ScheduleRecord> list_schedules(const Snapshot& snapshot, std::optional<SiteId> site, const PageRequest& page) {
  const auto [after] = key_before<1>(page, kScheduleList, {0});
  Statement rows(database_of(snapshot), kSelectSchedules +
                                            (site ? "INDEXED BY schedules_by_site WHERE site = ? AND " : "WHERE ") +
                                            "id > ? ORDER BY id LIMIT ?");
  if (site) rows.bind(*site);
  rows.bind(after, rows_to_read(page));
  std::vector<ScheduleRecord> schedules;
  while (rows.next()) schedules.push_back(read_schedule(rows));
  return make_page(std::move(schedules), page, kScheduleList,
                   [](const ScheduleRecord& s) { return std::array{s.id.value}; });
}

std::vector<ScheduleRecord> enabled_schedules(const Snapshot& snapshot) {
  Statement rows(database_of(snapshot),
                 kSelectSchedules + "INDEXED BY schedules_enabled WHERE enabled = 1 ORDER BY id");
  std::vector<ScheduleRecord> schedules;
  while (rows.next()) schedules.push_back(read_schedule(rows));
  return schedules;
}

ScheduleRecord replace_schedule(Transaction& transaction, const ScheduleRecord& schedule, Time now) {
  require_free_name(transaction, schedule);
  database_of(transaction)
      .run(
          "UPDATE schedules SET name = ?, enabled = ?, spec = ?, fixed_epoch = ?, looked_until = ?, edited_at = ? "
          "WHERE id = ?",
          schedule.name, schedule.enabled, plan_json(schedule.plan), schedule.plan.definition.reference.epoch,
          schedule.looked_until, now, schedule.id);
  return find_schedule(transaction, schedule.id).value();
}

void set_looked_until(Transaction& transaction, ScheduleId id, Time until) {
  database_of(transaction).run("UPDATE schedules SET looked_until = ? WHERE id = ?", until, id);
}

void delete_schedule(Transaction& transaction, ScheduleId id) {
  Database& database = database_of(transaction);
  for (const char* index :
       {"survey_runs_waiting WHERE state = 'queued'", "survey_runs_running WHERE state = 'running'"}) {
    if (database.find<int>(std::string("SELECT 1 FROM survey_runs INDEXED BY ") + index + " AND schedule = ?", id)) {
      throw Conflict("a run of the schedule is not finished; wait for it, or disable the schedule");
    }
  }
  database.run("DELETE FROM survey_levels WHERE schedule = ?", id);
  database.run("DELETE FROM schedules WHERE id = ?", id);
}

}  // namespace raywatch
