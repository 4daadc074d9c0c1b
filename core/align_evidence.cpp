#include "core/align_evidence.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>

namespace raywatch {
namespace {

/// A motion of which the evidence has less than this share is not fixed by the scene.
constexpr double kLeastInformation = 5e-4;
/// Neighbouring pieces share returns, and errors of a scanner are alike in one region: so many count as one.
constexpr double kAlikePieces = 4.0;

}  // namespace

void Information::add(const Row& row, double row_weight, const Vector6& scale) {
  const Vector6 j = row.motion.cwiseProduct(scale), own = row.own_motion.cwiseProduct(scale);
  normal += row_weight * j * j.transpose();
  unbiased += 0.5 * row_weight * (j * own.transpose() + own * j.transpose());
  gradient += row_weight * row.distance_m * j;
  weight += row_weight;
}

Motions Information::fixed_motions(double most_sigma_m) const {
  const double least = std::max(kLeastInformation * weight, kAlikePieces / (most_sigma_m * most_sigma_m));
  const Eigen::SelfAdjointEigenSolver<Matrix6> solver(unbiased);
  Eigen::Index first = 0;
  while (first < 6 && solver.eigenvalues()[first] < least) ++first;
  return solver.eigenvectors().rightCols(6 - first);
}

PoseUncertainty Information::uncertainty(const Fit& fit) const {
  Matrix6 covariance = Matrix6::Zero();
  if (fit.fixed.cols() > 0) {
    const MotionForm fixed_normal = fit.fixed.transpose() * normal * fit.fixed;
    covariance = kAlikePieces * fit.spread * fit.spread * fit.fixed * fixed_normal.inverse() * fit.fixed.transpose();
  }
  covariance = fit.scale.asDiagonal() * covariance * fit.scale.asDiagonal();
  const Matrix6 known = fit.fixed * fit.fixed.transpose();
  for (Eigen::Index i = 0; i < 6; ++i) {
    const double sigma = i < 3 ? fit.reported.position_m : fit.reported.angle_rad;
    covariance(i, i) += std::max(0.0, 1.0 - known(i, i)) * sigma * sigma;
  }
  return {std::sqrt(covariance.diagonal().head<3>().maxCoeff()), std::sqrt(covariance.diagonal().tail<3>().maxCoeff())};
}

double least_agreement(const Eigen::Matrix3d& agreeing, const Eigen::Matrix3d& all, double enough) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> base(all);
  Eigen::Index first = 0;
  while (first < 3 && base.eigenvalues()[first] < enough) ++first;
  if (first == 3) return 1.0;
  using Directions = Eigen::Matrix<double, 3, Eigen::Dynamic, Eigen::ColMajor, 3, 3>;
  using Form = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, 3, 3>;
  const Directions faced = base.eigenvectors().rightCols(3 - first);
  const Form whole = faced.transpose() * all * faced, part = faced.transpose() * agreeing * faced;
  const Eigen::GeneralizedSelfAdjointEigenSolver<Form> solver(part, whole, Eigen::EigenvaluesOnly);
  return solver.info() == Eigen::Success ? std::clamp(solver.eigenvalues()[0], 0.0, 1.0) : 0.0;
}

}  // namespace raywatch
