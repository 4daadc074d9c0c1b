#include "tests/bench/bench_scenes.hpp"

#include <array>
#include <map>

#include "tests/simulator/family.hpp"

namespace raywatch::bench {
namespace {

using namespace raywatch::simulator;

BenchScan indexed(SimulatedScan scan, const Scanner& scanner) {
  PriorIndex index = PriorIndex::build(scan.points, {});
  const double azimuth_rad = 2.0 * std::numbers::pi / static_cast<double>(scanner.azimuths_rad.size());
  const double elevation_rad = (scanner.elevations_rad.back() - scanner.elevations_rad.front()) /
                               static_cast<double>(scanner.elevations_rad.size() - 1);
  SensorModel sensor;
  sensor.angular_resolution_rad = Eigen::Vector2d(azimuth_rad, std::abs(elevation_rad));
  sensor.range_noise_m = scanner.errors.range_noise_m;
  return {std::move(scan.points), std::move(index), scan.reported_world_from_sensor, scan.captured_at, sensor};
}

struct Recipe {
  const char* name;
  Family family;
  double density;               ///< of the family's own scanner, unless `panorama` replaces it
  bool panorama;                ///< 1600 x 320 shots
  double angle_per_resolution;  ///< 0: T_a = 1 degree
};

/// The last scan of the story, the latest before it from the same pose, and the latest from another.
BenchScene make(const Recipe& recipe) {
  Timeline timeline = make_timeline(recipe.family, {.seed = 3, .density = recipe.density});
  if (recipe.panorama) {
    const ScannerErrors errors = timeline.scanners.front().errors;
    timeline.scanners.assign(timeline.scanners.size(), tripod_scanner({.azimuth_steps = 1600, .elevation_steps = 320}));
    for (Scanner& scanner : timeline.scanners) scanner.errors = errors;
  }
  const Moment& last = timeline.moments.back();
  const auto distance_m = [&](const Moment& moment) {
    return (moment.plan.true_world_from_sensor.position_m - last.plan.true_world_from_sensor.position_m).norm();
  };
  const Moment *same = nullptr, *other = nullptr;
  for (const Moment& moment : timeline.moments) {
    if (&moment != &last) (distance_m(moment) < 0.25 ? same : other) = &moment;
  }
  const auto take = [&](const Moment& moment) {
    return indexed(take_scan(timeline, moment), timeline.scanners[moment.scanner]);
  };
  BenchScene scene{recipe.name, take(last), take(*same), take(*other), {}};
  const double resolution_rad = scene.scan.sensor.angular_resolution_rad->maxCoeff();
  scene.thresholds = {recipe.angle_per_resolution > 0.0 ? recipe.angle_per_resolution * resolution_rad : radians(1.0),
                      0.1};
  return scene;
}

}  // namespace

const BenchScene& scene(SceneSize size) {
  static const std::array<Recipe, 3> recipes{{{"dense", Family::lab, 1.0, true, 0.0},
                                              {"survey_1.4M", Family::mine, 1.0, false, 3.0},
                                              {"survey_5.6M", Family::mine, 4.0, false, 3.0}}};
  static std::map<SceneSize, BenchScene> made;
  const auto found = made.find(size);
  if (found != made.end()) return found->second;
  return made.emplace(size, make(recipes[static_cast<std::size_t>(size)])).first->second;
}

}  // namespace raywatch::bench
