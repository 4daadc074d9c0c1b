#pragma once

#include <optional>
#include <span>

#include "core/changed_ground.hpp"
#include "core/elevation_model.hpp"
#include "core/ground_bounds.hpp"
#include "core/zone.hpp"

namespace raywatch {

/// A volume with its interval of 95 %: value -+ 1.96 sigma.
struct VolumeFigure {
  double value_m3 = 0.0;
  double random_sigma_m3 = 0.0;  ///< range noise, roughness and sampling: independent from cell to cell
  double pose_sigma_m3 = 0.0;    ///< errors of the stations' poses: the same for all cells of a station

  double sigma_m3() const { return std::hypot(random_sigma_m3, pose_sigma_m3); }
  double low_m3() const { return value_m3 - 1.96 * sigma_m3(); }
  double high_m3() const { return value_m3 + 1.96 * sigma_m3(); }
};

/// What is certain of a volume.
struct VolumeBounds {
  double low_m3 = 0.0;
  double high_m3 = 0.0;

  VolumeBounds& operator+=(const VolumeBounds& other) {
    low_m3 += other.low_m3;
    high_m3 += other.high_m3;
    return *this;
  }
};

/// The greatest and the mean change of the cells that surely changed. Rising is positive.
struct ChangeExtent {
  double greatest_rise_m = 0.0;
  double greatest_fall_m = 0.0;  ///< 0 or less
  double mean_m = 0.0;
};

/// The volumes between two epochs in one zone.
struct ZoneVolumes {
  /// Over the cells that surely changed and their eight neighbours, in which a change tapers off below what can be told
  /// (`changed_ground`). They rest on the rest of the ground not having changed: what it shows of the errors of the
  /// poses is taken out, so that these intervals are much narrower than that of `net`.
  VolumeFigure cut, fill;
  VolumeFigure changed_net;  ///< fill - cut, with what their errors have in common
  /// Over all cells seen in both epochs, changed or not: free of the bias that a threshold brings (Anderson 2019), but
  /// an error of a pose counts over the whole area.
  VolumeFigure net;
  double area_m2 = 0.0;          ///< of the zone
  double seen_area_m2 = 0.0;     ///< of it, seen in both epochs
  double changed_area_m2 = 0.0;  ///< of the cells that surely changed
  ChangeExtent vertical;         ///< along the vertical
  ChangeExtent normal;           ///< along the normal of the ground before
  /// The net of what was not seen in both epochs: each epoch's ground lies below what its rays passed and the zone's
  /// z_max, and above the zone's z_min, which the surveyor vouches for: no ray shows how deep the ground is where none
  /// ended. Where one epoch saw a cell, its height counts there with its error. Nothing is interpolated; see
  /// `ground_bounds`, also for what a greatest slope of the ground adds.
  VolumeBounds unseen;
  /// The net of the whole zone: that of what was seen, with its interval, and the bounds of the rest.
  VolumeBounds whole() const { return {net.low_m3() + unseen.low_m3, net.high_m3() + unseen.high_m3}; }
  double seen_share() const { return area_m2 > 0.0 ? seen_area_m2 / area_m2 : 0.0; }
};

/// Cut, fill and net between two models of one layout inside a prism: heights outside of its z_min_m..z_max_m count as
/// there, a cell across a side of it with the share of its area that lies inside.
///
/// First-order propagation. With the area a_c of cell c inside, its rise d_c and its standard error s_c:
///   V = sum a_c d_c,   sigma_random^2 = sum (a_c s_c)^2,
///   sigma_pose^2 = sum over epochs and stations k of |sum a_c T_ck|^2 sigma_position,k^2
///                                                  + |sum a_c R_ck|^2 sigma_angle,k^2,
/// where T_ck and R_ck are the leverages of a station's pose (`leverage_of`): its error is the same for all of its
/// returns, so that it is summed before it is squared. After Anderson, "Uncertainty in quantitative analyses of
/// topographic change: error propagation and the role of thresholding", Earth Surface Processes and Landforms 44
/// (2019), with the systematic term by station instead of one constant for the whole map. For cut, fill and
/// `changed_net` the covariance of the poses is that which the unchanged ground leaves (`PoseErrors`).
/// @throws InvalidInput when the models differ in their layout, or as `ground_bounds` does.
ZoneVolumes volumes_between(const ElevationModel& before, const ElevationModel& after, const Prism& prism,
                            const GroundSteepness& steepness = {});

/// The same with what changed between the models, which of several zones is found once.
ZoneVolumes volumes_between(const ElevationModel& before, const ElevationModel& after, const ChangedGround& ground,
                            const Prism& prism, const GroundSteepness& steepness = {});

/// The net over given cells of the grid, such as the footprint of one change.
struct FootprintVolume {
  VolumeFigure net;
  double area_m2 = 0.0;
  double seen_area_m2 = 0.0;  ///< of it, seen in both epochs: `net` is of these
};
/// @param cells each at most once.
FootprintVolume volume_over(const ElevationModel& before, const ElevationModel& after,
                            std::span<const std::size_t> cells);

/// Mass in tonnes of a figure's value and the ends of its interval.
struct MassFigure {
  double value_t = 0.0, low_t = 0.0, high_t = 0.0;
};
/// @param density_t_per_m3 of the ground in place. @throws InvalidInput unless it is above 0.
MassFigure mass_of(const VolumeFigure& volume, double density_t_per_m3);

}  // namespace raywatch
