#pragma once

// Internal: only .cpp files of api/ include this.
#include "api/json_object.hpp"
#include "core/survey_definition.hpp"
#include "storage/epochs.hpp"
#include "storage/schedules.hpp"
#include "storage/store.hpp"

namespace raywatch {

/// How a survey is made, from a member "survey"; absent: all defaults. What is wrong is gathered in `errors`, but for
/// what `check_definition` finds, which is for the caller to call.
SurveyDefinition parse_definition(JsonObject& body, FieldErrors& errors);

/// A schedule as it is given; names are not looked up yet.
struct GivenSchedule {
  std::string site;
  std::string name;
  bool enabled = true;
  SchedulePlan plan;  ///< without its sensors; its time zone is empty when it is not given
  std::vector<std::string> sensors, required_sensors;
  std::optional<Time> since;
};
/// @throws InvalidInput with all that is wrong, also with the cron expression and the definition.
GivenSchedule parse_schedule(const nlohmann::json& json, Time now);

/// The names of sensors, from an array of texts.
std::vector<std::string> parse_names(JsonObject& body, const char* member);

/// A time window, from the members "from", "to" and "sensors"; no sensors: all.
struct GivenWindow {
  Time from, to;
  std::vector<std::string> sensors;
};
GivenWindow parse_window(JsonObject& body);
/// The epoch of its scans, which is not stored yet. `place` stands before the names of members that are wrong:
/// "before.".
/// @throws InvalidInput naming `from` when it has no scans; NotFound of a sensor.
EpochRecord epoch_of_window(const Snapshot& snapshot, SiteId site, const GivenWindow& window, const std::string& place);

/// @{ What it names. @throws NotFound, InvalidInput.
std::vector<SensorId> sensors_named(const Snapshot& snapshot, const std::vector<std::string>& names, SiteId site,
                                    const char* member);
void check_zones(const Snapshot& snapshot, const SurveyDefinition& definition, SiteId site);
/// @}

}  // namespace raywatch
