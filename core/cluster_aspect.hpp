#pragma once

#include <cstdint>
#include <span>

#include "core/cluster_votes.hpp"

namespace raywatch {

/// How a scan that is asked about a cluster of another scan's points meets it.
struct ClusterAspect {
  bool is_flat = false;    ///< the cluster is a part of a flat surface, as far as its own scan shows that around it
  double facing = 1.0;     ///< the cosine of the incidence on that surface, or on the plane through what is not flat
  double depth_m = 0.0;    ///< how far the cluster reaches along the rays
  double breadth_m = 0.0;  ///< how far it reaches across the rays, in the direction in which that is least
  double spacing_m = 0.0;  ///< between the shots of the asked scan at that distance

  /// How much of the cluster's depth the asked scan can see, if it is flat: nothing when it is met edge-on.
  double foreshortened_m() const { return depth_m * facing; }
};

/// The surface is that of all returns within 10 cm of the cluster, those that were not free among them: the few points
/// of a cluster alone do not tell how it leans.
/// @param members points of `view`, at least one.
ClusterAspect aspect_of(const ScanView& view, std::span<const std::uint32_t> members, const ScanView& asked);

/// By how much the log-odds of a change fall because the rays of the asked scan may have gone past the cluster, where
/// they seem to have gone through; infinite when they tell nothing.
double doubt_of(const ClusterAspect& aspect, const ClusterVotes& votes, const ClusterLook& look,
                const CompareParameters& parameters);

}  // namespace raywatch
