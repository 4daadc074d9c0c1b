#pragma once

#include "core/asking.hpp"

namespace raywatch {

/// The points of the priors that changed, with what the other priors say of them.
struct PriorChanges {
  std::vector<PriorPoint> points;  ///< by prior, then index
  std::vector<PriorPointVotes> votes;
};

/// The other way of a comparison: looks for the priors' points that are free in the scan.
PriorChanges find_prior_changes(const ScanView& scan, std::span<const ScanView> priors, const Asking& asking);

}  // namespace raywatch
