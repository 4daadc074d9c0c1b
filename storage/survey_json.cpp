#include "storage/survey_json.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

#include "storage/columns.hpp"

namespace raywatch {
namespace {

using Json = nlohmann::json;

std::string dump(const Json& json) { return json.dump(-1, ' ', false, Json::error_handler_t::replace); }

template <class Read>
auto parse(const std::string& text, const Read& read) {
  try {
    return read(Json::parse(text));
  } catch (const Json::exception& error) {
    throw CorruptData(std::string("the store holds a broken JSON text: ") + error.what());
  }
}

/// @{ A number that need not be finite: infinity and NaN are null in JSON.
Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }
double number(const Json& json) {
  return json.is_null() ? std::numeric_limits<double>::quiet_NaN() : json.get<double>();
}
/// @}

template <class T>
Json or_null(const std::optional<T>& value) {
  return value ? Json(*value) : Json(nullptr);
}
template <class T>
std::optional<T> optional_of(const Json& json) {
  return json.is_null() ? std::nullopt : std::optional(json.get<T>());
}

template <class SomeId>
Json ids(const std::vector<SomeId>& all) {
  Json list = Json::array();
  for (const SomeId id : all) list.push_back(id.value);
  return list;
}
template <class SomeId>
std::vector<SomeId> ids_of(const Json& json) {
  std::vector<SomeId> all;
  for (const Json& id : json) all.push_back(SomeId{id.get<std::int64_t>()});
  return all;
}
template <class SomeId>
Json id_of(const std::optional<SomeId>& id) {
  return id ? Json(id->value) : Json(nullptr);
}
template <class SomeId>
std::optional<SomeId> optional_id(const Json& json) {
  return json.is_null() ? std::nullopt : std::optional(SomeId{json.get<std::int64_t>()});
}

Json json_of(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }
Eigen::Vector3d vector_of(const Json& json) {
  return {json.at(0).get<double>(), json.at(1).get<double>(), json.at(2).get<double>()};
}
Json json_of(const Pose& pose) {
  const Eigen::Quaterniond& q = pose.orientation;
  return {pose.position_m.x(), pose.position_m.y(), pose.position_m.z(), q.x(), q.y(), q.z(), q.w()};
}
Pose pose_of(const Json& json) {
  const auto n = json.get<std::array<double, 7>>();
  return {Eigen::Quaterniond(n[6], n[3], n[4], n[5]), {n[0], n[1], n[2]}};
}
Json json_of(const PoseUncertainty& u) { return {u.position_m, u.angle_rad}; }
PoseUncertainty uncertainty_of(const Json& json) { return {json.at(0).get<double>(), json.at(1).get<double>()}; }

Json json_of(const FigureThresholds& given) {
  const LevelThresholds& t = given.thresholds;
  return {{"figure", to_string(given.figure)}, {"zone", id_of(given.zone)},   {"yellow", or_null(t.yellow)},
          {"orange", or_null(t.orange)},       {"red", or_null(t.red)},       {"clear_share", t.clear_share},
          {"raise_after", t.raise_after},      {"clear_after", t.clear_after}};
}
FigureThresholds thresholds_of(const Json& json) {
  return {.figure = parse_survey_figure(json.at("figure").get<std::string>()),
          .zone = optional_id<ZoneId>(json.at("zone")),
          .thresholds = {.yellow = optional_of<double>(json.at("yellow")),
                         .orange = optional_of<double>(json.at("orange")),
                         .red = optional_of<double>(json.at("red")),
                         .clear_share = json.at("clear_share").get<double>(),
                         .raise_after = json.at("raise_after").get<std::uint32_t>(),
                         .clear_after = json.at("clear_after").get<std::uint32_t>()}};
}

Json json_of(const M3c2Parameters& p) {
  return {{"normal_diameter_m", p.normal_diameter_m}, {"projection_diameter_m", p.projection_diameter_m},
          {"max_distance_m", p.max_distance_m},       {"registration_m", p.registration_m},
          {"least_points", p.least_points},           {"median", p.statistic == M3c2Statistic::median}};
}
M3c2Parameters m3c2_of(const Json& json) {
  return {.normal_diameter_m = json.at("normal_diameter_m").get<double>(),
          .projection_diameter_m = json.at("projection_diameter_m").get<double>(),
          .max_distance_m = json.at("max_distance_m").get<double>(),
          .registration_m = json.at("registration_m").get<double>(),
          .least_points = json.at("least_points").get<std::size_t>(),
          .statistic = json.at("median").get<bool>() ? M3c2Statistic::median : M3c2Statistic::mean};
}

Json json_of(const SurveyDefinition& d) {
  Json thresholds = Json::array();
  for (const FigureThresholds& given : d.thresholds) thresholds.push_back(json_of(given));
  return {
      {"zones", ids(d.zones)},
      {"cell_m", d.cell_m},
      {"elevation_median", d.elevation.height == CellHeight::median},
      {"least_quarters", d.elevation.least_quarters},
      {"m3c2", json_of(d.m3c2)},
      {"core_spacing_m", d.core_spacing_m},
      {"reference", to_string(d.reference.policy)},
      {"reference_epoch", id_of(d.reference.epoch)},
      {"reference_days", d.reference.days},
      {"tolerance", {d.tolerance.residual_m, d.tolerance.uncertainty.position_m, d.tolerance.uncertainty.angle_rad}},
      {"density_t_per_m3", or_null(d.density_t_per_m3)},
      {"greatest_slope_deg", or_null(d.greatest_slope_deg)},
      {"thresholds", thresholds}};
}
SurveyDefinition definition_of(const Json& json) {
  SurveyDefinition d;
  d.zones = ids_of<ZoneId>(json.at("zones"));
  d.cell_m = json.at("cell_m").get<double>();
  d.elevation.height = json.at("elevation_median").get<bool>() ? CellHeight::median : CellHeight::mean;
  d.elevation.least_quarters = json.at("least_quarters").get<std::uint32_t>();
  d.m3c2 = m3c2_of(json.at("m3c2"));
  d.core_spacing_m = json.at("core_spacing_m").get<double>();
  d.reference = {parse_reference_policy(json.at("reference").get<std::string>()),
                 optional_id<EpochId>(json.at("reference_epoch")), json.at("reference_days").get<std::uint32_t>()};
  const Json& tolerance = json.at("tolerance");
  d.tolerance = {tolerance.at(0).get<double>(), {tolerance.at(1).get<double>(), tolerance.at(2).get<double>()}};
  d.density_t_per_m3 = optional_of<double>(json.at("density_t_per_m3"));
  // Definitions that were stored before there was such a field do not have it.
  if (json.contains("greatest_slope_deg")) d.greatest_slope_deg = optional_of<double>(json.at("greatest_slope_deg"));
  for (const Json& given : json.at("thresholds")) d.thresholds.push_back(thresholds_of(given));
  return d;
}

Json json_of(const VolumeFigure& v) { return {v.value_m3, v.random_sigma_m3, v.pose_sigma_m3}; }
VolumeFigure volume_of(const Json& json) { return {number(json.at(0)), number(json.at(1)), number(json.at(2))}; }
Json json_of(const ChangeExtent& e) { return {e.greatest_rise_m, e.greatest_fall_m, e.mean_m}; }
ChangeExtent extent_of(const Json& json) { return {number(json.at(0)), number(json.at(1)), number(json.at(2))}; }
Json json_of(const MassFigure& m) { return {m.value_t, m.low_t, m.high_t}; }
MassFigure mass_from(const Json& json) { return {number(json.at(0)), number(json.at(1)), number(json.at(2))}; }

Json json_of(const SurveyZone& zone) {
  Json polygon = Json::array();
  for (const Eigen::Vector2d& p : zone.prism.polygon_m) polygon.push_back({p.x(), p.y()});
  return {{"zone", id_of(zone.zone)},
          {"name", zone.name},
          {"polygon_m", polygon},
          {"z_min_m", zone.prism.z_min_m},
          {"z_max_m", zone.prism.z_max_m}};
}
SurveyZone zone_of(const Json& json) {
  SurveyZone zone{
      .zone = optional_id<ZoneId>(json.at("zone")), .name = json.at("name").get<std::string>(), .prism = {}};
  for (const Json& p : json.at("polygon_m")) {
    zone.prism.polygon_m.emplace_back(p.at(0).get<double>(), p.at(1).get<double>());
  }
  zone.prism.z_min_m = json.at("z_min_m").get<double>();
  zone.prism.z_max_m = json.at("z_max_m").get<double>();
  return zone;
}

Json json_of(const ZoneVolumes& v) {
  return {{"cut", json_of(v.cut)},
          {"fill", json_of(v.fill)},
          {"changed_net", json_of(v.changed_net)},
          {"net", json_of(v.net)},
          {"area_m2", v.area_m2},
          {"seen_area_m2", v.seen_area_m2},
          {"changed_area_m2", v.changed_area_m2},
          {"vertical", json_of(v.vertical)},
          {"normal", json_of(v.normal)},
          {"unseen", {number(v.unseen.low_m3), number(v.unseen.high_m3)}}};
}
ZoneVolumes volumes_of(const Json& json) {
  ZoneVolumes v;
  v.cut = volume_of(json.at("cut"));
  v.fill = volume_of(json.at("fill"));
  v.changed_net = volume_of(json.at("changed_net"));
  v.net = volume_of(json.at("net"));
  v.area_m2 = json.at("area_m2").get<double>();
  v.seen_area_m2 = json.at("seen_area_m2").get<double>();
  v.changed_area_m2 = json.at("changed_area_m2").get<double>();
  v.vertical = extent_of(json.at("vertical"));
  v.normal = extent_of(json.at("normal"));
  v.unseen = {number(json.at("unseen").at(0)), number(json.at("unseen").at(1))};
  return v;
}

Json json_of(const M3c2Figures& m) {
  return {m.core_points, m.measured, m.significant, m.greatest_rise_m, m.greatest_fall_m, m.mean_m, m.mean_lod95_m};
}
M3c2Figures m3c2_figures_of(const Json& json) {
  return {.core_points = json.at(0).get<std::size_t>(),
          .measured = json.at(1).get<std::size_t>(),
          .significant = json.at(2).get<std::size_t>(),
          .greatest_rise_m = number(json.at(3)),
          .greatest_fall_m = number(json.at(4)),
          .mean_m = number(json.at(5)),
          .mean_lod95_m = number(json.at(6))};
}

Json json_of(const ZoneFigures& figures) {
  Json json = {{"zone", json_of(figures.zone)}, {"volumes", json_of(figures.volumes)}, {"m3c2", json_of(figures.m3c2)}};
  if (figures.masses) {
    json["masses"] = {json_of(figures.masses->cut), json_of(figures.masses->fill), json_of(figures.masses->net)};
  }
  return json;
}
ZoneFigures figures_of(const Json& json) {
  ZoneFigures figures{.zone = zone_of(json.at("zone")),
                      .volumes = volumes_of(json.at("volumes")),
                      .m3c2 = m3c2_figures_of(json.at("m3c2")),
                      .masses = std::nullopt};
  if (const auto masses = json.find("masses"); masses != json.end()) {
    figures.masses = ZoneMasses{mass_from(masses->at(0)), mass_from(masses->at(1)), mass_from(masses->at(2))};
  }
  return figures;
}

Json json_of(const SurveyedScan& scan) {
  return {{"scan", scan.scan.value},
          {"station", scan.station.value},
          {"sensor", scan.sensor.value},
          {"captured_at", scan.captured_at.time_since_epoch().count()},
          {"points", scan.points},
          {"sha256", scan.sha256},
          {"pose", json_of(scan.world_from_sensor)},
          {"registration", to_string(scan.registration)},
          {"residual_m", or_null(scan.residual_m)},
          {"uncertainty", json_of(scan.uncertainty)}};
}
SurveyedScan surveyed_of(const Json& json) {
  return {.scan = ScanId{json.at("scan").get<std::int64_t>()},
          .station = VantageId{json.at("station").get<std::int64_t>()},
          .sensor = SensorId{json.at("sensor").get<std::int64_t>()},
          .captured_at = Time(Duration(json.at("captured_at").get<std::int64_t>())),
          .points = json.at("points").get<std::size_t>(),
          .sha256 = json.at("sha256").get<std::string>(),
          .world_from_sensor = pose_of(json.at("pose")),
          .registration = parse_registration_state(json.at("registration").get<std::string>()),
          .residual_m = optional_of<double>(json.at("residual_m")),
          .uncertainty = uncertainty_of(json.at("uncertainty"))};
}

Json json_of(const SurveyChange& survey_change) {
  const Change& change = survey_change.change;
  const Confidence& c = change.confidence;
  Json json = {{"kind", to_string(change.kind)},
               {"centroid_m", json_of(change.centroid_m)},
               {"min_m", json_of(Eigen::Vector3d(change.bounds_m.min()))},
               {"max_m", json_of(Eigen::Vector3d(change.bounds_m.max()))},
               {"box", json_of(Pose{change.box.world_from_box, change.box.center_m})},
               {"size_m", json_of(change.box.size_m)},
               {"volume_m3", change.volume_m3},
               {"points", change.points},
               {"confidence", {c.value, c.free, c.supported, c.unknown}},
               {"net", json_of(survey_change.volume.net)},
               {"area_m2", survey_change.volume.area_m2},
               {"seen_area_m2", survey_change.volume.seen_area_m2},
               {"zones", survey_change.zones}};
  if (survey_change.mass) json["mass"] = json_of(*survey_change.mass);
  return json;
}
template <class T>
Json list_of(const std::vector<T>& items) {
  Json list = Json::array();
  for (const T& item : items) list.push_back(json_of(item));
  return list;
}

SurveyChange change_of(const Json& json) {
  SurveyChange result;
  Change& change = result.change;
  change.kind = parse_change_kind(json.at("kind").get<std::string>());
  change.centroid_m = vector_of(json.at("centroid_m"));
  change.bounds_m = {vector_of(json.at("min_m")), vector_of(json.at("max_m"))};
  const Pose box = pose_of(json.at("box"));
  change.box = {box.position_m, vector_of(json.at("size_m")), box.orientation};
  change.volume_m3 = json.at("volume_m3").get<double>();
  change.points = json.at("points").get<std::size_t>();
  const auto c = json.at("confidence").get<std::array<double, 4>>();
  change.confidence = {c[0], c[1], c[2], c[3]};
  result.volume = {volume_of(json.at("net")), json.at("area_m2").get<double>(), json.at("seen_area_m2").get<double>()};
  result.zones = json.at("zones").get<std::vector<std::size_t>>();
  if (const auto mass = json.find("mass"); mass != json.end()) result.mass = mass_from(*mass);
  return result;
}

}  // namespace

