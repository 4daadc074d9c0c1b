#include "core/evidence.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "core/cone.hpp"
#include "core/for_each_point.hpp"
#include "core/prior_index_impl.hpp"

namespace raywatch {
namespace {

/// In standard deviations: nearer to a surface than the first is on it, farther than the second is off it.
constexpr double kOn = 2.5;
constexpr double kOff = 5.0;
/// The same in multiples of the roughness.
constexpr double kOffRoughness = 2.0;
/// Assumed of sensors of which nothing is known.
constexpr double kFallbackNoise_m = 0.02;

/// A plane n . x = 1 that stands before the sensor in its origin; n in 1/m.
struct InversePlane {
  Eigen::Vector3d n_per_m;

  /// How far a point lies before the plane (towards the sensor: positive).
  double distance_before_m(const Eigen::Vector3d& point_m) const {
    return (1.0 - n_per_m.dot(point_m)) / n_per_m.norm();
  }
};

/// The distances at which a point is on a surface, and off it.
struct Limits {
  double on_m;
  double off_m;
};

/// @param cosine of the incidence: noise moves a point along the ray, a turn of the sensor across it.
Limits limits_of(const SurfaceTolerance& tolerance, double range_m, double cosine) {
  const double sine2 = 1.0 - cosine * cosine;
  const double turn_m = tolerance.angle_rad * range_m;
  const double sigma_m = std::sqrt(tolerance.range_noise_m * tolerance.range_noise_m * cosine * cosine +
                                   tolerance.position_m * tolerance.position_m + turn_m * turn_m * sine2);
  return {std::hypot(kOn * sigma_m, tolerance.roughness_m),
          std::hypot(kOff * sigma_m, kOffRoughness * tolerance.roughness_m)};
}

/// A return in the prior's frame, with its range.
struct RangedReturn {
  Eigen::Vector3d place_m;
  double range_m;
};

/// The prior's returns around one point. `memory` is used for them, so that not every point asks for new one.
class Surroundings {
 public:
  Surroundings(const PriorIndex::Impl& prior, const Eigen::Vector3d& point_m, double angle_rad,
               std::vector<RangedReturn>& memory)
      : point_m_(point_m), returns_(memory) {
    returns_.clear();
    const double cosine_m = std::cos(angle_rad) * point_m.norm();
    const Direction axis = direction_of(point_m.x(), point_m.y(), point_m.z());
    Cone(angle_rad).for_each_cell(prior.grid, axis, [&](std::uint32_t cell, bool) {
      for (std::uint32_t i = prior.first[cell]; i < prior.first[cell + 1]; ++i) {
        const Eigen::Vector3d p = point_of(prior.returns[i]);
        const double rho = p.norm();
        if (p.dot(point_m) >= cosine_m * rho) returns_.push_back({p, rho});
      }
      return true;
    });
  }

  /// The plane through the returns in the cone, if they surround the point. In directions u_i and inverse ranges, a
  /// plane is the linear function n . u_i = 1 / rho_i, so that the fit is a linear least-squares problem of three
  /// unknowns, for any incidence.
  std::optional<InversePlane> fit() const {
    constexpr std::size_t kLeastReturns = 5;
    if (returns_.size() < kLeastReturns || !surround()) return std::nullopt;
    Eigen::Matrix3d moments = Eigen::Matrix3d::Zero();
    Eigen::Vector3d sums = Eigen::Vector3d::Zero();
    for (const auto& [p, rho] : returns_) {
      const Eigen::Vector3d u = p / rho;
      moments += u * u.transpose();
      sums += u / rho;
    }
    const Eigen::LDLT<Eigen::Matrix3d> solver(moments);
    if (solver.info() != Eigen::Success || solver.rcond() < 1e-12) return std::nullopt;
    const InversePlane plane{solver.solve(sums)};
    if (!(plane.n_per_m.dot(point_m_) > 0.0)) return std::nullopt;
    return plane;
  }

  bool lie_within(const InversePlane& plane, double distance_m) const {
    return std::all_of(returns_.begin(), returns_.end(), [&](const RangedReturn& r) {
      return std::abs(plane.distance_before_m(r.place_m)) <= distance_m;
    });
  }

