#include "core/survey.hpp"

#include <doctest/doctest.h>
#include <oneapi/tbb/task_arena.h>

#include "core/error.hpp"
#include "core/profile.hpp"
#include "tests/simulator/pit.hpp"
#include "tests/simulator/simulated_scan.hpp"

namespace raywatch {
namespace {

using namespace std::chrono_literals;
using simulator::HeightField;
using simulator::radians;

constexpr double kStation_m = 24.0;  ///< height above the pit's floor
const Eigen::AlignedBox2d kArea_m(Eigen::Vector2d(-26.0, -80.0), Eigen::Vector2d(30.0, 80.0));

Prism prism_over(const Eigen::AlignedBox2d& area_m) {
  const Eigen::Vector2d low_m = area_m.min(), high_m = area_m.max();
  return {{low_m, {high_m.x(), low_m.y()}, high_m, {low_m.x(), high_m.y()}}, -1.0, 40.0};
}

simulator::Scanner coarse_scanner() {
  simulator::Scanner scanner;
  for (int i = 0; i < 240; ++i) scanner.azimuths_rad.push_back(radians(-75.0 + 150.0 * i / 240));
  for (int i = 0; i < 200; ++i) scanner.elevations_rad.push_back(radians(-42.0 + 45.0 * i / 200));
  scanner.max_range_m = 600.0;
  scanner.errors.range_noise_m = 0.01;
  return scanner;
}

/// A night of the pit, scanned from two stations.
class Night {
 public:
  Night(std::uint32_t night, Time captured_at)
      : ground(std::make_shared<HeightField>(simulator::Pit(3).ground(night))) {
    simulator::Scene scene;
    scene.add(simulator::Terrain{ground, nullptr});
    const simulator::RayCaster world(scene);
    for (const double y_m : {-45.13, 45.27}) {
      simulator::ScanPlan plan = simulator::exact_plan({.position_m = {-67.31, y_m, kStation_m}}, scans_.size() + 1);
      plan.captured_at = captured_at + 10min * static_cast<int>(scans_.size());
      scans_.push_back(simulator::take_scan(world, coarse_scanner(), plan));
    }
    for (const simulator::SimulatedScan& scan : scans_) indexes_.push_back(PriorIndex::build(scan.points, {}));
    for (std::uint32_t k = 0; k < scans_.size(); ++k) {
      scans.add({.points = scans_[k].points,
                 .index = indexes_[k],
                 .world_from_sensor = scans_[k].true_world_from_sensor,
                 .captured_at = scans_[k].captured_at,
                 .sensor = estimate_sensor(scans_[k].points, indexes_[k]),
                 .pose_uncertainty = {.position_m = 0.002, .angle_rad = 1e-5}},
                k);
    }
  }
  Night(const Night&) = delete;

  SurveyEpoch epoch() const {
    SurveyEpoch epoch{scans, {}};
    for (std::uint32_t k = 0; k < scans.scans.size(); ++k) {
      epoch.about.push_back({.scan = {k + 1},
                             .station = {k + 1},
                             .sensor = {1},
                             .captured_at = scans.scans[k].captured_at,
                             .points = scans.scans[k].points.size(),
                             .sha256 = "",
                             .world_from_sensor = scans.scans[k].world_from_sensor,
                             .uncertainty = scans.scans[k].pose_uncertainty});
    }
    return epoch;
  }

  const std::shared_ptr<const HeightField> ground;

 private:
  std::vector<simulator::SimulatedScan> scans_;
  std::vector<PriorIndex> indexes_;

