#include "storage/survey_definition_json.hpp"

namespace raywatch::json_values {
namespace {

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

}  // namespace

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

}  // namespace raywatch::json_values
