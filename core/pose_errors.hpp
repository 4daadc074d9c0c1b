#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "core/elevation_model.hpp"

namespace raywatch {

/// How far a sum of heights, each times an area, moves with each of the errors of the poses of both epochs: the later
/// ones raise it, the earlier ones lower it. In standard deviations of the poses as told, so that a pose that is taken
/// as exact has no part in it.
using PoseLeverage = Eigen::VectorXd;

/// What the ground that did not change tells of the errors of the poses of two epochs, relative to each other.
///
/// An error of a pose tilts and lifts all that was seen from a station in one and the same way. Cells that did not
/// change show it: with the errors p in standard deviations, p ~ N(0, 1) as told, a cell's rise is l . p + noise, where
/// l is its leverage; least squares give the mean and the covariance of p. A creep of the whole ground by less than the
/// poses may be off cannot be told from their errors, and is taken for them.
class PoseErrors {
 public:
  /// As told: no errors, as uncertain as the stations' poses.
  PoseErrors(const ElevationModel& before, const ElevationModel& after);

  /// Of one cell.
  PoseLeverage leverage_of(std::size_t cell) const;
  /// Of sums over cells: of each epoch one a station.
  PoseLeverage leverage_of(std::span<const HeightLeverage> before, std::span<const HeightLeverage> after) const;
  /// How much of a rise the errors make, of which that is the leverage.
  double rise(const PoseLeverage& leverage) const { return leverage.dot(mean_); }
  double variance(const PoseLeverage& leverage) const { return leverage.dot(covariance_ * leverage); }

  /// Learns from the cells that are seen and stable, at most some ten thousand of them, evenly chosen; forgets what was
  /// learned before, but judges by it which rises are outliers (Tukey).
  /// @param stable one a cell: not 0 when it surely did not change.
  void learn(std::span<const DifferenceCell> difference, std::span<const std::uint8_t> stable);

 private:
  void place(std::size_t epoch, std::size_t station, const HeightLeverage& sum, PoseLeverage& into) const;

  const ElevationModel* models_[2];
  Eigen::VectorXd mean_;
  Eigen::MatrixXd covariance_;
};

}  // namespace raywatch
