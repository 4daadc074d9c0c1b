#include "tests/simulator/story.hpp"

#include <algorithm>
#include <cmath>

#include "tests/simulator/registration.hpp"

namespace raywatch::simulator {
namespace {

RegistrationError registration_error(const FamilyOptions& options) {
  if (!options.hard) return {};
  return {.position_sigma_m = 0.01, .angle_sigma_rad = radians(0.05)};
}

/// A scanner that only shoots where a sphere is.
Scanner aimed(const Scanner& scanner, const Eigen::Vector3d& center_m, double radius_m) {
  const double range_m = std::max(center_m.norm(), radius_m * 1.001);
  const double half_rad = std::asin(radius_m / range_m);
  const double elevation_rad = std::asin(std::clamp(center_m.z() / range_m, -1.0, 1.0));
  const double azimuth_rad = std::atan2(center_m.y(), center_m.x());
  const double level = std::cos(std::min(std::abs(elevation_rad) + half_rad, 0.5 * std::numbers::pi));
  const double half_azimuth_rad = level > radius_m / range_m ? std::asin(radius_m / range_m / level) : std::numbers::pi;
  Scanner result = scanner;
  result.errors = {};
  result.no_return = NoReturn::omit;
  std::erase_if(result.elevations_rad, [&](double angle) { return std::abs(angle - elevation_rad) > half_rad; });
  std::erase_if(result.azimuths_rad, [&](double angle) {
    return std::abs(std::remainder(angle - azimuth_rad, 2.0 * std::numbers::pi)) > half_azimuth_rad;
  });
  return result;
}

}  // namespace

void append_scan(Timeline& timeline, const FamilyOptions& options, NextScan scan) {
  const std::uint64_t seed = scrambled(options.seed) + timeline.moments.size();
  const Pose& nominal = scan.lookout.nominal_world_from_sensor;
  const Pose other = disturbed(nominal, registration_error(options), seed);
  const bool fixed = scan.lookout.mount == Mount::fixed;
  std::ranges::sort(scan.present);
  timeline.moments.push_back({.plan = {.true_world_from_sensor = fixed ? other : nominal,
                                       .reported_world_from_sensor = fixed ? nominal : other,
                                       .captured_at = scan.captured_at,
                                       .sensor = scan.lookout.sensor,
                                       .seed = seed},
                              .scanner = scan.lookout.scanner,
                              .present = std::move(scan.present),
                              .passing = std::move(scan.passing),
                              .wind_seed = scan.windy ? scrambled(seed + 1) | 1 : 0});
}

Time start_of(const FamilyOptions& options) {
  using namespace std::chrono;
  return options.start.value_or(sys_days(year(2026) / March / 1) + 8h);
}

std::uint32_t steps_at_density(std::uint32_t usual, double density) {
  return std::max(4U, static_cast<std::uint32_t>(std::lround(usual * std::sqrt(density))));
}

Scanner ring_scanner(const FamilyOptions& options) {
  Scanner scanner = spinning_scanner(
      {.rings = steps_at_density(64, options.density), .azimuth_steps = steps_at_density(1800, options.density)});
  scanner.errors = {.range_noise_m = 0.02,
                    .angular_noise_rad = 3e-4,
                    .beam_divergence_rad = 2e-3,
                    .dropout_share = 0.01,
                    .self_return_share = 0.02};
  return scanner;
}

Scanner usual_scanner(const FamilyOptions& options) {
  FamilyOptions usual = options;
  usual.density = 1.0;
  return ring_scanner(usual);
}

void append(Timeline& timeline, const Shapes& shapes) {
  timeline.background.insert(timeline.background.end(), shapes.begin(), shapes.end());
}

void plant(Timeline& timeline, RandomSequence& random, const TreeRow& row) {
  for (int i = 0; i < row.count; ++i) {
    const double crown_m = random.in({1.2, 2.0});
    const TreeSize size{.height_m = 2.0 + 2.0 * crown_m, .crown_radius_m = crown_m, .seed = random.seed()};
    const double along = (i + random.in({0.2, 0.8})) / row.count;
    const Eigen::Vector2d place_m = row.from_m + along * (row.to_m - row.from_m);
    timeline.trees.push_back({size, {{place_m.x(), place_m.y(), -0.1}, 0.0}});
  }
}

std::size_t returns_from(const Timeline& timeline, const Lookout& lookout, const std::vector<StateId>& present,
                         StateId object) {
  const Eigen::AlignedBox3d& box = timeline.object(object).box;
  const Pose& pose = lookout.nominal_world_from_sensor;
  const Scanner scanner =
      aimed(timeline.scanners.at(lookout.scanner), pose.inverse() * box.center(), 0.5 * box.diagonal().norm());
  const Scene scene = lasting_scene(timeline, present);
  const SimulatedScan scan = take_scan(RayCaster(scene), scanner, exact_plan(pose));
  return static_cast<std::size_t>(std::ranges::count(scan.labels, object));
}

}  // namespace raywatch::simulator
