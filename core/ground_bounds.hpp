#pragma once

#include <optional>
#include <vector>

#include "core/elevation_model.hpp"
#include "core/zone.hpp"

namespace raywatch {

/// The heights between which the mean height of a cell lies.
struct HeightBounds {
  double low_m;
  double high_m;
};

/// How steep ground is at most: rise over run. A surveyor who states it vouches for it, as for the zone's z_min.
struct GroundSteepness {
  std::optional<double> greatest_slope = {};  ///< nothing: a cell says nothing about its neighbours
};

/// Bounds of each cell of a model. Of a seen cell: its height with 1.96 standard errors, those of the poses included.
/// Of an unseen one: z_min of the prism, for no ray shows how deep the ground is where none ended, and what the rays
/// passed over. With a greatest slope s each cell also bounds those at a distance d: their ground lies within s d of
/// its own; nothing is interpolated. All inside the prism's heights. O(cells); deterministic.
/// @throws InvalidInput naming `greatest_slope` unless it is above 0.
std::vector<HeightBounds> ground_bounds(const ElevationModel& model, const Prism& prism,
                                        const GroundSteepness& steepness);

}  // namespace raywatch
