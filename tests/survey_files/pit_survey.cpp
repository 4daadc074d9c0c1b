#include "tests/survey_files/pit_survey.hpp"

#include "core/profile.hpp"
#include "tests/simulator/pit.hpp"
#include "tests/simulator/registration.hpp"

namespace raywatch {
namespace {

using namespace simulator;

const Time kBefore = parse_rfc3339("2026-03-27T23:30:00Z"), kAfter = parse_rfc3339("2026-03-28T22:30:00Z");

SurveyZone zone(int id, const char* name, double y_from, double y_to) {
  return {ZoneId{id}, name, {{{-30.0, y_from}, {24.0, y_from}, {24.0, y_to}, {-30.0, y_to}}, -1.0, 30.0}};
}

}  // namespace

PitSurvey::PitSurvey(std::uint32_t azimuth_steps) {
  const Pit pit(11);
  Scanner scanner;
  const double step_rad = radians(150.0) / azimuth_steps;
  for (std::uint32_t i = 0; i < azimuth_steps; ++i) scanner.azimuths_rad.push_back(radians(-75.0) + i * step_rad);
  for (double e = radians(-42.0); e < radians(3.0); e += 0.4 * step_rad) scanner.elevations_rad.push_back(e);
  scanner.max_range_m = 600.0;
  scanner.errors.range_noise_m = 0.02;
  std::vector<SurveyedScan> about[2];
  for (std::uint32_t night = 0; night < 2; ++night) {
    Scene scene;
    scene.add(Terrain{std::make_shared<const HeightField>(pit.ground(1 + night)), nullptr});
    const RayCaster world(scene);
    for (std::uint32_t station = 0; station < 2; ++station) {
      const Pose pose{.position_m = {-66.0, station == 0 ? -45.0 : 40.0, 24.0}};
      ScanPlan plan = exact_plan(pose, 10 * night + station);
      plan.reported_world_from_sensor = disturbed(pose, {0.01, 3e-5}, 50 + 10 * night + station);
      SimulatedScan scan = take_scan(world, scanner, plan);
      PriorIndex index = PriorIndex::build(scan.points, {});
      taken_.push_back(std::make_unique<Taken>(Taken{std::move(scan), std::move(index)}));
      const Taken& taken = *taken_.back();
      const Time at = (night == 0 ? kBefore : kAfter) + std::chrono::minutes(12) * station;
      const ScanView view{taken.scan.points,
                          taken.index,
                          plan.reported_world_from_sensor,
                          at,
                          {.range_noise_m = 0.02, .angular_resolution_rad = Eigen::Vector2d(step_rad, 0.4 * step_rad)},
                          {0.01, 3e-5}};
      (night == 0 ? before_ : after_).add(view, station);
      about[night].push_back({.scan = {10 * night + station + 1},
                              .station = {station + 1},
                              .sensor = {1},
                              .captured_at = at,
                              .points = taken.scan.points.size(),
                              .sha256 = std::string(64, "0123456789abcdef"[3 * night + station]),
                              .world_from_sensor = plan.reported_world_from_sensor,
                              .registration = RegistrationState::good,
                              .residual_m = 0.0081 + 0.001 * station,
                              .uncertainty = {0.01, 3e-5}});
    }
  }
  SurveyInput input{{before_, about[0]},
                    {after_, about[1]},
                    {},
                    {},
                    default_parameters(Profile::survey, Grouping::consensus),
                    "0.1.0"};
  input.zones = {zone(1, "bench <south>", -80.0, -10.0), zone(2, "bench, north", -10.0, 80.0)};
  input.definition.cell_m = 2.0;
  input.definition.core_spacing_m = 4.0;
  input.definition.density_t_per_m3 = 2.4;
  result = survey_between(input);
  result.warnings.push_back("Station 2 saw 12 % less of the zones than on the night before.");
}

SurveyDocument PitSurvey::document(const OutputFrame& frame) const {
  SurveyDocument document{.survey = result,
                          .id = {12},
                          .site = "Pit & quarry",
                          .time_zone = "Europe/Berlin",
                          .before_at = kBefore,
                          .after_at = kAfter,
                          .made_at = kAfter + std::chrono::hours(1),
                          .frame = frame};
  if (frame.epsg) document.crs_name = "ETRS89 / UTM zone 33N";
  for (const SurveyFigure figure : {SurveyFigure::cut_m3, SurveyFigure::net_m3, SurveyFigure::greatest_fall_m}) {
    FigureSeries series{.zone = "total", .figure = figure, .points = {}};
    for (int day = 6; day >= 0; --day) {
      FigureValue value = value_of(result.total, figure).value_or(FigureValue{});
      value.value *= 1.0 - 0.11 * day;
      if (value.low) *value.low *= 1.0 - 0.11 * day;
      if (value.high) *value.high *= 1.0 - 0.1 * day;
      series.points.push_back({kAfter - std::chrono::days(day), value});
    }
    document.series.push_back(series);
  }
  return document;
}

}  // namespace raywatch
