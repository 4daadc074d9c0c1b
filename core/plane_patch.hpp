#pragma once

#include <Eigen/Core>
#include <optional>

#include "core/compare.hpp"

namespace raywatch {

/// A flat piece of the surface that a scan shows in one direction, in that scan's sensor frame: the plane n . x = 1.
struct PlanePatch {
  Eigen::Vector3d n_per_m;        ///< points away from the sensor
  double sigma_m = 0.0;           ///< standard error of the plane where it was asked for, along its normal
  double normal_sigma_rad = 0.0;  ///< standard error of the direction of its normal

  /// The unit normal, towards the sensor.
  Eigen::Vector3d normal() const { return -n_per_m.normalized(); }
  /// How far a point lies before the plane; towards the sensor: positive.
  double distance_before_m(const Eigen::Vector3d& point_m) const {
    return (1.0 - n_per_m.dot(point_m)) / n_per_m.norm();
  }
  /// Where the ray through the point meets the plane.
  Eigen::Vector3d along_ray(const Eigen::Vector3d& point_m) const { return point_m / n_per_m.dot(point_m); }
};

/// Fits patches to a scan's returns around given directions. In directions u_i and ranges rho_i a plane is the linear
/// function n . u_i = 1 / rho_i, so that the fit is a least-squares problem of three unknowns at any incidence. The
/// patch is as wide as the noise demands for a normal that means something, and at least as wide as it takes to have
/// neighbours on every side. Refers to the scan's index, which must outlive it. Any number of threads may use it.
class PatchFitter {
 public:
  explicit PatchFitter(const ScanView& scan);

  /// The patch around the direction of a point in the scan's sensor frame; empty when the returns there do not surround
  /// the direction, lie on two lines, are not flat within the noise, or too few or too close together for a normal.
  std::optional<PlanePatch> operator()(const Eigen::Vector3d& point_m) const;

  double spacing_rad() const { return spacing_rad_; }  ///< of the scan's shots; the coarser of the two directions
  double noise_m() const { return noise_m_; }          ///< of its ranges

 private:
  struct Moments;
  double half_angle_rad(double range_m) const;
  Moments gather(const Eigen::Vector3d& point_m) const;

  const PriorIndex::Impl& index_;
  double spacing_rad_;
  double shot_sr_;  ///< solid angle that one shot stands for
  double noise_m_;
};

}  // namespace raywatch
