#include "core/evidence.hpp"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "core/assumed_sensor.hpp"
#include "core/nearest_return.hpp"
#include "core/surface_kernels.hpp"

namespace raywatch {
namespace {

/// In standard deviations: nearer to a surface than the first is on it, farther than the second is off it.
constexpr double kOn = 2.5;
constexpr double kOff = 5.0;
/// The same in multiples of the roughness.
constexpr double kOffRoughness = 2.0;

/// The distances at which a point is on a surface, and off it.
struct Limits {
  double on_m;
  double off_m;
};

/// @param cosine of the incidence: noise moves a point along the ray, a turn of the sensor across it.
Limits limits_of(const SurfaceTolerance& tolerance, double range_m, double cosine) {
  const double cosine2 = cosine * cosine;
  const double turn_m = tolerance.angle_rad * range_m;
  const double variance_m2 = tolerance.range_noise_m * tolerance.range_noise_m * cosine2 +
                             tolerance.position_m * tolerance.position_m + turn_m * turn_m * (1.0 - cosine2);
  const double roughness_m2 = tolerance.roughness_m * tolerance.roughness_m;
  return {std::sqrt(kOn * kOn * variance_m2 + roughness_m2),
          std::sqrt(kOff * kOff * variance_m2 + kOffRoughness * kOffRoughness * roughness_m2)};
}

/// What a surface says about a point, if it is flat enough to say anything.
std::optional<Answer> weigh_plane(const Surface& surface, const Limits& limits) {
  if (!surface.is_plane || !(surface.farthest_off_m <= limits.off_m)) return std::nullopt;
  if (std::abs(surface.before_m) <= limits.on_m) return Answer::supported;
  if (surface.before_m < 0.0f) return Answer::occluded;
  return surface.before_m >= limits.off_m ? Answer::free : Answer::ambiguous;
}

Answer weigh_one(const PreparedPrior& prior, const Eigen::Vector3d& point_m, const Surface& surface,
                 const SurfaceTolerance& tolerance, Answer asked) {
  const double range_m = point_m.norm();
  const Limits facing = limits_of(tolerance, range_m, 1.0);
  if (!(range_m > facing.off_m)) return asked;
  const double cosine = std::min(1.0, static_cast<double>(surface.cosine));
  if (const auto answer = weigh_plane(surface, limits_of(tolerance, range_m, cosine))) return *answer;
  const bool has_looked_far_enough = facing.off_m < range_m * std::sin(prior.thresholds.angle_rad);
  const double nearest_m = has_looked_far_enough ? std::min<double>(surface.nearest_m, facing.off_m)
                                                 : nearest_return_m(prior.index, point_m, facing.on_m, facing.off_m);
  if (nearest_m <= facing.on_m) return Answer::supported;
  if (asked == Answer::supported || nearest_m < facing.off_m) return Answer::ambiguous;
  return asked;
}

}  // namespace

SurfaceTolerance tolerance_between(const ScanView& a, const ScanView& b, const CompareParameters& parameters) {
  return {.roughness_m = parameters.support_distance_m,
          .range_noise_m = std::hypot(noise_of(a), noise_of(b)),
          .position_m = std::hypot(a.pose_uncertainty.position_m, b.pose_uncertainty.position_m),
          .angle_rad = std::hypot(a.pose_uncertainty.angle_rad, b.pose_uncertainty.angle_rad)};
}

void weigh(const PriorIndex& prior, const PointCloud& points, const Pose& prior_from_points,
           const Thresholds& thresholds, const SurfaceTolerance& tolerance, std::span<Answer> answers) {
  if (prior.size() == 0) return;
  const PreparedPrior prepared(prior.impl(), thresholds);
  const RigidMotion motion(prior_from_points);
  constexpr std::size_t kGrain = 1024;
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, points.size(), kGrain), [&](const auto& block) {
    std::vector<Surface> surfaces(block.size());
    find_surfaces(prepared, planes_of(points).subspan(block.begin(), block.size()), motion, surfaces.data());
    for (std::size_t i = block.begin(); i < block.end(); ++i) {
      const std::array<double, 3> point_m = motion.apply(points.x_m[i], points.y_m[i], points.z_m[i]);
      answers[i] =
          weigh_one(prepared, {point_m[0], point_m[1], point_m[2]}, surfaces[i - block.begin()], tolerance, answers[i]);
    }
  });
}

}  // namespace raywatch
