#pragma once

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>

namespace raywatch {

/// Sums over returns, relative to the middle of a cell, from which least squares follow.
struct CellMoments {
  double n = 0.0;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();    ///< x, y, z
  Eigen::Matrix2d plan = Eigen::Matrix2d::Zero();   ///< x x, x y; y x, y y
  Eigen::Vector2d mixed = Eigen::Vector2d::Zero();  ///< x z, y z
  double height2 = 0.0;                             ///< z z

  void add(const Eigen::Vector3d& p) {
    n += 1.0;
    sum += p;
    plan += p.head<2>() * p.head<2>().transpose();
    mixed += p.z() * p.head<2>();
    height2 += p.z() * p.z();
  }
  /// Adds the sums of another cell, whose middle lies at `offset_m` from that of this one.
  void add(const CellMoments& other, const Eigen::Vector2d& offset_m) {
    const Eigen::Vector2d s = other.sum.head<2>();
    n += other.n;
    sum += other.sum;
    sum.head<2>() += other.n * offset_m;
    plan +=
        other.plan + offset_m * s.transpose() + s * offset_m.transpose() + other.n * offset_m * offset_m.transpose();
    mixed += other.mixed + other.sum.z() * offset_m;
    height2 += other.height2;
  }
  Eigen::Vector3d mean() const { return sum / n; }
};

/// The returns in one quarter of a cell, relative to the middle of the cell.
struct QuarterSum {
  double n = 0.0;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
};

/// The returns of a cell; of each quarter, too, so that one with many returns does not outweigh the others.
struct CellSums {
  CellMoments moments;
  std::array<QuarterSum, 4> quarters;

  void add(const Eigen::Vector3d& p) {
    moments.add(p);
    QuarterSum& quarter = quarters[(p.x() < 0.0 ? 0u : 1u) + (p.y() < 0.0 ? 0u : 2u)];
    quarter.n += 1.0;
    quarter.sum += p;
  }
  void add(const CellSums& other) {
    moments.add(other.moments, Eigen::Vector2d::Zero());
    for (std::size_t q = 0; q < quarters.size(); ++q) {
      quarters[q].n += other.quarters[q].n;
      quarters[q].sum += other.quarters[q].sum;
    }
  }
};

/// The plane through returns, z = mean z + slope . (x, y - mean x, y), by least squares.
struct PlaneFit {
  Eigen::Vector2d slope = Eigen::Vector2d::Zero();
  Eigen::Matrix2d slope_covariance = Eigen::Matrix2d::Zero();
  double variance_m2 = 0.0;  ///< of the returns around it
};

/// The sum of the squared distances, along z, of returns from the plane with that slope through their mean.
inline double residual_m2(const CellMoments& moments, const Eigen::Vector2d& slope) {
  const Eigen::Vector3d mean = moments.mean();
  const Eigen::Matrix2d plan = moments.plan - moments.n * mean.head<2>() * mean.head<2>().transpose();
  const Eigen::Vector2d mixed = moments.mixed - moments.n * mean.z() * mean.head<2>();
  const double height2 = moments.height2 - moments.n * mean.z() * mean.z();
  return std::max(0.0, height2 - 2.0 * slope.dot(mixed) + slope.dot(plan * slope));
}

/// Whether returns spread far enough in both directions for the slope of a plane: by a part of `reach_m`.
inline bool spreads(const CellMoments& moments, double reach_m) {
  constexpr double kLeastSpread = 0.15;
  const Eigen::Vector2d mean = moments.mean().head<2>();
  const Eigen::Matrix2d covariance = moments.plan / moments.n - mean * mean.transpose();
  const double half_trace = 0.5 * covariance.trace();
  const double least = half_trace - std::sqrt(std::max(0.0, half_trace * half_trace - covariance.determinant()));
  return least > kLeastSpread * kLeastSpread * reach_m * reach_m;
}

/// Of at least four returns that spread.
inline PlaneFit fit_plane(const CellMoments& moments) {
  const Eigen::Vector3d mean = moments.mean();
  const Eigen::Matrix2d plan = moments.plan - moments.n * mean.head<2>() * mean.head<2>().transpose();
  const Eigen::Matrix2d inverse = plan.inverse();
  PlaneFit fit;
  fit.slope = inverse * (moments.mixed - moments.n * mean.z() * mean.head<2>());
  fit.variance_m2 = residual_m2(moments, fit.slope) / (moments.n - 3.0);
  fit.slope_covariance = fit.variance_m2 * inverse;
  return fit;
}

}  // namespace raywatch
