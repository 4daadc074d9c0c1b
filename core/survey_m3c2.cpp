#include "core/survey_m3c2.hpp"

#include <algorithm>
#include <cmath>

namespace raywatch {
namespace {

Eigen::AlignedBox3d box_of(std::span<const SurveyZone> zones) {
  Eigen::AlignedBox3d box_m;
  for (const SurveyZone& zone : zones) {
    for (const Eigen::Vector2d& corner : zone.prism.polygon_m) {
      box_m.extend(Eigen::Vector3d(corner.x(), corner.y(), zone.prism.z_min_m));
      box_m.extend(Eigen::Vector3d(corner.x(), corner.y(), zone.prism.z_max_m));
    }
  }
  return box_m;
}

Eigen::AlignedBox3d widened(Eigen::AlignedBox3d box_m, double by_m) {
  box_m.min().array() -= by_m;
  box_m.max().array() += by_m;
  return box_m;
}

bool in_any(std::span<const SurveyZone> zones, const Eigen::Vector3d& place_m) {
  return std::ranges::any_of(zones, [&](const SurveyZone& zone) { return contains(zone.prism, place_m); });
}

/// Core points in the zones. Where they would be too many, they are chosen anew, farther apart: on a surface their
/// number falls with the square of the spacing.
std::vector<Eigen::Vector3d> core_points_in(std::span<const SurveyZone> zones, const PointCloud& cloud,
                                            double spacing_m) {
  for (;;) {
    std::vector<Eigen::Vector3d> points = core_points_of(cloud, spacing_m);
    std::erase_if(points, [&](const Eigen::Vector3d& p) { return !in_any(zones, p); });
    if (points.size() <= kMostCorePoints) return points;
    spacing_m *= 1.05 * std::sqrt(static_cast<double>(points.size()) / static_cast<double>(kMostCorePoints));
  }
}

/// One zone's figures while core points are added.
class Sum {
 public:
  void add(const M3c2Distance& distance) {
    ++figures_.core_points;
    if (!std::isfinite(distance.distance_m) || !std::isfinite(distance.lod95_m)) return;
    ++figures_.measured;
    figures_.mean_lod95_m += distance.lod95_m;
    if (!distance.significant()) return;
    ++figures_.significant;
    figures_.mean_m += distance.distance_m;
    figures_.greatest_rise_m = std::max(figures_.greatest_rise_m, distance.distance_m);
    figures_.greatest_fall_m = std::min(figures_.greatest_fall_m, distance.distance_m);
  }
  M3c2Figures result() const {
    M3c2Figures figures = figures_;
    if (figures.measured > 0) figures.mean_lod95_m /= static_cast<double>(figures.measured);
    if (figures.significant > 0) figures.mean_m /= static_cast<double>(figures.significant);
    return figures;
  }

 private:
  M3c2Figures figures_;
};

double least_certain_m(const EpochScans& epoch, const Eigen::AlignedBox3d& box_m) {
  double greatest_m = 0.0;
  for (const ScanView& scan : epoch.scans) {
    const Eigen::Vector3d& at_m = scan.world_from_sensor.position_m;
    const double reach_m = (at_m - box_m.min()).cwiseAbs().cwiseMax((at_m - box_m.max()).cwiseAbs()).norm();
    const PoseUncertainty& u = scan.pose_uncertainty;
    greatest_m = std::max(greatest_m, std::hypot(u.position_m, u.angle_rad * reach_m));
  }
  return greatest_m;
}

}  // namespace

PointCloud world_points_in(const EpochScans& epoch, const Eigen::AlignedBox3d& box_m) {
  PointCloud cloud;
  for (const ScanView& scan : epoch.scans) {
    for (std::size_t i = 0; i < scan.points.size(); ++i) {
      const Eigen::Vector3d at_sensor = scan.points[i].cast<double>();
      if (!is_usable(at_sensor.norm(), scan.index.usable())) continue;
      const Eigen::Vector3d p = scan.world_from_sensor * at_sensor;
      if (!box_m.contains(p)) continue;
      cloud.push_back(static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z()));
    }
  }
  return cloud;
}

double registration_error_m(const EpochScans& before, const EpochScans& after, const Eigen::AlignedBox3d& box_m) {
  return std::hypot(least_certain_m(before, box_m), least_certain_m(after, box_m));
}

std::vector<M3c2Figures> m3c2_of_zones(const SurveyInput& input, std::span<const SurveyZone> zones,
                                       double registration_m) {
  M3c2Parameters parameters = input.definition.m3c2;
  parameters.registration_m = registration_m;
  const double around_m = parameters.max_distance_m + parameters.projection_diameter_m + parameters.normal_diameter_m;
  const Eigen::AlignedBox3d box_m = widened(box_of(zones), around_m);
  const PointCloud before = world_points_in(input.before.scans, box_m);
  const PointCloud after = world_points_in(input.after.scans, box_m);
  const std::vector<Eigen::Vector3d> core = core_points_in(zones, before, input.definition.core_spacing_m);
  std::vector<Eigen::Vector3d> sensors_m;
  for (const ScanView& scan : input.before.scans.scans) sensors_m.push_back(scan.world_from_sensor.position_m);
  const std::vector<M3c2Distance> distances = m3c2({before, after, sensors_m}, core, parameters);
  std::vector<Sum> sums(zones.size() + 1);
  for (std::size_t i = 0; i < core.size(); ++i) {
    for (std::size_t z = 0; z < zones.size(); ++z) {
      if (contains(zones[z].prism, core[i])) sums[z].add(distances[i]);
    }
    sums.back().add(distances[i]);
  }
  std::vector<M3c2Figures> figures;
  for (const Sum& sum : sums) figures.push_back(sum.result());
  return figures;
}

}  // namespace raywatch
