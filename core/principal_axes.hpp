#pragma once

#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <span>

namespace raywatch {

/// Where points lie on average, and how widely they spread about that place along which directions.
template <int N>
struct PrincipalAxes {
  using Vector = Eigen::Matrix<double, N, 1>;
  using Matrix = Eigen::Matrix<double, N, N>;

  Vector mean;
  Matrix directions;  ///< in columns, each of length 1, in the order of the variances
  Vector variances;   ///< along these, least first; never below 0

  /// How far points would reach along each direction that are spread as widely, but evenly.
  Vector widths() const { return (12.0 * variances).cwiseSqrt(); }
};

/// @param points at least one
template <int N>
PrincipalAxes<N> principal_axes_of(std::span<const Eigen::Matrix<double, N, 1>> points) {
  const auto count = static_cast<double>(points.size());
  PrincipalAxes<N> axes;
  axes.mean.setZero();
  for (const auto& p : points) axes.mean += p / count;
  typename PrincipalAxes<N>::Matrix covariance = PrincipalAxes<N>::Matrix::Zero();
  for (const auto& p : points) covariance += (p - axes.mean) * (p - axes.mean).transpose() / count;
  const Eigen::SelfAdjointEigenSolver<typename PrincipalAxes<N>::Matrix> solver(covariance);
  axes.directions = solver.eigenvectors();
  axes.variances = solver.eigenvalues().cwiseMax(0.0);
  return axes;
}

}  // namespace raywatch
