#include "api/parse_survey.hpp"

#include <algorithm>

#include "api/lookup.hpp"
#include "api/name_rules.hpp"
#include "api/units.hpp"
#include "core/cron.hpp"
#include "storage/epochs.hpp"

namespace raywatch {
namespace {

constexpr double kLongestWindow_s = 31.0 * 86400.0;

template <class SomeId>
std::vector<SomeId> parse_ids(JsonObject& body, const char* member) {
  std::vector<SomeId> ids;
  for (const std::int64_t id : body.integers(member, {.min = 1}).value_or(std::vector<std::int64_t>{})) {
    ids.push_back(SomeId{id});
  }
  return ids;
}

SurveyReference parse_reference(JsonObject& survey) {
  SurveyReference reference;
  auto given = survey.object("reference");
  if (!given) return reference;
  reference.policy = given->parsed("policy", parse_reference_policy).value_or(reference.policy);
  if (const auto epoch = given->integer("epoch", {.min = 1})) reference.epoch = EpochId{*epoch};
  reference.days = static_cast<std::uint32_t>(given->integer("days", {.min = 1, .max = 3650}).value_or(0));
  given->finish();
  return reference;
}

RegistrationTolerance parse_tolerance(JsonObject& survey) {
  RegistrationTolerance tolerance;
  auto given = survey.object("tolerance");
  if (!given) return tolerance;
  tolerance.residual_m = given->real("residual_m").value_or(tolerance.residual_m);
  PoseUncertainty& uncertainty = tolerance.uncertainty;
  uncertainty.position_m = given->real("position_m").value_or(uncertainty.position_m);
  if (const auto angle_deg = given->real("angle_deg")) uncertainty.angle_rad = radians_of_deg(*angle_deg);
  given->finish();
  return tolerance;
}

FigureThresholds parse_thresholds(JsonObject given) {
  FigureThresholds result;
  given.require("figure");
  result.figure = given.parsed("figure", parse_survey_figure).value_or(result.figure);
  if (const auto zone = given.integer("zone", {.min = 1})) result.zone = ZoneId{*zone};
  LevelThresholds& t = result.thresholds;
  t.yellow = given.real("yellow");
  t.orange = given.real("orange");
  t.red = given.real("red");
  t.clear_share = given.real("clear_share").value_or(t.clear_share);
  const IntegerBounds counts{.min = 1, .max = 1000};
  t.raise_after = static_cast<std::uint32_t>(given.integer("raise_after", counts).value_or(t.raise_after));
  t.clear_after = static_cast<std::uint32_t>(given.integer("clear_after", counts).value_or(t.clear_after));
  given.finish();
  return result;
}

void parse_all_thresholds(JsonObject& survey, FieldErrors& errors, SurveyDefinition& definition) {
  constexpr std::size_t kMost = 200;
  const nlohmann::json* all = survey.any("thresholds");
  if (all == nullptr || all->is_null()) return;
  if (!all->is_array() || all->size() > kMost) {
    return survey.fail("thresholds",
                       R"(must be an array of at most 200 objects {"figure", "yellow", "orange", "red"})");
  }
  for (std::size_t i = 0; i < all->size(); ++i) {
    definition.thresholds.push_back(
        parse_thresholds(JsonObject((*all)[i], "survey.thresholds." + std::to_string(i), errors)));
  }
}

Duration parse_seconds(JsonObject& body, const char* member, const RealBounds& bounds, Duration otherwise) {
  const auto seconds = body.real(member, bounds);
  return seconds ? duration_of_seconds(*seconds) : otherwise;
}

/// What `check` throws stands for what it is about.
template <class Check>
void gather(FieldErrors& errors, const char* place, Check check) {
  try {
    check();
  } catch (const InvalidInput& error) {
    for (const FieldError& wrong : error.fields()) errors.add(place + wrong.field, wrong.message);
  }
}

void parse_plan(JsonObject& body, FieldErrors& errors, SchedulePlan& plan) {
  body.require("cron");
  plan.cron = body.text("cron").value_or("");
  if (!plan.cron.empty()) gather(errors, "", [&] { parse_cron(plan.cron); });
  plan.time_zone = body.parsed("time_zone", checked_time_zone).value_or("");
  plan.window = parse_seconds(body, "window_s", {.min = 60.0, .max = kLongestWindow_s}, plan.window);
  plan.grace = parse_seconds(body, "grace_s", {.min = 0.0, .max = kLongestWindow_s}, plan.grace);
  plan.required_vantages = parse_ids<VantageId>(body, "required_vantages");
  plan.catch_up = body.parsed("catch_up", parse_catch_up).value_or(plan.catch_up);
  plan.definition = parse_definition(body, errors);
}

}  // namespace

SurveyDefinition parse_definition(JsonObject& body, FieldErrors& errors) {
  SurveyDefinition definition;
  auto survey = body.object("survey");
  if (!survey) return definition;
  definition.zones = parse_ids<ZoneId>(*survey, "zones");
  definition.cell_m = survey->real("cell_m").value_or(definition.cell_m);
  definition.core_spacing_m = survey->real("core_spacing_m").value_or(definition.core_spacing_m);
  definition.density_t_per_m3 = survey->real("density_t_per_m3");
  definition.greatest_slope_deg = survey->real("greatest_slope_deg");
  definition.reference = parse_reference(*survey);
  definition.tolerance = parse_tolerance(*survey);
  parse_all_thresholds(*survey, errors, definition);
  survey->finish();
  gather(errors, "survey.", [&] { check_definition(definition); });
  return definition;
}

std::vector<std::string> parse_names(JsonObject& body, const char* member) {
  const nlohmann::json* names = body.any(member);
  if (names == nullptr || names->is_null()) return {};
  const bool fine =
      names->is_array() && std::ranges::all_of(*names, [](const nlohmann::json& name) { return name.is_string(); });
  if (fine) return names->get<std::vector<std::string>>();
  body.fail(member, "must be an array of names");
  return {};
}

GivenSchedule parse_schedule(const nlohmann::json& json, Time now) {
  FieldErrors errors;
  JsonObject body(json, "", errors);
  GivenSchedule given;
  body.require("site");
  body.require("name");
  given.site = body.text("site").value_or("");
  given.name = body.parsed("name", checked_name).value_or("");
  given.enabled = body.flag("enabled").value_or(true);
  given.sensors = parse_names(body, "sensors");
  given.required_sensors = parse_names(body, "required_sensors");
  given.since = body.time("since");
  if (given.since && *given.since > now) body.fail("since", "must not be later than now");
  parse_plan(body, errors, given.plan);
  body.finish();
  errors.throw_if_any();
  return given;
}

GivenWindow parse_window(JsonObject& body) {
  for (const char* member : {"from", "to"}) body.require(member);
  GivenWindow given;
  given.from = body.time("from").value_or(Time::min());
  given.to = body.time("to").value_or(Time::max());
  if (given.from >= given.to) body.fail("to", "must be later than 'from'");
  given.sensors = parse_names(body, "sensors");
  return given;
}

EpochRecord epoch_of_window(const Snapshot& snapshot, SiteId site, const GivenWindow& window,
                            const std::string& place) {
  EpochRecord epoch;
  epoch.site = site;
  epoch.name = "from " + format_rfc3339(window.from);
  epoch.from = window.from;
  epoch.to = window.to;
  const std::vector<SensorId> sensors = sensors_named(snapshot, window.sensors, site, (place + "sensors").c_str());
  for (const ScanRecord& scan : scans_of_window(snapshot, {site, window.from, window.to, sensors})) {
    epoch.scans.push_back(scan.id);
  }
  if (epoch.scans.empty()) {
    throw InvalidInput("The epoch would be empty.", {{place + "from", "there are no scans between 'from' and 'to'"}});
  }
  return epoch;
}

std::vector<SensorId> sensors_named(const Snapshot& snapshot, const std::vector<std::string>& names, SiteId site,
                                    const char* member) {
  std::vector<SensorId> sensors;
  for (const std::string& name : names) {
    const Sensor sensor = sensor_named(snapshot, name);
    if (sensor.site != site) {
      throw InvalidInput("The sensor is not of the site.", {{member, "'" + name + "' belongs to another site"}});
    }
    sensors.push_back(sensor.id);
  }
  return sensors;
}

void check_zones(const Snapshot& snapshot, const SurveyDefinition& definition, SiteId site) {
  const auto require_zone = [&](ZoneId id, const std::string& field) {
    const ZoneRecord zone = zone_with(snapshot, id);
    if (zone.site == site && zone.zone.kind == ZoneKind::volume) return;
    throw InvalidInput("A zone cannot be surveyed.", {{field, "zone " + std::to_string(id.value) +
                                                                  " must be of the site and of the kind \"volume\""}});
  };
  for (const ZoneId zone : definition.zones) require_zone(zone, "survey.zones");
  for (std::size_t i = 0; i < definition.thresholds.size(); ++i) {
    const std::optional<ZoneId>& zone = definition.thresholds[i].zone;
    if (zone) require_zone(*zone, "survey.thresholds." + std::to_string(i) + ".zone");
  }
  const std::optional<EpochId>& epoch = definition.reference.epoch;
  const std::optional<EpochRecord> found = epoch ? find_epoch(snapshot, *epoch) : std::nullopt;
  if (epoch && (!found || found->site != site || found->state == EpochState::refused)) {
    throw InvalidInput("The epoch to compare with cannot be used.",
                       {{"survey.reference.epoch", "must be an epoch of the site that was not refused"}});
  }
}

}  // namespace raywatch
