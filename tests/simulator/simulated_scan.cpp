#include "tests/simulator/simulated_scan.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "tests/simulator/beam.hpp"
#include "tests/simulator/random.hpp"

namespace raywatch::simulator {
namespace {

/// The rig's own posts as seen by the sensor: three sectors of azimuth in which nothing else is seen.
constexpr int kPosts = 3;
constexpr double kPostNearest_m = 0.4;
constexpr double kPostFarthest_m = 0.69;

Eigen::Vector3d direction(double azimuth_rad, double elevation_rad) {
  const double level = std::cos(elevation_rad);
  return {level * std::cos(azimuth_rad), level * std::sin(azimuth_rad), std::sin(elevation_rad)};
}

bool hits_own_post(double azimuth_rad, double self_return_share) {
  const double turn = azimuth_rad / (2.0 * std::numbers::pi) + 1.0;
  const double within_sector = turn * kPosts - std::floor(turn * kPosts);
  return std::abs(within_sector - 0.5) < 0.5 * self_return_share;
}

/// One shot with all of its errors.
class Shooter {
 public:
  Shooter(const RayCaster& world, const Scanner& scanner, const ScanPlan& plan)
      : world_(world), scanner_(scanner), plan_(plan), random_(plan.seed) {}

  Eigen::Vector3d nominal_direction(std::size_t shot) const {
    const std::size_t columns = scanner_.azimuths_rad.size();
    return direction(scanner_.azimuths_rad[shot % columns], scanner_.elevations_rad[shot / columns]);
  }

  std::optional<Return> operator()(std::size_t shot) const {
    const ScannerErrors& errors = scanner_.errors;
    const std::size_t columns = scanner_.azimuths_rad.size();
    double azimuth_rad = scanner_.azimuths_rad[shot % columns];
    double elevation_rad = scanner_.elevations_rad[shot / columns];
    if (hits_own_post(azimuth_rad, errors.self_return_share)) {
      const double share = random_.uniform(Purpose::self_return, shot);
      return Return{kPostNearest_m + share * (kPostFarthest_m - kPostNearest_m), kNoSurface};
    }
    if (errors.dropout_share > 0.0 && random_.uniform(Purpose::dropout, shot) < errors.dropout_share) {
      return std::nullopt;
    }
    if (errors.angular_noise_rad > 0.0) {
      azimuth_rad += errors.angular_noise_rad * random_.normal(Purpose::azimuth_noise, shot);
      elevation_rad += errors.angular_noise_rad * random_.normal(Purpose::elevation_noise, shot);
    }
    const Pose& pose = plan_.true_world_from_sensor;
    const Ray axis{pose.position_m, pose.orientation * direction(azimuth_rad, elevation_rad)};
    auto result = trace_beam(world_, axis, errors);
    if (!result || result->range_m > scanner_.max_range_m) return std::nullopt;
    if (errors.range_noise_m > 0.0) {
      result->range_m += errors.range_noise_m * random_.normal(Purpose::range_noise, shot);
    }
    return result;
  }

 private:
  const RayCaster& world_;
  const Scanner& scanner_;
  const ScanPlan& plan_;
  CounterRandom random_;
};

void append(SimulatedScan& scan, const Eigen::Vector3d& point_m, StateId label) {
  const Eigen::Vector3f rounded = point_m.cast<float>();
  scan.points.push_back(rounded.x(), rounded.y(), rounded.z());
  scan.labels.push_back(label);
}

void append_no_return(SimulatedScan& scan, const Scanner& scanner, const Eigen::Vector3d& towards) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  switch (scanner.no_return) {
    case NoReturn::omit:
      return;
    case NoReturn::nan:
      return append(scan, Eigen::Vector3d::Constant(kNan), kNoSurface);
    case NoReturn::zero:
      return append(scan, Eigen::Vector3d::Zero(), kNoSurface);
    case NoReturn::sentinel:
      return append(scan, scanner.sentinel_range_m * towards, kNoSurface);
  }
}

}  // namespace

ScanPlan exact_plan(const Pose& world_from_sensor, std::uint64_t seed) {
  return {.true_world_from_sensor = world_from_sensor,
          .reported_world_from_sensor = world_from_sensor,
          .captured_at = {},
          .sensor = "sensor",
          .seed = seed};
}

SimulatedScan take_scan(const RayCaster& world, const Scanner& scanner, const ScanPlan& plan) {
  const Shooter shoot(world, scanner, plan);
  std::vector<std::optional<Return>> returns(scanner.shot_count());
  constexpr std::size_t kShotsPerTask = 2048;
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, returns.size(), kShotsPerTask), [&](const auto& range) {
    for (std::size_t shot = range.begin(); shot < range.end(); ++shot) returns[shot] = shoot(shot);
  });

  SimulatedScan scan;
  scan.true_world_from_sensor = plan.true_world_from_sensor;
  scan.reported_world_from_sensor = plan.reported_world_from_sensor;
  scan.captured_at = plan.captured_at;
  scan.sensor = plan.sensor;
  scan.present.assign(world.scene().present.begin(), world.scene().present.end());
  scan.points.reserve(returns.size());
  scan.labels.reserve(returns.size());
  for (std::size_t shot = 0; shot < returns.size(); ++shot) {
    const Eigen::Vector3d towards = shoot.nominal_direction(shot);
    if (const auto& found = returns[shot]) {
      append(scan, found->range_m * towards, found->state);
    } else {
      append_no_return(scan, scanner, towards);
    }
  }
  if (scanner.no_return != NoReturn::omit) {
    scan.points.grid = ShotGrid{static_cast<std::uint32_t>(scanner.elevations_rad.size()),
                                static_cast<std::uint32_t>(scanner.azimuths_rad.size())};
  }
  return scan;
}

bool is_truly_changed(const SimulatedScan& scan, std::size_t i, const SimulatedScan& other) {
  const StateId state = scan.labels[i];
  if (state == kBackground || state == kNoSurface) return false;
  return !std::ranges::binary_search(other.present, state);
}

}  // namespace raywatch::simulator
