#include <Eigen/Cholesky>
#include <cmath>
#include <optional>

#include "core/cone.hpp"
#include "core/for_each_point.hpp"
#include "core/prior_index_impl.hpp"

namespace raywatch {
namespace {

/// A plane n . x = 1 that stands before the sensor in its origin; n in 1/m.
struct InversePlane {
  Eigen::Vector3d n_per_m;

  /// How far a point lies before the plane (towards the sensor: positive).
  double distance_before_m(const Eigen::Vector3d& point_m) const {
    return (1.0 - n_per_m.dot(point_m)) / n_per_m.norm();
  }
};

/// Fits the plane to the returns in a cone. In directions u_i and inverse ranges, a plane is the linear function
/// n . u_i = 1 / rho_i, so that the fit is a linear least-squares problem of three unknowns, for any incidence.
class SurfaceFit {
 public:
  SurfaceFit(const PriorIndex::Impl& prior, const Eigen::Vector3d& point_m, double angle_rad)
      : prior_(prior), point_m_(point_m), cosine_(std::cos(angle_rad)), range_m_(point_m.norm()), cone_(angle_rad) {}

  /// The plane through the returns around the point, if they surround it and none is farther from it than `flatness_m`.
  std::optional<InversePlane> operator()(double flatness_m) const {
    Eigen::Matrix3d moments = Eigen::Matrix3d::Zero();
    Eigen::Vector3d sums = Eigen::Vector3d::Zero();
    std::size_t count = 0;
    bool west = false, east = false, south = false, north = false;
    for_each_return([&](const Eigen::Vector3d& p, double rho) {
      const Eigen::Vector3d u = p / rho;
      moments += u * u.transpose();
      sums += u / rho;
      ++count;
      const double a = point_m_.x() * p.y() - point_m_.y() * p.x();
      const double e = p.z() * point_m_.head<2>().squaredNorm() - point_m_.z() * p.head<2>().dot(point_m_.head<2>());
      west |= a <= 0.0;
      east |= a >= 0.0;
      south |= e < 0.0;
      north |= e > 0.0;
      return true;
    });
    constexpr std::size_t kLeastReturns = 5;
    if (count < kLeastReturns || !(west && east && south && north)) return std::nullopt;
    const Eigen::LDLT<Eigen::Matrix3d> solver(moments);
    if (solver.info() != Eigen::Success || solver.rcond() < 1e-12) return std::nullopt;
    const InversePlane plane{solver.solve(sums)};
    if (!(plane.n_per_m.dot(point_m_) > 0.0)) return std::nullopt;
    bool flat = true;
    for_each_return([&](const Eigen::Vector3d& p, double) {
      flat = std::abs(plane.distance_before_m(p)) <= flatness_m;
      return flat;
    });
    if (!flat) return std::nullopt;
    return plane;
  }

 private:
  template <class Visit>
  void for_each_return(Visit visit) const {
    const Direction axis = direction_of(point_m_.x(), point_m_.y(), point_m_.z());
    cone_.for_each_cell(prior_.grid, axis, [&](std::uint32_t cell, bool inside) {
      for (std::uint32_t i = prior_.first[cell]; i < prior_.first[cell + 1]; ++i) {
        const Eigen::Vector3d p(prior_.returns[i].x_m, prior_.returns[i].y_m, prior_.returns[i].z_m);
        const double rho = p.norm();
        if (!inside && p.dot(point_m_) < cosine_ * rho * range_m_) continue;
        if (!visit(p, rho)) return false;
      }
      return true;
    });
  }

  const PriorIndex::Impl& prior_;
  const Eigen::Vector3d& point_m_;
  double cosine_;
  double range_m_;
  Cone cone_;
};

Answer judge(const PriorIndex::Impl& prior, const Eigen::Vector3d& point_m, const Thresholds& thresholds,
             double support_distance_m, Answer answer) {
  const std::optional<InversePlane> plane = SurfaceFit(prior, point_m, thresholds.angle_rad)(support_distance_m);
  if (!plane) return answer;
  const double before_m = plane->distance_before_m(point_m);
  if (std::abs(before_m) < support_distance_m) return Answer::supported;
  if (before_m < 0.0) return Answer::occluded;
  const double surface_range_m = point_m.norm() / plane->n_per_m.dot(point_m);
  return surface_range_m - point_m.norm() >= thresholds.range_m ? Answer::free : Answer::supported;
}

}  // namespace

void judge_by_surface(const PriorIndex& prior, const PointCloud& points, const Pose& prior_from_points,
                      const Thresholds& thresholds, double support_distance_m, std::span<Answer> answers) {
  const PriorIndex::Impl& impl = prior.impl();
  for_each_point(points, prior_from_points, [&](std::size_t i, const Eigen::Vector3d& point_m) {
    answers[i] = judge(impl, point_m, thresholds, support_distance_m, answers[i]);
  });
}

}  // namespace raywatch
