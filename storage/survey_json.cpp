#include "storage/survey_json.hpp"

#include "storage/survey_definition_json.hpp"

namespace raywatch {
namespace {

using namespace json_values;
using json_values::json_of;  // beside those below

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
