#include "tests/simulator/scanner.hpp"

#include <cmath>

namespace raywatch::simulator {
namespace {

struct Steps {
  double from_rad;
  double to_rad;
  std::uint32_t count;
};

/// Both ends included.
void append_closed(std::vector<double>& angles_rad, const Steps& steps) {
  const double gaps = steps.count > 1 ? steps.count - 1.0 : 1.0;
  for (std::uint32_t i = 0; i < steps.count; ++i) {
    angles_rad.push_back(steps.from_rad + (steps.to_rad - steps.from_rad) * i / gaps);
  }
}

std::vector<double> full_turn(std::uint32_t steps) {
  std::vector<double> azimuths_rad;
  for (std::uint32_t i = 0; i < steps; ++i) {
    azimuths_rad.push_back(-std::numbers::pi + 2.0 * std::numbers::pi * i / steps);
  }
  return azimuths_rad;
}

}  // namespace

Scanner grid_scanner(const GridAngles& angles) {
  const double height_rad = angles.highest_elevation_rad - angles.lowest_elevation_rad;
  const auto rows = static_cast<std::uint32_t>(std::lround(height_rad / angles.step_rad)) + 1;
  Scanner scanner;
  append_closed(scanner.elevations_rad, {angles.lowest_elevation_rad, angles.highest_elevation_rad, rows});
  scanner.azimuths_rad = full_turn(static_cast<std::uint32_t>(std::lround(2.0 * std::numbers::pi / angles.step_rad)));
  return scanner;
}

Scanner spinning_scanner(const RingAngles& angles) {
  const std::uint32_t upper = (angles.rings + 1) / 2;
  Scanner scanner;
  append_closed(scanner.elevations_rad, {radians(2.0), radians(2.0 - 31.0 / 3.0), upper});
  append_closed(scanner.elevations_rad, {radians(2.0 - 31.0 / 3.0 - 0.5), radians(-24.33), angles.rings - upper});
  scanner.azimuths_rad = full_turn(angles.azimuth_steps);
  scanner.max_range_m = 120.0;
  return scanner;
}

Scanner tripod_scanner(const PanoramaAngles& angles) {
  Scanner scanner;
  append_closed(scanner.elevations_rad,
                {angles.lowest_elevation_rad, angles.highest_elevation_rad, angles.elevation_steps});
  scanner.azimuths_rad = full_turn(angles.azimuth_steps);
  return scanner;
}

}  // namespace raywatch::simulator