std::string plan_json(const SchedulePlan& plan) {
  return dump({{"cron", plan.cron},
               {"time_zone", plan.time_zone},
               {"window_ns", plan.window.count()},
               {"grace_ns", plan.grace.count()},
               {"sensors", ids(plan.sensors)},
               {"required_sensors", ids(plan.required_sensors)},
               {"required_vantages", ids(plan.required_vantages)},
               {"catch_up", to_string(plan.catch_up)},
               {"definition", json_of(plan.definition)}});
}

SchedulePlan plan_from_json(const std::string& text) {
  return parse(text, [](const Json& json) {
    return SchedulePlan{.cron = json.at("cron").get<std::string>(),
                        .time_zone = json.at("time_zone").get<std::string>(),
                        .window = Duration(json.at("window_ns").get<std::int64_t>()),
                        .grace = Duration(json.at("grace_ns").get<std::int64_t>()),
                        .sensors = ids_of<SensorId>(json.at("sensors")),
                        .required_sensors = ids_of<SensorId>(json.at("required_sensors")),
                        .required_vantages = ids_of<VantageId>(json.at("required_vantages")),
                        .catch_up = parse_catch_up(json.at("catch_up").get<std::string>()),
                        .definition = definition_of(json.at("definition"))};
  });
}

std::string definition_json(const SurveyDefinition& definition) { return dump(json_of(definition)); }
SurveyDefinition definition_from_json(const std::string& text) { return parse(text, definition_of); }

