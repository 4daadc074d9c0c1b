/// Compares two nights of a pit, four scans of about five million points each, and says how long each step takes.

#include <oneapi/tbb/task_arena.h>
#include <sys/resource.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdio>
#include <ctime>

#include "core/epoch.hpp"
#include "core/profile.hpp"
#include "tests/simulator/pit.hpp"
#include "tests/simulator/simulated_scan.hpp"

namespace raywatch {
namespace {

using simulator::radians;

/// What a scan is in a comparison, without the simulator's truth.
struct Taken {
  PointCloud points;
  Pose world_from_sensor;
  Time captured_at;
};

struct Sizes {
  std::uint32_t azimuth_steps = 4200;
  std::uint32_t elevation_steps = 1500;
  std::size_t scans = 4;
};

std::vector<Taken> take_night(std::uint32_t night, const Sizes& sizes) {
  const auto ground = std::make_shared<simulator::HeightField>(simulator::Pit(1).ground(night));
  simulator::Scene scene;
  scene.add(simulator::Terrain{ground, nullptr});
  const simulator::RayCaster world(scene);
  simulator::Scanner scanner = simulator::tripod_scanner({.azimuth_steps = sizes.azimuth_steps,
                                                          .elevation_steps = sizes.elevation_steps,
                                                          .lowest_elevation_rad = radians(-40.0),
                                                          .highest_elevation_rad = radians(8.0)});
  scanner.max_range_m = 600.0;
  scanner.errors.range_noise_m = 0.01;
  std::vector<Taken> scans;
  for (std::size_t k = 0; k < sizes.scans; ++k) {
    const double y_m = 60.0 * (static_cast<double>(k) / static_cast<double>(sizes.scans - 1) - 0.5);
    // Off the nodes of the ground, and turned, so that no ray runs exactly along a border of its cells.
    const Pose pose{.orientation = Eigen::Quaterniond(Eigen::AngleAxisd(0.0123, Eigen::Vector3d::UnitZ())),
                    .position_m = {-50.37 - 3.1 * static_cast<double>(k), y_m + 0.19, 6.0}};
    simulator::ScanPlan plan = simulator::exact_plan(pose, 100 * night + k);
    plan.captured_at = Time{} + std::chrono::hours(24 * night) + std::chrono::minutes(10 * k);
    simulator::SimulatedScan scan = simulator::take_scan(world, scanner, plan);
    scans.push_back({std::move(scan.points), plan.true_world_from_sensor, plan.captured_at});
  }
  return scans;
}

/// Prints wall and processor time since the last step.
class Stopwatch {
 public:
  void lap(const char* step) {
    const auto wall = std::chrono::steady_clock::now();
    const std::clock_t cpu = std::clock();
    const double wall_s = std::chrono::duration<double>(wall - wall_).count();
    const double cpu_s = static_cast<double>(cpu - cpu_) / CLOCKS_PER_SEC;
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    std::printf("| %s | %.1f | %.1f | %.2f |\n", step, wall_s, cpu_s, static_cast<double>(usage.ru_maxrss) / 1048576.0);
    std::fflush(stdout);
    wall_ = std::chrono::steady_clock::now();
    cpu_ = std::clock();
  }

 private:
  std::chrono::steady_clock::time_point wall_ = std::chrono::steady_clock::now();
  std::clock_t cpu_ = std::clock();
};

EpochScans epoch_of_scans(const std::vector<Taken>& scans, const std::vector<PriorIndex>& indexes) {
  EpochScans epoch;
  for (std::uint32_t k = 0; k < scans.size(); ++k) {
    epoch.add({scans[k].points,
               indexes[k],
               scans[k].world_from_sensor,
               scans[k].captured_at,
               estimate_sensor(scans[k].points, indexes[k]),
               {.position_m = 0.01, .angle_rad = 3.5e-5}},
              k);
  }
  return epoch;
}

void run(const Sizes& sizes) {
  std::printf("| step | wall, s | processor, s | peak memory so far, GiB |\n| --- | ---: | ---: | ---: |\n");
  Stopwatch watch;
  const std::vector<Taken> nights[2] = {take_night(1, sizes), take_night(2, sizes)};
  watch.lap("simulate (not counted)");
  std::vector<PriorIndex> indexes[2];
  std::size_t points = 0;
  for (int night = 0; night < 2; ++night) {
    for (const Taken& scan : nights[night]) {
      indexes[night].push_back(PriorIndex::build(scan.points, {}));
      points += scan.points.size();
    }
  }
  const EpochScans before = epoch_of_scans(nights[0], indexes[0]), after = epoch_of_scans(nights[1], indexes[1]);
  watch.lap("index");
  const EpochComparison comparison =
      compare_epochs({before, after}, default_parameters(Profile::survey, Grouping::consensus));
  watch.lap("compare");
  const GridLayout layout = layout_over({Eigen::Vector2d(-100.0, -100.0), Eigen::Vector2d(100.0, 100.0)}, 0.5);
  const ElevationModel earlier = make_elevation_model(before, layout, {}),
                       later = make_elevation_model(after, layout, {});
  watch.lap("elevation models, 160,000 cells each");
  const Prism zone{{{-30, -80}, {35, -80}, {35, 80}, {-30, 80}}, -2.0, 40.0};
  const ZoneVolumes volumes = volumes_between(earlier, later, zone);
  const std::vector<FootprintVolume> of_changes = volumes_of_changes({before, after}, comparison, earlier, later);
  watch.lap("volumes");
  std::printf(
      "\n%zu points in %zu scans; %zu changes; testable %.2f and %.2f; cut %.0f m3, fill %.0f m3; %.0f %% seen.\n",
      points, before.scans.size() + after.scans.size(), of_changes.size(), comparison.testable_before,
      comparison.testable_after, volumes.cut.value_m3, volumes.fill.value_m3, 100.0 * volumes.seen_share());
}

}  // namespace
}  // namespace raywatch

int main(int argc, char** argv) {
  CLI::App app("Compares two epochs of dense scans of a simulated pit.", "raywatch-bench-epochs");
  raywatch::Sizes sizes;
  int threads = 2;
  app.add_option("--azimuth-steps", sizes.azimuth_steps)->capture_default_str();
  app.add_option("--elevation-steps", sizes.elevation_steps)->capture_default_str();
  app.add_option("--scans", sizes.scans, "Of each epoch")->check(CLI::Range(2, 16))->capture_default_str();
  app.add_option("--threads", threads)->check(CLI::Range(1, 64))->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  oneapi::tbb::task_arena(threads).execute([&] { raywatch::run(sizes); });
  return 0;
}