 public:
  EpochScans scans;
};

const Night& first_night() {
  static const Night night(1, Time{} + 24h);
  return night;
}
const Night& second_night() {
  static const Night night(2, Time{} + 48h);
  return night;
}

SurveyInput input_of(std::vector<SurveyZone> zones) {
  return {.before = first_night().epoch(),
          .after = second_night().epoch(),
          .zones = std::move(zones),
          .definition = {.cell_m = 2.0, .core_spacing_m = 4.0, .density_t_per_m3 = 2.5},
          .parameters = default_parameters(Profile::survey, Grouping::consensus),
          .program_version = "1.2.3"};
}

SurveyZone zone_over(const Eigen::AlignedBox2d& area_m, std::int64_t id) {
  return {.zone = ZoneId{id}, .name = "bench", .prism = prism_over(area_m)};
}

/// What is true of the cells that were seen in both epochs, or of those that were not.
double true_net_m3(const SurveyResult& survey, bool seen = true) {
  const Eigen::Vector2d half_m = Eigen::Vector2d::Constant(0.5 * survey.before_model.layout.cell_m);
  double net_m3 = 0.0;
  for (std::size_t cell = 0; cell < survey.difference.size(); ++cell) {
    if (survey.difference[cell].seen() != seen) continue;
    const Eigen::Vector2d center_m = survey.before_model.layout.center_m(cell);
    const Eigen::AlignedBox2d cell_m(center_m - half_m, center_m + half_m);
    net_m3 += cell_m.volume() *
              (mean_height_m(*second_night().ground, cell_m) - mean_height_m(*first_night().ground, cell_m));
  }
  return net_m3;
}

const SurveyResult& survey_of_bench() {
  static const SurveyResult result = survey_between(input_of({zone_over(kArea_m, 7)}));
  return result;
}

TEST_CASE("what is stated of the steepness of the ground narrows the bounds of what was not seen, around the truth") {
  SurveyInput input = input_of({zone_over(kArea_m, 7)});
  input.definition.greatest_slope_deg = 60.0;
  const VolumeBounds stated = survey_between(input).zones.front().volumes.unseen;
  const VolumeBounds nothing_stated = survey_of_bench().zones.front().volumes.unseen;
  CHECK(stated.low_m3 >= nothing_stated.low_m3);
  CHECK(stated.high_m3 <= nothing_stated.high_m3);
  CHECK(stated.high_m3 - stated.low_m3 < 0.7 * (nothing_stated.high_m3 - nothing_stated.low_m3));
  const double truth_m3 = true_net_m3(survey_of_bench(), false);
  CHECK(stated.low_m3 <= truth_m3);
  CHECK(stated.high_m3 >= truth_m3);
}

TEST_CASE("a survey of two nights of a pit holds the true volume in its interval, and has its changes") {
  const SurveyResult& survey = survey_of_bench();
  REQUIRE(survey.zones.size() == 1);
  const ZoneFigures& bench = survey.zones.front();
  const double truth_m3 = true_net_m3(survey);
  CHECK(bench.volumes.net.low_m3() <= truth_m3);
  CHECK(bench.volumes.net.high_m3() >= truth_m3);
  CHECK(bench.volumes.cut.value_m3 > 100.0);
  CHECK(bench.volumes.fill.value_m3 > 100.0);
  CHECK(bench.masses->net.value_t == doctest::Approx(2.5 * bench.volumes.net.value_m3));
  CHECK(std::ranges::any_of(survey.changes, [](const SurveyChange& change) {
    return change.change.kind == ChangeKind::added && change.volume.net.value_m3 > 100.0 &&
           change.zones == std::vector<std::size_t>{0};
  }));
  CHECK(survey.program_version == "1.2.3");
  CHECK(survey.before.size() == 2);
  CHECK(survey.after_points.size() == 2);
  CHECK(survey.warnings.empty());
}

TEST_CASE("along the normal a blast rises and falls by metres, above a level of detection of centimetres") {
  const M3c2Figures& found = survey_of_bench().zones.front().m3c2;
  CHECK(found.measured > 50);
  CHECK(found.measured <= found.core_points);
  CHECK(found.greatest_rise_m > 1.0);
  CHECK(found.greatest_fall_m <= 0.0);
  CHECK(found.mean_lod95_m < 0.5);
  CHECK(std::abs(found.greatest_m()) >= std::abs(found.mean_m));
}

TEST_CASE("the total of two halves is the whole, with an interval that is no narrower") {
  Eigen::AlignedBox2d left = kArea_m, right = kArea_m;
  left.max().y() = right.min().y() = 0.0;
  const SurveyResult halves = survey_between(input_of({zone_over(left, 1), zone_over(right, 2)}));
  const ZoneFigures& whole = survey_of_bench().zones.front();
  const ZoneFigures& total = halves.total;
  CHECK(total.volumes.net.value_m3 == doctest::Approx(whole.volumes.net.value_m3));
  CHECK(total.volumes.area_m2 == doctest::Approx(whole.volumes.area_m2));
  CHECK(total.volumes.vertical.mean_m == doctest::Approx(whole.volumes.vertical.mean_m));
  CHECK(total.volumes.net.random_sigma_m3 == doctest::Approx(whole.volumes.net.random_sigma_m3));
  CHECK(total.volumes.net.pose_sigma_m3 >= whole.volumes.net.pose_sigma_m3 * (1.0 - 1e-9));
  CHECK(total.m3c2.core_points == whole.m3c2.core_points);
}

TEST_CASE("a survey without a zone is that of the whole site, and says so") {
  const SurveyResult survey = survey_between(input_of({}));
  REQUIRE(survey.zones.size() == 1);
  CHECK_FALSE(survey.zones.front().zone.zone);
  CHECK(survey.zones.front().volumes.area_m2 > 100.0 * 100.0);
  CHECK(survey.warnings.size() == 1);
}

TEST_CASE("a survey is the same with one thread and with eight") {
  SurveyResult results[2];
  for (const int threads : {1, 8}) {
    tbb::task_arena arena(threads);
    arena.execute([&] { results[threads == 8] = survey_between(input_of({zone_over(kArea_m, 7)})); });
  }
  CHECK(results[0].total.volumes.net.value_m3 == results[1].total.volumes.net.value_m3);
  CHECK(results[0].total.volumes.net.sigma_m3() == results[1].total.volumes.net.sigma_m3());
  CHECK(results[0].total.m3c2.mean_m == results[1].total.m3c2.mean_m);
  CHECK(results[0].changes.size() == results[1].changes.size());
  for (std::size_t k = 0; k < 2; ++k) CHECK(results[0].after_points[k].classes == results[1].after_points[k].classes);
}

TEST_CASE("a figure that was not measured has no value, and one without an interval has none") {
  ZoneFigures figures;
  figures.volumes.area_m2 = 100.0;
  CHECK_FALSE(value_of(figures, SurveyFigure::net_m3));
  CHECK(value_of(figures, SurveyFigure::seen_share)->value == 0.0);
  figures.volumes.seen_area_m2 = 50.0;
  figures.volumes.net = {.value_m3 = 10.0, .random_sigma_m3 = 3.0, .pose_sigma_m3 = 4.0};
  const FigureValue net = value_of(figures, SurveyFigure::net_m3).value();
  CHECK(net.value == 10.0);
  CHECK(*net.low == doctest::Approx(10.0 - 1.96 * 5.0));
  CHECK(*net.high == doctest::Approx(10.0 + 1.96 * 5.0));
  CHECK_FALSE(value_of(figures, SurveyFigure::greatest_rise_m)->low);
  CHECK(value_of(figures, SurveyFigure::seen_share)->value == 0.5);
}

TEST_CASE("a definition that is out of range says every field") {
  SurveyDefinition definition{.cell_m = 0.0,
                              .reference = {.policy = ReferencePolicy::days_ago},
                              .density_t_per_m3 = -1.0,
                              .greatest_slope_deg = 90.0};
  definition.thresholds.push_back({.thresholds = {.yellow = 2.0, .orange = 1.0}});
  try {
    check_definition(definition);
    FAIL("nothing was thrown");
  } catch (const InvalidInput& error) {
    std::vector<std::string> fields;
    for (const FieldError& wrong : error.fields()) fields.push_back(wrong.field);
    CHECK(fields == std::vector<std::string>{"cell_m", "density_t_per_m3", "greatest_slope_deg", "reference.days",
                                             "thresholds.0.orange"});
  }
  check_definition({});
}

TEST_CASE("figures have units") {
  CHECK(unit_of(SurveyFigure::net_m3) == "m3");
  CHECK(unit_of(SurveyFigure::changed_area_m2) == "m2");
  CHECK(unit_of(SurveyFigure::m3c2_mean_m) == "m");
  CHECK(unit_of(SurveyFigure::seen_share).empty());
  CHECK(parse_survey_figure("net_m3") == SurveyFigure::net_m3);
}

}  // namespace
}  // namespace raywatch
