#include "core/asking.hpp"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cstdio>
#include <numbers>

#include "core/assumed_sensor.hpp"
#include "core/evidence.hpp"
#include "core/footprint.hpp"
#include "core/index_kernels.hpp"

namespace raywatch {
namespace {

constexpr double kAnglePerSpacing = 1.6;
constexpr double kFallbackAngle_rad = std::numbers::pi / 180.0;

double spacing_rad(const SensorModel& sensor) {
  return sensor.angular_resolution_rad ? sensor.angular_resolution_rad->maxCoeff() : 0.0;
}

Pose asked_from_view(const ScanView& asked, const ScanView& view) {
  return asked.world_from_sensor.inverse() * view.world_from_sensor;
}

}  // namespace

double default_angle_rad(const SensorModel& sensor) {
  const double spacing = spacing_rad(sensor);
  return spacing > 0.0 ? std::min(kAnglePerSpacing * spacing, std::numbers::pi / 2) : kFallbackAngle_rad;
}

bool Asking::weighs() const {
  return parameters_.grouping == Grouping::consensus && parameters_.support_distance_m > 0.0;
}

double Asking::angle_rad(const ScanView& asked) const {
  return parameters_.angle_rad.value_or(default_angle_rad(asked.sensor));
}

Thresholds Asking::surface_thresholds(const ScanView& asked) const {
  return {std::min(angle_rad(asked), default_angle_rad(asked.sensor)), parameters_.range_m};
}

Answers Asking::ask_all(const ScanView& asked, const ScanView& view, std::span<const std::uint8_t> valid) const {
  Answers answers(view.points.size());
  ask(asked.index, view.points, valid, asked_from_view(asked, view), thresholds(asked), answers);
  return answers;
}

std::vector<std::uint32_t> Asking::find_free(const ScanView& asked, const ScanView& view,
                                             std::span<const std::uint8_t> valid) const {
  std::vector<std::uint8_t> free(view.points.size());
  raywatch::find_free(asked.index, view.points, valid, asked_from_view(asked, view), thresholds(asked), free);
  std::vector<std::uint32_t> places;
  for (std::uint32_t i = 0; i < free.size(); ++i) {
    if (free[i]) places.push_back(i);
  }
  return places;
}

Answers Asking::ask_at(const ScanView& asked, const ScanView& view, std::span<const std::uint32_t> places) const {
  const PointCloud points = points_at(view.points, places);
  Answers answers(places.size());
  const Pose pose = asked_from_view(asked, view);
  ask(asked.index, points, std::vector<std::uint8_t>(places.size(), 1), pose, thresholds(asked), answers);
  if (weighs()) {
    weigh(asked.index, points, pose, surface_thresholds(asked), tolerance_between(asked, view, parameters_), answers);
  }
  return answers;
}

void Asking::look_closely(const ScanView& asked, const ScanView& view, std::span<const std::uint32_t> places,
                          Answers& answers) const {
  if (!weighs()) return;
  const PointCloud points = points_at(view.points, places);
  Answers chosen;
  chosen.reserve(places.size());
  for (const std::uint32_t i : places) chosen.push_back(answers[i]);
  const Pose pose = asked_from_view(asked, view);
  weigh(asked.index, points, pose, surface_thresholds(asked), tolerance_between(asked, view, parameters_), chosen);
  ask_footprints(asked, points, pose, parameters_.range_m, chosen);
  withhold_at_borders(asked, points, pose, noise_of(view), chosen);
  for (std::size_t k = 0; k < places.size(); ++k) answers[places[k]] = chosen[k];
}

void Asking::warn_of_coarse_rings(const ScanView& asked, const std::string& name,
                                  std::vector<std::string>& warnings) const {
  const double spacing = spacing_rad(asked.sensor), angle = angle_rad(asked);
  if (!parameters_.angle_rad || spacing == 0.0 || angle >= spacing) return;
  char text[240];
  const double degrees = 180.0 / std::numbers::pi;
  std::snprintf(text, sizeof text,
                "The angular threshold of %.4g degrees is below the spacing of the shots of %s (%.4g degrees): many "
                "points have no neighbours on every side, so that changes are missed; %.3g degrees or more would do.",
                angle * degrees, name.c_str(), spacing * degrees, kAnglePerSpacing * spacing * degrees);
  warnings.emplace_back(text);
}

std::vector<std::uint8_t> valid_points(const ScanView& view) {
  constexpr std::size_t kGrain = 16384;
  std::vector<std::uint8_t> valid(view.points.size());
  const PointPlanes planes = planes_of(view.points);
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, valid.size(), kGrain), [&](const auto& block) {
    find_usable(planes.subspan(block.begin(), block.size()), view.index.usable(), valid.data() + block.begin());
  });
  return valid;
}

PointCloud points_at(const PointCloud& points, std::span<const std::uint32_t> places) {
  PointCloud chosen;
  chosen.reserve(places.size());
  for (const std::uint32_t i : places) chosen.push_back(points.x_m[i], points.y_m[i], points.z_m[i]);
  return chosen;
}

}  // namespace raywatch
