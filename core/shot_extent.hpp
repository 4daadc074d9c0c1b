#pragma once

#include <cstdint>
#include <span>

#include "core/compare.hpp"

namespace raywatch {

/// How far a cluster reaches in the directions of its own scan, counted in shots along its principal axes: 3 by 2 for
/// three neighbouring shots in each of two rows, whichever way it leans.
struct ShotExtent {
  double length = 0.0;  ///< at least 1
  double width = 0.0;   ///< at least 1, and at most `length`
  double filled = 1.0;  ///< members per shot of length times width; low when most of the shots went past it

  /// Full of gaps, as what is left of a surface when other points of it were not free, and as a fence.
  bool has_gaps() const { return filled < 0.6; }
  /// A single line of shots: so an edge of a thing that stayed looks, when the other scan's rays passed beside it. No
  /// line surrounds a ray; one that leans a little only seems to.
  bool is_line() const { return width < 1.8; }
};

/// @param members points of `view`, at least one, none at its sensor.
ShotExtent extent_in_shots(const ScanView& view, std::span<const std::uint32_t> members);

}  // namespace raywatch
