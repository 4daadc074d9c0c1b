#pragma once

#include <optional>

#include "core/align.hpp"
#include "core/ids.hpp"
#include "core/pose.hpp"

namespace raywatch {

/// How the pose of a scan was refined. A scan of state `none` that was looked at is an anchor: it had nothing to be
/// aligned with, and later scans are aligned with it.
struct Registration {
  RegistrationState state = RegistrationState::none;
  Pose correction;  ///< corrected = correction * reported, in the coordinates of the reported pose
  std::optional<double> residual_m;
  std::optional<double> inliers;               ///< see `Alignment`
  std::optional<ScanId> against;               ///< of the anchors that it was aligned with, the one that overlaps most
  std::optional<PoseUncertainty> uncertainty;  ///< of the corrected pose; not given: not looked at yet
};

}  // namespace raywatch
