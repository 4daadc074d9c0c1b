#pragma once

#include <span>

#include "core/compare.hpp"

namespace raywatch {

/// Decides points that are ambiguous because their cone holds returns both nearer and farther, as before a cluttered
/// background, from the shots right beside them alone: free, when the shots of `asked` that are about one spacing away,
/// in azimuth and in elevation each for itself, surround the point and all went at least `range_m` farther.
/// `points` stand in a frame that `asked_from_points` leads out of; `answers` has one element a point.
void ask_footprints(const ScanView& asked, const PointCloud& points, const Pose& asked_from_points, double range_m,
                    std::span<Answer> answers);

/// At the border of what `asked` covers, such as below its lowest ring, shots on one side only pass a point closely: a
/// thing that ends just there looks as if they went through it. Beside what its own rig hides (`OwnReturns`), the noise
/// of a point can move it out of that shadow. Where the shots do not surround a point, or the rig is in the way within
/// `noise_m` of it, it is not free, but unseen. @param noise_m standard deviation of the points' ranges.
void withhold_at_borders(const ScanView& asked, const PointCloud& points, const Pose& asked_from_points, double noise_m,
                         std::span<Answer> answers);

}  // namespace raywatch
