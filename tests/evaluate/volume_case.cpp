#include "tests/evaluate/volume_case.hpp"

#include <memory>

#include "tests/simulator/pit.hpp"
#include "tests/simulator/random.hpp"
#include "tests/simulator/simulated_scan.hpp"

namespace raywatch::evaluation {
namespace {

using simulator::HeightField;
using simulator::radians;
using simulator::RandomSequence;

constexpr double kStation_m = 24.0;  ///< height above the pit's floor
const Eigen::AlignedBox2d kArea_m(Eigen::Vector2d(-26.0, -80.0), Eigen::Vector2d(30.0, 80.0));
constexpr double kHalfView_rad = radians(75.0), kLowest_rad = radians(-42.0), kHighest_rad = radians(3.0);
constexpr double kLowest_m = -1.0, kHighest_m = 40.0;  // of the zone

Prism zone() {
  const Eigen::Vector2d a = kArea_m.min(), b = kArea_m.max();
  return {{a, {b.x(), a.y()}, b, {a.x(), b.y()}}, kLowest_m, kHighest_m};
}

simulator::Scanner scanner_of(const VolumeSurvey& survey) {
  simulator::Scanner scanner;
  for (std::uint32_t i = 0; i < survey.azimuth_steps; ++i) {
    scanner.azimuths_rad.push_back(kHalfView_rad * (2.0 * i / survey.azimuth_steps - 1.0));
  }
  for (std::uint32_t i = 0; i < survey.elevation_steps; ++i) {
    scanner.elevations_rad.push_back(kLowest_rad + (kHighest_rad - kLowest_rad) * i / survey.elevation_steps);
  }
  scanner.max_range_m = 600.0;
  scanner.errors.range_noise_m = survey.range_noise_m;
  return scanner;
}

std::vector<Pose> stations(RandomSequence& random) {
  std::vector<Pose> poses;
  for (const double y_m : {-45.0, 45.0}) {
    poses.push_back({.position_m = {random.in({-75.0, -60.0}), y_m + random.in({-15.0, 15.0}), kStation_m}});
  }
  return poses;
}

/// One night's scans, which the views of an epoch refer to.
class Night {
 public:
  Night(const HeightField& ground, std::span<const Pose> poses, const VolumeSurvey& survey, RandomSequence& random) {
    simulator::Scene scene;
    scene.add(simulator::Terrain{std::shared_ptr<const HeightField>(std::shared_ptr<void>(), &ground), nullptr});
    const simulator::RayCaster world(scene);
    const simulator::Scanner scanner = scanner_of(survey);
    for (const Pose& pose : poses) {
      simulator::ScanPlan plan = simulator::exact_plan(pose, random.seed());
      plan.reported_world_from_sensor = simulator::disturbed(pose, survey.registration, random.seed());
      scans_.push_back(simulator::take_scan(world, scanner, plan));
    }
    for (const simulator::SimulatedScan& scan : scans_) indexes_.push_back(PriorIndex::build(scan.points, {}));
  }

  ElevationModel model(const VolumeSurvey& survey) const {
    EpochScans epoch;
    for (std::uint32_t k = 0; k < scans_.size(); ++k) {
      epoch.add(
          {.points = scans_[k].points,
           .index = indexes_[k],
           .world_from_sensor = scans_[k].reported_world_from_sensor,
           .captured_at = {},
           .sensor = {.range_noise_m = survey.range_noise_m,
                      .angular_resolution_rad = Eigen::Vector2d(2.0 * kHalfView_rad / survey.azimuth_steps,
                                                                (kHighest_rad - kLowest_rad) / survey.elevation_steps)},
           .pose_uncertainty = {survey.registration.position_sigma_m, survey.registration.angle_sigma_rad}},
          k);
    }
    return make_elevation_model(epoch, layout_over(kArea_m, survey.cell_m), {});
  }

 private:
  std::vector<simulator::SimulatedScan> scans_;
  std::vector<PriorIndex> indexes_;
};

/// Adds what is true of a cell, which counts for cut or for fill as a whole.
void add_truth(const HeightField& before, const HeightField& after, const Eigen::AlignedBox2d& cell_m, bool seen,
               VolumeCase& result) {
  const double rise_m3 = cell_m.volume() * (mean_height_m(after, cell_m) - mean_height_m(before, cell_m));
  result.whole_net_m3 += rise_m3;
  if (!seen) return;
  result.net_m3 += rise_m3;
  (rise_m3 > 0.0 ? result.fill_m3 : result.cut_m3) += std::abs(rise_m3);
}

}  // namespace

VolumeCase make_volume_case(std::uint64_t seed, const VolumeSurvey& survey) {
  RandomSequence random(seed);
  const simulator::Pit pit(random.seed());
  const auto night = static_cast<std::uint32_t>(random.below(5));
  const HeightField before = pit.ground(night), after = pit.ground(night + 1);
  const std::vector<Pose> poses = stations(random);
  const ElevationModel earlier = Night(before, poses, survey, random).model(survey);
  const ElevationModel later = Night(after, poses, survey, random).model(survey);
  VolumeCase result;
  result.volumes = volumes_between(earlier, later, zone(), survey.steepness);
  const Eigen::Vector2d half_m = Eigen::Vector2d::Constant(0.5 * survey.cell_m);
  for (std::size_t cell = 0; cell < earlier.cells.size(); ++cell) {
    const Eigen::Vector2d center_m = earlier.layout.center_m(cell);
    const bool seen = earlier.cells[cell].seen() && later.cells[cell].seen();
    add_truth(before, after, {center_m - half_m, center_m + half_m}, seen, result);
  }
  return result;
}

}  // namespace raywatch::evaluation
