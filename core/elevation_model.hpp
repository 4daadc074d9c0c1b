#pragma once

#include <limits>
#include <span>
#include <vector>

#include "core/epoch_scans.hpp"
#include "core/grid_layout.hpp"

namespace raywatch {

/// So many standard errors on either side of a value hold it with 95 %.
constexpr double kTwoSided95 = 1.96;

/// What stands for the height of a cell.
enum class CellHeight : std::uint8_t {
  mean,    ///< of its quarters', each brought to the quarter's middle along the slope of the ground
  median,  ///< of the returns, brought to the middle of the cell: a truck or dust in less than half of the returns does
           ///< not count
};

struct ElevationParameters {
  CellHeight height = CellHeight::mean;
  /// A cell was seen when this many of its quarters hold returns, 1..4. Where fewer do, what the returns show may be a
  /// small part of the cell: the face below the edge of a bench, and nothing of the bench.
  std::uint32_t least_quarters = 4;
};

/// A cell of an elevation model.
struct ElevationCell {
  double height_m = std::numeric_limits<double>::quiet_NaN();  ///< of its middle; NaN: not seen
  double sigma_m = 0.0;   ///< standard error of the height: range noise, roughness, slope; without the poses
  double spread_m = 0.0;  ///< standard deviation of the returns around the ground's slope
  Eigen::Vector2d slope = Eigen::Vector2d::Zero();  ///< of the ground: dz/dx, dz/dy
  std::uint32_t count = 0;                          ///< returns
  /// The ground lies below: the lowest height at which the rays of a scan passed over the whole cell, with three
  /// standard deviations of that scan's pose; infinity when none did.
  double ceiling_m = std::numeric_limits<double>::infinity();

  bool seen() const { return height_m == height_m; }
};

/// A station's part in a model: what an error of its pose does to the heights.
struct ElevationStation {
  Eigen::Vector3d position_m;  ///< world
  PoseUncertainty uncertainty;
  std::vector<float> share;  ///< one a cell: of its returns
};

/// The ground of one epoch as a grid of heights (world).
struct ElevationModel {
  GridLayout layout;
  std::vector<ElevationCell> cells;
  std::vector<ElevationStation> stations;  ///< in the order in which they first appear among the scans
};

/// Grids the usable returns of an epoch. Heights come of least squares: a plane through the returns of a cell, or of it
/// and its eight neighbours where it has few itself, gives slope and spread.
///
/// Assumes that the ground is a height field where it is asked about; what stands on it (a truck) is part of it.
/// O(returns + cells); deterministic; in the caller's oneTBB arena. `scans` must not be empty.
ElevationModel make_elevation_model(const EpochScans& epoch, const GridLayout& layout,
                                    const ElevationParameters& parameters);

/// A cell of a DEM of difference (DoD).
struct DifferenceCell {
  double rise_m = std::numeric_limits<double>::quiet_NaN();  ///< vertical; NaN: not seen in both epochs
  double random_sigma_m = 0.0;                               ///< standard error without the poses
  /// What surely changed rises or falls more: 1.96 times the standard error with that of the poses.
  double lod95_m = 0.0;

  bool seen() const { return rise_m == rise_m; }
  bool changed() const { return seen() && std::abs(rise_m) > lod95_m; }
};

/// The later model minus the earlier one, which must have one layout. The level of detection is that of Lane, Westaway
/// and Hicks (2003) and Brasington et al. (2003), with a standard error of its own for each cell.
std::vector<DifferenceCell> difference_of(const ElevationModel& before, const ElevationModel& after);

/// How the height of a cell changes with an error of a station's pose: times a small translation (world) and a small
/// rotation (vector, world) about the station's position. A surface with the slope s moves up by (-s, 1) . motion.
struct HeightLeverage {
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();
  Eigen::Vector3d rotation_m = Eigen::Vector3d::Zero();

  HeightLeverage& operator+=(const HeightLeverage& other) {
    translation += other.translation;
    rotation_m += other.rotation_m;
    return *this;
  }
  HeightLeverage scaled(double by) const { return {by * translation, by * rotation_m}; }
  double variance(const PoseUncertainty& u) const {
    return translation.squaredNorm() * u.position_m * u.position_m +
           rotation_m.squaredNorm() * u.angle_rad * u.angle_rad;
  }
};
HeightLeverage leverage_of(const ElevationModel& model, std::size_t station, std::size_t cell);
/// The variance of a height that the poses of all stations of a model cause.
double pose_variance_m2(const ElevationModel& model, std::size_t cell);

}  // namespace raywatch
