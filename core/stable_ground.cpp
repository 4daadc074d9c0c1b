#include "core/stable_ground.hpp"

#include <algorithm>
#include <cstdio>

namespace raywatch {
namespace {

template <class... Values>
std::string text(const char* format, Values... values) {
  char buffer[256];
  std::snprintf(buffer, sizeof buffer, format, values...);
  return buffer;
}

/// The stable part of a scan, as a scan.
struct StablePart {
  PointCloud points;
  PriorIndex index;

  StablePart(const ScanView& scan, std::span<const std::uint32_t> places)
      : points(points_at(scan, places)), index(PriorIndex::build(points, scan.index.usable())) {}
  static PointCloud points_at(const ScanView& scan, std::span<const std::uint32_t> places) {
    PointCloud points;
    points.reserve(places.size());
    for (const std::uint32_t place : places) {
      points.push_back(scan.points.x_m[place], scan.points.y_m[place], scan.points.z_m[place]);
    }
    return points;
  }
  ScanView view(const ScanView& of) const {
    return {points, index, of.world_from_sensor, of.captured_at, of.sensor, of.pose_uncertainty};
  }
};

/// Why a scan must not be used; nothing when it may.
std::optional<std::string> refusal(const Alignment& found, const RegistrationTolerance& tolerance) {
  constexpr double kMillimetres = 1000.0, kDegrees = 57.29577951308232;
  if (found.state == RegistrationState::none) {
    return "The reference epoch shows too little of the stable ground; choose stable ground that both epochs see.";
  }
  if (found.state == RegistrationState::bad) {
    return text(
        "The stable ground does not fit that of the reference epoch (%.0f %% of it agrees); it may have moved, "
        "or the pose as reported is too far off.",
        100.0 * found.inliers);
  }
  if (found.free_directions > 0) {
    return text(
        "The stable ground leaves %zu of the six directions of motion free, as a plane does; add stable ground "
        "that faces other ways, such as a wall or a slope.",
        found.free_directions);
  }
  if (found.residual_m > tolerance.residual_m) {
    return text("The residual on stable ground is %.1f mm, more than the %.1f mm that are allowed.",
                kMillimetres * found.residual_m, kMillimetres * tolerance.residual_m);
  }
  const PoseUncertainty& left = found.uncertainty;
  if (left.position_m > tolerance.uncertainty.position_m || left.angle_rad > tolerance.uncertainty.angle_rad) {
    return text(
        "The pose stays uncertain by %.1f mm and %.4f degrees, more than the %.1f mm and %.4f degrees that are "
        "allowed; more stable ground, farther apart, would help.",
        kMillimetres * left.position_m, kDegrees * left.angle_rad, kMillimetres * tolerance.uncertainty.position_m,
        kDegrees * tolerance.uncertainty.angle_rad);
  }
  return std::nullopt;
}

}  // namespace

std::vector<std::uint32_t> points_in(const ScanView& scan, std::span<const Prism> prisms) {
  std::vector<std::uint32_t> places;
  const Eigen::Matrix3d rotation = scan.world_from_sensor.orientation.toRotationMatrix();
  const UsableRange& usable = scan.index.usable();
  for (std::size_t i = 0; i < scan.points.size(); ++i) {
    const Eigen::Vector3d in_sensor_m = scan.points[i].cast<double>();
    if (!is_usable(in_sensor_m.norm(), usable)) continue;
    const Eigen::Vector3d place_m = rotation * in_sensor_m + scan.world_from_sensor.position_m;
    const bool inside = std::ranges::any_of(prisms, [&](const Prism& prism) { return contains(prism, place_m); });
    if (inside) places.push_back(static_cast<std::uint32_t>(i));
  }
  return places;
}

std::vector<std::uint32_t> unchanged_points(std::span<const PointClass> classes) {
  std::vector<std::uint32_t> places;
  for (std::size_t i = 0; i < classes.size(); ++i) {
    if (classes[i] == PointClass::unchanged) places.push_back(static_cast<std::uint32_t>(i));
  }
  return places;
}

StableRegistration register_on(const ScanView& scan, std::span<const std::uint32_t> stable,
                               std::span<const ScanView> references, const StableParameters& parameters) {
  StableRegistration result{.alignment = {.uncertainty = parameters.align.reported}, .points = stable.size()};
  if (stable.size() < parameters.least_points) {
    result.refused = text(
        "Only %zu of the scan's points lie on stable ground, %zu are needed; add control zones that "
        "the scan sees.",
        stable.size(), parameters.least_points);
    return result;
  }
  const StablePart part(scan, stable);
  result.alignment = align(part.view(scan), references, parameters.align);
  result.refused = refusal(result.alignment, parameters.tolerance);
  return result;
}

}  // namespace raywatch
