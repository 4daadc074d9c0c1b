#pragma once

#include "core/survey.hpp"

namespace raywatch {

/// A survey with something in every field; `number` decides its figures.
inline SurveyResult sample_survey(int number, std::optional<ZoneId> zone = {}) {
  SurveyResult survey;
  survey.definition.zones = {ZoneId{3}};
  survey.definition.density_t_per_m3 = 2.5;
  survey.definition.greatest_slope_deg = 70.0;
  survey.definition.reference = {.policy = ReferencePolicy::days_ago, .epoch = {}, .days = 7};
  survey.definition.thresholds = {{.figure = SurveyFigure::cut_m3, .zone = zone, .thresholds = {.yellow = 1.5}}};
  survey.program_version = "1.2.3";
  survey.before = survey.after = {{.scan = {4},
                                   .station = {5},
                                   .sensor = {6},
                                   .captured_at = Time(Duration(7)),
                                   .points = 8,
                                   .sha256 = "abc",
                                   .world_from_sensor = {Eigen::Quaterniond(0.6, 0.0, 0.8, 0.0), {1.0, 2.0, 3.0}},
                                   .registration = RegistrationState::good,
                                   .residual_m = 0.01,
                                   .uncertainty = {0.002, 1e-5}}};
  ZoneFigures figures;
  figures.zone = {.zone = zone, .name = "bench", .prism = {{{0.0, 0.0}, {4.0, 0.0}, {0.0, 2.0}}, -1.0, 9.0}};
  figures.volumes.net = {.value_m3 = 10.0 * number, .random_sigma_m3 = 3.0, .pose_sigma_m3 = 4.0};
  figures.volumes.area_m2 = 8.0;
  figures.volumes.seen_area_m2 = 6.0;
  figures.volumes.unseen = {-std::numeric_limits<double>::infinity(), 5.0};
  figures.m3c2 = {.core_points = 9, .measured = 8, .significant = 7, .greatest_rise_m = 0.5};
  figures.masses = ZoneMasses{{1.0, 0.5, 1.5}, {2.0, 1.5, 2.5}, {3.0, 2.5, 3.5}};
  survey.zones = {figures};
  survey.total = figures;
  survey.total.zone = {.name = "total"};
  SurveyChange change;
  change.change = {.kind = ChangeKind::removed, .centroid_m = {1.0, 1.0, 1.0}, .volume_m3 = 2.0, .points = 50};
  change.change.bounds_m = {Eigen::Vector3d(0.0, 0.0, 0.0), Eigen::Vector3d(2.0, 2.0, 2.0)};
  change.volume = {.net = {.value_m3 = -1.5}, .area_m2 = 4.0, .seen_area_m2 = 3.0};
  change.mass = MassFigure{-3.75, -4.0, -3.5};
  change.zones = {0};
  survey.changes = {change, change, change};
  survey.warnings = {"something"};
  const GridLayout layout{.origin_m = {0.0, -2.0}, .cell_m = 2.0, .columns = 2, .rows = 1};
  survey.before_model = {.layout = layout, .cells = std::vector<ElevationCell>(2), .stations = {}};
  survey.before_model.cells[0] = {
      .height_m = 1.5, .sigma_m = 0.25, .slope = {0.5, -0.5}, .count = 12, .ceiling_m = 2.0};
  survey.after_model = survey.before_model;
  survey.after_model.cells[0].height_m = 1.5 + number;
  survey.difference = difference_of(survey.before_model, survey.after_model);
  survey.before_points = {{{PointClass::unchanged, PointClass::removed}, {-1, 0}}};
  survey.after_points = {{{PointClass::added}, {2}}};
  return survey;
}

}  // namespace raywatch
