#include "core/cluster_votes.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/cone.hpp"
#include "core/prior_index_impl.hpp"

namespace raywatch {
namespace {

constexpr double kFallbackSpacing_rad = 0.01;
constexpr double kFallbackNoise_m = 0.02;

Eigen::Vector2d spacing_of(const ScanView& view) {
  return view.sensor.angular_resolution_rad.value_or(Eigen::Vector2d::Constant(kFallbackSpacing_rad));
}

/// Calls visit(i) for the returns in the cells that a cone touches.
template <class Visit>
void for_each_return_near(const PriorIndex::Impl& index, const Eigen::Vector3d& direction, double angle_rad,
                          Visit visit) {
  const Direction axis = direction_of(direction.x(), direction.y(), direction.z());
  Cone(std::min(angle_rad, std::numbers::pi / 2)).for_each_cell(index.grid, axis, [&](std::uint32_t cell, bool) {
    for (std::uint32_t i = index.first[cell]; i < index.first[cell + 1]; ++i) visit(i);
    return true;
  });
}

Eigen::Vector3d place(const PriorIndex::Impl& index, std::uint32_t i) {
  return {index.x_m[i], index.y_m[i], index.z_m[i]};
}

/// How much farther apart the shots of `asked` are where a point stands than those of `view`; at least 1.
double coarsening(const ScanView& view, const Eigen::Vector3d& point_m, const ScanView& asked,
                  const Eigen::Vector3d& asked_m) {
  return std::max(1.0, spacing_of(asked).maxCoeff() * asked_m.norm() / (spacing_of(view).maxCoeff() * point_m.norm()));
}

double coherence(const ScanView& view, std::uint32_t point, double scale) {
  constexpr double kReach = 1.6;  // spacings: the eight neighbours on a grid of shots
  constexpr double kSlope = 1.5;  // of a surface against the sphere around the sensor
  constexpr double kNoise = 4.0;
  const Eigen::Vector2d spacing = scale * spacing_of(view);
  const double noise_m = kNoise * view.sensor.range_noise_m.value_or(kFallbackNoise_m);
  const Eigen::Vector3d p = view.points[point].cast<double>();
  const double range_m = p.norm();
  const Eigen::Vector3d east = p.cross(Eigen::Vector3d::UnitZ()).normalized();
  const Eigen::Vector3d north = east.cross(p).normalized();
  std::size_t all = 0, alike = 0;
  const PriorIndex::Impl& index = view.index.impl();
  for_each_return_near(index, p, kReach * spacing.maxCoeff(), [&](std::uint32_t i) {
    if (index.source[i] == point) return;
    const Eigen::Vector3d q = place(index, i);
    const double rho = q.norm();
    const double a = east.dot(q) / rho, e = north.dot(q) / rho;
    if (std::hypot(a / spacing.x(), e / spacing.y()) > kReach || q.dot(p) < 0.0) return;
    ++all;
    alike += std::abs(rho - range_m) <= noise_m + kSlope * std::hypot(a, e) * range_m;
  });
  return all == 0 ? 0.0 : static_cast<double>(alike) / static_cast<double>(all);
}

/// The thickness of the returns within `radius_m` of a place: the standard deviation across their plane.
double thickness_m(const PriorIndex::Impl& index, const Eigen::Vector3d& center_m, double radius_m) {
  if (!(center_m.norm() > radius_m)) return 0.0;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();
  std::size_t count = 0;
  for_each_return_near(index, center_m, std::asin(radius_m / center_m.norm()), [&](std::uint32_t i) {
    const Eigen::Vector3d offset_m = place(index, i) - center_m;
    if (offset_m.squaredNorm() >= radius_m * radius_m) return;
    sum += offset_m;
    squares += offset_m * offset_m.transpose();
    ++count;
  });
  if (count < 4) return 0.0;
  const Eigen::Vector3d mean = sum / static_cast<double>(count);
  const Eigen::Matrix3d covariance = squares / static_cast<double>(count) - mean * mean.transpose();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(covariance, Eigen::EigenvaluesOnly);
  return std::sqrt(std::max(0.0, axes.eigenvalues()[0]));
}

std::size_t rays_through(const ScanView& view, std::span<const std::uint32_t> members, const ScanView& asked,
                         const CompareParameters& parameters) {
  constexpr double kReach = 1.5;
  const Pose asked_from_view = asked.world_from_sensor.inverse() * view.world_from_sensor;
  PointCloud cluster;
  double ratio = 0.0;
  for (const std::uint32_t i : members) {
    const Eigen::Vector3d p = view.points[i].cast<double>();
    const Eigen::Vector3d q = asked_from_view * p;
    cluster.push_back(static_cast<float>(q.x()), static_cast<float>(q.y()), static_cast<float>(q.z()));
    ratio += p.norm() / std::max(q.norm(), 0.1) / static_cast<double>(members.size());
  }
  const double angle_rad =
      std::min(0.3, kReach * std::max(spacing_of(asked).maxCoeff(), ratio * spacing_of(view).maxCoeff()));
  const PriorIndex cluster_index = PriorIndex::build(cluster, {});
  const PriorIndex::Impl& inner = cluster_index.impl();
  const PriorIndex::Impl& outer = asked.index.impl();
  const double cosine = std::cos(angle_rad);
  std::vector<std::uint32_t> rays;
  for (std::size_t k = 0; k < cluster.size(); ++k) {
    const Eigen::Vector3d m = cluster[k].cast<double>();
    for_each_return_near(outer, m, angle_rad, [&](std::uint32_t i) {
      const Eigen::Vector3d q = place(outer, i);
      if (q.dot(m) >= cosine * q.norm() * m.norm()) rays.push_back(i);
    });
  }
  std::sort(rays.begin(), rays.end());
  rays.erase(std::unique(rays.begin(), rays.end()), rays.end());
  return static_cast<std::size_t>(std::count_if(rays.begin(), rays.end(), [&](std::uint32_t ray) {
    const Eigen::Vector3d q = place(outer, ray);
    const double rho = q.norm();
    const Eigen::Vector3d e = q.cross(Eigen::Vector3d::UnitZ()), n = e.cross(q);
    bool west = false, east = false, south = false, north = false, behind = true;
    for_each_return_near(inner, q, angle_rad, [&](std::uint32_t i) {
      const Eigen::Vector3d m = place(inner, i);
      const double range_m = m.norm();
      if (q.dot(m) < cosine * rho * range_m) return;
      behind &= rho >= range_m + parameters.range_m;
      const double a = e.dot(m), b = n.dot(m);
      west |= a <= 0.0;
      east |= a >= 0.0;
      south |= b <= 0.0;
      north |= b >= 0.0;
    });
    return behind && west && east && south && north;
  }));
}

}  // namespace

ClusterVotes votes_of(const ScanView& view, std::span<const std::uint32_t> members, const ScanView& asked,
                      const CompareParameters& parameters) {
  ClusterVotes votes{.rays_through = rays_through(view, members, asked, parameters)};
  const Pose asked_from_view = asked.world_from_sensor.inverse() * view.world_from_sensor;
  for (const std::uint32_t i : members) {
    const Eigen::Vector3d p = view.points[i].cast<double>(), q = asked_from_view * p;
    votes.coherence += coherence(view, i, coarsening(view, p, asked, q));
    votes.roughness_m += thickness_m(asked.index.impl(), q, parameters.growth_distance_m);
  }
  votes.coherence /= static_cast<double>(members.size());
  votes.roughness_m /= static_cast<double>(members.size());
  return votes;
}

}  // namespace raywatch
