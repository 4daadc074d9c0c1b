#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/survey_definition.hpp"
#include "core/time.hpp"
#include "storage/page.hpp"
#include "storage/store.hpp"

namespace raywatch {

/// What becomes of runs that were due while nobody could make them.
enum class CatchUp : std::uint8_t {
  all,     ///< each is made, oldest first
  latest,  ///< the latest of them is made, the others are skipped
  skip,    ///< none is made but one that has only just been missed
};
std::string_view to_string(CatchUp catch_up);
/// @throws InvalidInput naming the known ones.
CatchUp parse_catch_up(std::string_view name);

/// What a schedule does, and when.
struct SchedulePlan {
  std::string cron;
  std::string time_zone;                          ///< IANA name
  Duration window = std::chrono::hours(6);        ///< the epoch: scans captured at most so long before a due time
  Duration grace = std::chrono::minutes(10);      ///< a run begins so long after its due time: late scans may come
  std::vector<SensorId> sensors = {};             ///< only their scans; none: of all
  std::vector<SensorId> required_sensors = {};    ///< without a scan of each of these the night counts as missed
  std::vector<VantageId> required_vantages = {};  ///< the same of places
  CatchUp catch_up = CatchUp::latest;
  SurveyDefinition definition = {};
};

struct ScheduleRecord {
  ScheduleId id;
  SiteId site;
  std::string name;
  bool enabled = true;
  SchedulePlan plan;
  Time looked_until;  ///< runs that were due until then were made, or skipped
  Time created_at, edited_at;
};

/// Its id, created_at and edited_at are decided here.
/// @throws Conflict when the site has a schedule of that name; NotFound for the site.
ScheduleRecord insert_schedule(Transaction& transaction, const ScheduleRecord& schedule, Time now);
std::optional<ScheduleRecord> find_schedule(const Snapshot& snapshot, ScheduleId id);
/// Oldest first.
Page<ScheduleRecord> list_schedules(const Snapshot& snapshot, std::optional<SiteId> site, const PageRequest& page);
std::vector<ScheduleRecord> enabled_schedules(const Snapshot& snapshot);
/// Replaces everything but the site. @throws Conflict when the name is taken.
ScheduleRecord replace_schedule(Transaction& transaction, const ScheduleRecord& schedule, Time now);
void set_looked_until(Transaction& transaction, ScheduleId id, Time until);
/// Its runs, epochs and surveys stay. @throws Conflict while a run of it is queued or running.
void delete_schedule(Transaction& transaction, ScheduleId id);

}  // namespace raywatch
