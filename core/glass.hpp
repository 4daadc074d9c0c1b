#pragma once

#include "core/cluster_plane.hpp"

namespace raywatch {

/// Whether a flat cluster may be glass, or polished: in line with a surface that `asked` shows beside it, but
/// nowhere as obliquely as it would have met the cluster, while the scan itself met that less obliquely. Such a surface
/// returns only rays that meet it nearly upright; that others went through it does not tell that it was not there.
bool may_be_glass(const ClusterPlane& plane, const ScanView& asked);

}  // namespace raywatch
