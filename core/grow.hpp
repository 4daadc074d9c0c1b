#pragma once

#include <functional>

#include "core/seeds.hpp"

namespace raywatch {

/// Tells for each of the given points whether it may belong to a change: whether no scan shows that it was there.
using IsOpen = std::function<std::vector<std::uint8_t>(std::span<const std::uint32_t>)>;

/// Hysteresis: from points that surely changed a change grows over the points that lie beside it and may belong to it,
/// so that the foot of a thing and the side that was out of sight are not lost: no farther than `growth_distance_m`
/// from a seed, or from a candidate that no scan contradicts.
/// @param sources the place in the scan of each return of its index (`sources_of`).
/// @returns the seeds and the points that join, by index. Deterministic.
std::vector<ClassedPoint> grow(const ScanView& view, std::span<const std::uint32_t> sources,
                               std::span<const ClassedPoint> seeds, std::span<const Candidate> candidates,
                               const CompareParameters& parameters, const IsOpen& is_open);

}  // namespace raywatch