std::string log_json(const std::vector<RunLogLine>& log) {
  Json json = Json::array();
  for (const RunLogLine& line : log) json.push_back({{"at", line.at.time_since_epoch().count()}, {"text", line.text}});
  return dump(json);
}
std::vector<RunLogLine> log_from_json(const std::string& text) {
  return parse(text, [](const Json& json) {
    std::vector<RunLogLine> log;
    for (const Json& line : json) {
      log.push_back({Time(Duration(line.at("at").get<std::int64_t>())), line.at("text").get<std::string>()});
    }
    return log;
  });
}

std::string result_json(const SurveyResult& result) {
  return dump({{"definition", json_of(result.definition)},
               {"parameters", parameters_json(result.parameters)},
               {"program_version", result.program_version},
               {"before", list_of(result.before)},
               {"after", list_of(result.after)},
               {"zones", list_of(result.zones)},
               {"total", json_of(result.total)},
               {"testable", {result.testable_before, result.testable_after}},
               {"registration_m", result.registration_m},
               {"warnings", result.warnings}});
}

SurveyResult result_from_json(const std::string& text) {
  return parse(text, [](const Json& json) {
    SurveyResult result;
    result.definition = definition_of(json.at("definition"));
    result.parameters = parameters_from_json(json.at("parameters").get<std::string>());
    result.program_version = json.at("program_version").get<std::string>();
    for (const Json& scan : json.at("before")) result.before.push_back(surveyed_of(scan));
    for (const Json& scan : json.at("after")) result.after.push_back(surveyed_of(scan));
    for (const Json& zone : json.at("zones")) result.zones.push_back(figures_of(zone));
    result.total = figures_of(json.at("total"));
    result.testable_before = json.at("testable").at(0).get<double>();
    result.testable_after = json.at("testable").at(1).get<double>();
    result.registration_m = json.at("registration_m").get<double>();
    result.warnings = json.at("warnings").get<std::vector<std::string>>();
    return result;
  });
}

std::string changes_json(const std::vector<SurveyChange>& changes) { return dump(list_of(changes)); }
std::vector<SurveyChange> changes_from_json(const std::string& text) {
  return parse(text, [](const Json& json) {
    std::vector<SurveyChange> changes;
    for (const Json& change : json) changes.push_back(change_of(change));
    return changes;
  });
}

}  // namespace raywatch
