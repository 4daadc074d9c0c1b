#include "core/glass.hpp"

#include <cmath>
#include <optional>
#include <vector>

#include "core/plane_patch.hpp"
#include "core/returns_sample.hpp"

namespace raywatch {
namespace {

/// Within how many times the thickness of a plane others are in line with it.
constexpr double kInLine = 2.5;

/// Some of the returns within reach of a cluster that lie on its plane.
std::vector<Eigen::Vector3d> returns_on(const ClusterPlane& plane, const ScanView& asked, double off_m) {
  constexpr double kBeside_m = 2.0;
  constexpr std::size_t kMost = 100;
  return sample_of_returns_around(asked.index.impl(), plane.center_m, plane.radius_m + kBeside_m, kMost,
                                  [&](const Eigen::Vector3d& p) { return plane.off_m(p) <= off_m; });
}

}  // namespace

bool may_be_glass(const ClusterPlane& plane, const ScanView& asked) {
  constexpr double kOblique = 0.9;      // nearly upright rays no glass lets through without any return
  constexpr double kParallel = 0.9;     // of the normals of a surface and the cluster's plane
  constexpr std::size_t kLeastOn = 10;  // returns that make a surface
  constexpr double kMostAsOblique = 0.1;
  const double asked_facing = plane.median_facing(Eigen::Vector3d::Zero());
  const double own_facing = plane.median_facing(plane.own_sensor_m);
  if (asked_facing > kOblique || own_facing <= asked_facing) return false;
  const PatchFitter surface_at(asked);
  std::size_t on = 0, as_oblique = 0;
  for (const Eigen::Vector3d& p : returns_on(plane, asked, kInLine * plane.thickness_m)) {
    const std::optional<PlanePatch> surface = surface_at(p);
    if (!surface || std::abs(surface->normal().dot(plane.normal)) < kParallel) continue;
    ++on;
    as_oblique += plane.facing(p, Eigen::Vector3d::Zero()) <= asked_facing;
  }
  return on >= kLeastOn && static_cast<double>(as_oblique) <= kMostAsOblique * static_cast<double>(on);
}

}  // namespace raywatch
