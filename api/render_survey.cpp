#include "api/render_survey.hpp"

#include <cmath>

#include "api/lookup.hpp"
#include "api/render.hpp"
#include "api/units.hpp"

namespace raywatch {
namespace {

template <class SomeId>
Json ids(const std::vector<SomeId>& all) {
  Json list = Json::array();
  for (const SomeId id : all) list.push_back(id.value);
  return list;
}

/// Infinity is what is not bounded: null.
Json finite_or_null(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json sensor_names(const Snapshot& snapshot, const std::vector<SensorId>& sensors) {
  Json names = Json::array();
  for (const SensorId id : sensors) {
    const std::optional<Sensor> sensor = find_sensor(snapshot, id);
    if (sensor) names.push_back(sensor->name);
  }
  return names;
}

Json render_volume(const VolumeFigure& volume) {
  return {{"value_m3", volume.value_m3},
          {"low_m3", volume.low_m3()},
          {"high_m3", volume.high_m3()},
          {"random_sigma_m3", volume.random_sigma_m3},
          {"pose_sigma_m3", volume.pose_sigma_m3}};
}

Json render_bounds(const VolumeBounds& bounds) {
  return {{"low_m3", finite_or_null(bounds.low_m3)}, {"high_m3", finite_or_null(bounds.high_m3)}};
}

Json render_extent(const ChangeExtent& extent) {
  return {{"greatest_rise_m", extent.greatest_rise_m},
          {"greatest_fall_m", extent.greatest_fall_m},
          {"mean_m", extent.mean_m}};
}

Json render_mass(const MassFigure& mass) {
  return {{"value_t", mass.value_t}, {"low_t", mass.low_t}, {"high_t", mass.high_t}};
}

Json render_m3c2(const M3c2Figures& m3c2) {
  return {{"core_points", m3c2.core_points},         {"measured", m3c2.measured},
          {"significant", m3c2.significant},         {"greatest_rise_m", m3c2.greatest_rise_m},
          {"greatest_fall_m", m3c2.greatest_fall_m}, {"mean_m", m3c2.mean_m},
          {"mean_lod95_m", m3c2.mean_lod95_m}};
}

Json render_reference(const SurveyReference& reference) {
  return {{"policy", to_string(reference.policy)},
          {"epoch", id_or_null(reference.epoch)},
          {"days", reference.days > 0 ? Json(reference.days) : Json(nullptr)}};
}

Json render_tolerance(const RegistrationTolerance& tolerance) {
  return {{"residual_m", tolerance.residual_m},
          {"position_m", tolerance.uncertainty.position_m},
          {"angle_deg", deg_of_radians(tolerance.uncertainty.angle_rad)}};
}

Json render_thresholds(const FigureThresholds& given) {
  const LevelThresholds& t = given.thresholds;
  return {{"figure", to_string(given.figure)}, {"zone", id_or_null(given.zone)}, {"yellow", json_or_null(t.yellow)},
          {"orange", json_or_null(t.orange)},  {"red", json_or_null(t.red)},     {"clear_share", t.clear_share},
          {"raise_after", t.raise_after},      {"clear_after", t.clear_after}};
}

Json render_scan(const SurveyedScan& scan, const Eigen::Vector3d& origin_m) {
  Pose pose = scan.world_from_sensor;
  pose.position_m += origin_m;
  return {{"scan", scan.scan.value},
          {"vantage", scan.station.value},
          {"captured_at", format_rfc3339(scan.captured_at)},
          {"points", scan.points},
          {"sha256", scan.sha256},
          {"pose", render(pose)},
          {"registration",
           {{"state", to_string(scan.registration)},
            {"residual_m", json_or_null(scan.residual_m)},
            {"position_sigma_m", scan.uncertainty.position_m},
            {"angle_sigma_deg", deg_of_radians(scan.uncertainty.angle_rad)}}}};
}

Json render_scans(const std::vector<SurveyedScan>& scans, const Eigen::Vector3d& origin_m) {
  Json list = Json::array();
  for (const SurveyedScan& scan : scans) list.push_back(render_scan(scan, origin_m));
  return list;
}

}  // namespace

Json render(const SurveyDefinition& definition) {
  Json thresholds = Json::array();
  for (const FigureThresholds& given : definition.thresholds) thresholds.push_back(render_thresholds(given));
  return {{"zones", ids(definition.zones)},
          {"cell_m", definition.cell_m},
          {"core_spacing_m", definition.core_spacing_m},
          {"density_t_per_m3", json_or_null(definition.density_t_per_m3)},
          {"greatest_slope_deg", json_or_null(definition.greatest_slope_deg)},
          {"reference", render_reference(definition.reference)},
          {"tolerance", render_tolerance(definition.tolerance)},
          {"thresholds", std::move(thresholds)}};
}

Json render(const Snapshot& snapshot, const ScheduleRecord& schedule, const std::optional<Time>& next_run_at) {
  const SchedulePlan& plan = schedule.plan;
  return {{"id", schedule.id.value},
          {"site", site_with(snapshot, schedule.site).name},
          {"name", schedule.name},
          {"enabled", schedule.enabled},
          {"cron", plan.cron},
          {"time_zone", plan.time_zone},
          {"window_s", seconds_of(plan.window)},
          {"grace_s", seconds_of(plan.grace)},
          {"sensors", sensor_names(snapshot, plan.sensors)},
          {"required_sensors", sensor_names(snapshot, plan.required_sensors)},
          {"required_vantages", ids(plan.required_vantages)},
          {"catch_up", to_string(plan.catch_up)},
          {"survey", render(plan.definition)},
          {"next_run_at", render(next_run_at)},
          {"created_at", format_rfc3339(schedule.created_at)},
          {"edited_at", format_rfc3339(schedule.edited_at)}};
}

Json render(const Snapshot& snapshot, const RunRecord& run) {
  Json log = Json::array();
  for (const RunLogLine& line : run.log) log.push_back({{"at", format_rfc3339(line.at)}, {"text", line.text}});
  return {{"id", run.id.value},
          {"site", site_with(snapshot, run.site).name},
          {"schedule", id_or_null(run.schedule)},
          {"due_at", format_rfc3339(run.due_at)},
          {"from", format_rfc3339(run.from)},
          {"to", format_rfc3339(run.to)},
          {"state", to_string(run.state)},
          {"why", run.why},
          {"attempts", run.attempts},
          {"epoch", id_or_null(run.epoch)},
          {"reference", id_or_null(run.reference)},
          {"survey", id_or_null(run.survey)},
          {"created_at", format_rfc3339(run.created_at)},
          {"started_at", render(run.started_at)},
          {"finished_at", render(run.finished_at)},
          {"log", std::move(log)}};
}

Json render(const Snapshot& snapshot, const EpochRecord& epoch) {
  Json accepted = nullptr;
  if (epoch.accepted) {
    accepted = {{"by", epoch.accepted->by}, {"note", epoch.accepted->note}, {"at", format_rfc3339(epoch.accepted->at)}};
  }
  return {{"id", epoch.id.value},
          {"site", site_with(snapshot, epoch.site).name},
          {"schedule", id_or_null(epoch.schedule)},
          {"name", epoch.name},
          {"from", format_rfc3339(epoch.from)},
          {"to", format_rfc3339(epoch.to)},
          {"scans", ids(epoch.scans)},
          {"state", to_string(epoch.state)},
          {"why", epoch.why},
          {"accepted", std::move(accepted)},
          {"created_at", format_rfc3339(epoch.created_at)}};
}

Json render(const ListedSurvey& listed) {
  const SurveyRecord& survey = listed.record;
  return {{"id", survey.id.value},
          {"site", listed.site},
          {"schedule", id_or_null(survey.schedule)},
          {"run", survey.run.value},
          {"before", {{"epoch", survey.before.value}, {"captured_at", format_rfc3339(survey.before_at)}}},
          {"after", {{"epoch", survey.after.value}, {"captured_at", format_rfc3339(survey.after_at)}}},
          {"made_at", format_rfc3339(survey.made_at)},
          {"total", render(listed.result.total)},
          {"warnings", listed.result.warnings}};
}

Json render_ground(const Snapshot& snapshot, const SurveyRecord& survey, const SurveyResult& result) {
  const Eigen::Vector3d origin_m = origin_of(site_with(snapshot, survey.site));
  return {
      {"program_version", result.program_version},
      {"survey", render(result.definition)},
      {"registration_m", result.registration_m},
      {"testable", {{"before", result.testable_before}, {"after", result.testable_after}}},
      {"scans", {{"before", render_scans(result.before, origin_m)}, {"after", render_scans(result.after, origin_m)}}}};
}

Json render(const ZoneFigures& figures) {
  const ZoneVolumes& volumes = figures.volumes;
  Json masses = nullptr;
  if (figures.masses) {
    masses = {{"cut", render_mass(figures.masses->cut)},
              {"fill", render_mass(figures.masses->fill)},
              {"net", render_mass(figures.masses->net)}};
  }
  return {{"zone", id_or_null(figures.zone.zone)},
          {"name", figures.zone.name},
          {"area_m2", volumes.area_m2},
          {"seen_area_m2", volumes.seen_area_m2},
          {"seen_share", volumes.seen_share()},
          {"changed_area_m2", volumes.changed_area_m2},
          {"cut", render_volume(volumes.cut)},
          {"fill", render_volume(volumes.fill)},
          {"net", render_volume(volumes.net)},
          {"changed_net", render_volume(volumes.changed_net)},
          {"unseen", render_bounds(volumes.unseen)},
          {"whole", render_bounds(volumes.whole())},
          {"vertical", render_extent(volumes.vertical)},
          {"normal", render_extent(volumes.normal)},
          {"m3c2", render_m3c2(figures.m3c2)},
          {"masses", std::move(masses)}};
}

Json render(const SurveyChange& change, const SurveyResult& survey, const Eigen::Vector3d& origin_m) {
  Json json = render_figures(change.change, origin_m);
  Json zones = Json::array();
  for (const std::size_t place : change.zones) zones.push_back(id_or_null(survey.zones.at(place).zone.zone));
  json["net"] = render_volume(change.volume.net);
  json["area_m2"] = change.volume.area_m2;
  json["seen_area_m2"] = change.volume.seen_area_m2;
  json["mass"] = change.mass ? render_mass(*change.mass) : Json(nullptr);
  json["zones"] = std::move(zones);
  return json;
}

ScheduleRecord schedule_with(const Snapshot& snapshot, ScheduleId id) {
  return required(find_schedule(snapshot, id), "schedule " + std::to_string(id.value));
}
RunRecord run_with(const Snapshot& snapshot, RunId id) {
  return required(find_run(snapshot, id), "run " + std::to_string(id.value));
}
EpochRecord epoch_with(const Snapshot& snapshot, EpochId id) {
  return required(find_epoch(snapshot, id), "epoch " + std::to_string(id.value));
}
SurveyRecord survey_with(const Snapshot& snapshot, SurveyId id) {
  return required(find_survey(snapshot, id), "survey " + std::to_string(id.value));
}

}  // namespace raywatch
