#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstdint>

#include "core/pose.hpp"

namespace raywatch {

using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;
/// Up to six directions of motion, one a column; bounded, so that neither memory nor kernels for large ones are needed.
using Motions = Eigen::Matrix<double, 6, Eigen::Dynamic, Eigen::ColMajor, 6, 6>;
/// A symmetric form on as many directions.
using MotionForm = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, 6, 6>;

/// How a piece of the scan's surface stands to what a reference shows there.
struct Row {
  enum class Kind : std::uint8_t { unseen, hidden, contradicts, comparable };
  Kind kind = Kind::unseen;
  double distance_m = 0.0;  ///< from the reference's surface, towards the reference's sensor
  double sigma_m = 1.0;     ///< of the distance
  Vector6 motion;           ///< change of the distance with a motion of the scan about its sensor: shift, turn
  Vector6 own_motion;       ///< the same by the scan's own normal, whose errors are others

  double deviations(double blur_m) const { return distance_m / sigma_with(blur_m); }
  double sigma_with(double blur_m) const { return std::hypot(sigma_m, blur_m); }
};

/// The evidence about the six directions of motion, turns scaled by the size of the scene so that all are lengths.
struct Information {
  Matrix6 normal = Matrix6::Zero();    ///< J^T W J
  Matrix6 unbiased = Matrix6::Zero();  ///< the same with two normals of independent errors, which leave no trace in it
  Vector6 gradient = Vector6::Zero();
  double weight = 0.0;

  /// @param row_weight in 1/m^2. @param scale of each direction of motion.
  void add(const Row& row, double row_weight, const Vector6& scale);

  /// A base of the motions that the scene fixes, one a column: those of which there is a share of the evidence that
  /// means something, and enough of it to be less uncertain than `most_sigma_m`.
  Motions fixed_motions(double most_sigma_m) const;

  /// What `uncertainty` is asked with.
  struct Fit {
    const Motions& fixed;  ///< see `fixed_motions`
    const Vector6& scale;
    double spread = 1.0;       ///< of the distances that are left, in deviations
    PoseUncertainty reported;  ///< of what is not fixed
  };
  /// From the distances that are left and how often they were measured; what is not fixed is as uncertain as before.
  PoseUncertainty uncertainty(const Fit& fit) const;
};

/// Of the directions that at least `enough` of the surfaces face, the one in which the smallest share of them agrees: a
/// floor that agrees does not outvote walls that do not. The matrices are sums of n n^T over the surfaces' normals.
/// 1 when no direction is faced by enough.
double least_agreement(const Eigen::Matrix3d& agreeing, const Eigen::Matrix3d& all, double enough);

}  // namespace raywatch
