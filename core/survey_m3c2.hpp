#pragma once

#include <span>
#include <vector>

#include "core/survey.hpp"

namespace raywatch {

/// The usable returns of an epoch in a box, in world coordinates.
PointCloud world_points_in(const EpochScans& epoch, const Eigen::AlignedBox3d& box_m);

/// How far a surface may seem displaced because of the poses of both epochs: of each the least certain pose, at the
/// distance of the farthest corner of the box, as a root of the sum of squares.
double registration_error_m(const EpochScans& before, const EpochScans& after, const Eigen::AlignedBox3d& box_m);

/// M3C2 at core points of the earlier epoch, for each zone and (last) for all core points that lie in any.
std::vector<M3c2Figures> m3c2_of_zones(const SurveyInput& input, std::span<const SurveyZone> zones,
                                       double registration_m);

}  // namespace raywatch
