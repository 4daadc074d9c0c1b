#include "core/look.hpp"

#include <algorithm>

#include "core/asking.hpp"

namespace raywatch {
Thresholds look_thresholds(const SensorModel& sensor, const CompareParameters& parameters) {
  const bool weighs = parameters.support_distance_m > 0.0;
  return {.angle_rad = parameters.angle_rad.value_or(default_angle_rad(sensor)),
          .range_m = weighs ? std::min(parameters.support_distance_m, parameters.range_m) : parameters.range_m};
}

std::vector<Answer> look_at(const ScanView& scan, std::span<const Eigen::Vector3d> places_m,
                            const CompareParameters& parameters) {
  const Pose sensor_from_world = scan.world_from_sensor.inverse();
  PointCloud places;
  places.reserve(places_m.size());
  std::vector<std::uint8_t> valid;
  for (const Eigen::Vector3d& place_m : places_m) {
    const Eigen::Vector3d p = sensor_from_world * place_m;
    places.push_back(static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z()));
    valid.push_back(is_usable(p.norm(), scan.index.usable()) ? 1 : 0);
  }
  std::vector<Answer> answers(places_m.size(), Answer::unseen);
  ask(scan.index, places, valid, Pose{}, look_thresholds(scan.sensor, parameters), answers);
  return answers;
}

}  // namespace raywatch