 private:
  bool surround() const {
    bool west = false, east = false, south = false, north = false;
    for (const auto& [p, rho] : returns_) {
      const double a = point_m_.x() * p.y() - point_m_.y() * p.x();
      const double e = p.z() * point_m_.head<2>().squaredNorm() - point_m_.z() * p.head<2>().dot(point_m_.head<2>());
      west |= a <= 0.0;
      east |= a >= 0.0;
      south |= e < 0.0;
      north |= e > 0.0;
    }
    return west && east && south && north;
  }

  const Eigen::Vector3d& point_m_;
  std::vector<RangedReturn>& returns_;
};

/// The distance to the nearest return, if it is below `farthest_m` (< the point's range), else that; any distance below
/// `enough_m` will do.
double nearest_return_m(const PriorIndex::Impl& prior, const Eigen::Vector3d& point_m, double enough_m,
                        double farthest_m) {
  const double range_m = point_m.norm(), reach_m = farthest_m + kRangeError * (range_m + farthest_m);
  double nearest_m2 = farthest_m * farthest_m;
  const Direction axis = direction_of(point_m.x(), point_m.y(), point_m.z());
  Cone(std::asin(farthest_m / range_m)).for_each_cell(prior.grid, axis, [&](std::uint32_t cell, bool) {
    if (prior.least_m[cell] > range_m + reach_m || prior.greatest_m[cell] < range_m - reach_m) return true;
    for (std::uint32_t i = prior.first[cell]; i < prior.first[cell + 1]; ++i) {
      nearest_m2 = std::min(nearest_m2, (point_of(prior.returns[i]) - point_m).squaredNorm());
    }
    return nearest_m2 > enough_m * enough_m;
  });
  return std::sqrt(nearest_m2);
}

Answer weigh_one(const PriorIndex::Impl& prior, const Eigen::Vector3d& point_m, const Thresholds& thresholds,
                 const SurfaceTolerance& tolerance, Answer asked) {
  const double range_m = point_m.norm();
  const Limits facing = limits_of(tolerance, range_m, 1.0);
  if (!(range_m > facing.off_m)) return asked;
  thread_local std::vector<RangedReturn> memory;
  const Surroundings around(prior, point_m, thresholds.angle_rad, memory);
  if (const std::optional<InversePlane> plane = around.fit()) {
    const double cosine = std::min(1.0, plane->n_per_m.dot(point_m) / (plane->n_per_m.norm() * range_m));
    const Limits limits = limits_of(tolerance, range_m, cosine);
    if (around.lie_within(*plane, limits.off_m)) {
      const double before_m = plane->distance_before_m(point_m);
      if (std::abs(before_m) <= limits.on_m) return Answer::supported;
      if (before_m < 0.0) return Answer::occluded;
      return before_m >= limits.off_m ? Answer::free : Answer::ambiguous;
    }
  }
  const double nearest_m = nearest_return_m(prior, point_m, facing.on_m, facing.off_m);
  if (nearest_m <= facing.on_m) return Answer::supported;
  if (asked == Answer::supported || nearest_m < facing.off_m) return Answer::ambiguous;
  return asked;
}

}  // namespace

SurfaceTolerance tolerance_between(const ScanView& a, const ScanView& b, const CompareParameters& parameters) {
  const auto noise = [](const ScanView& view) { return view.sensor.range_noise_m.value_or(kFallbackNoise_m); };
  return {.roughness_m = parameters.support_distance_m,
          .range_noise_m = std::hypot(noise(a), noise(b)),
          .position_m = std::hypot(a.pose_uncertainty.position_m, b.pose_uncertainty.position_m),
          .angle_rad = std::hypot(a.pose_uncertainty.angle_rad, b.pose_uncertainty.angle_rad)};
}

void weigh(const PriorIndex& prior, const PointCloud& points, const Pose& prior_from_points,
           const Thresholds& thresholds, const SurfaceTolerance& tolerance, std::span<Answer> answers) {
  const PriorIndex::Impl& impl = prior.impl();
  for_each_point(points, prior_from_points, [&](std::size_t i, const Eigen::Vector3d& point_m) {
    answers[i] = weigh_one(impl, point_m, thresholds, tolerance, answers[i]);
  });
}

}  // namespace raywatch
