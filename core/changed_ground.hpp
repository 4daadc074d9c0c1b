#pragma once

#include <cstdint>
#include <vector>

#include "core/pose_errors.hpp"

namespace raywatch {

/// How a cell counts for cut and fill.
struct ChangedCell {
  double rise_m = 0.0;   ///< without what the errors of the poses make of it
  std::int8_t sign = 0;  ///< it counts for fill (1), for cut (-1), or for neither
  bool surely = false;   ///< it rose or fell itself by more than can be noise; else only a cell beside it did
};

/// The ground that changed between two models of one layout, apart from what looks so because poses are off.
struct ChangedGround {
  std::vector<ChangedCell> cells;  ///< one a cell
  PoseErrors poses;                ///< as the unchanged cells show them
};

/// Cells that rise or fall by more than 1.96 standard errors surely changed; so may the eight around each, in which a
/// change tapers off: they count by the sign of the cells that surely changed beside them, not by that of their own
/// noise. What is left did not change, and tells how far the poses are off; with that taken out the cells are judged
/// again. Deterministic; in the caller's oneTBB arena.
ChangedGround changed_ground(const ElevationModel& before, const ElevationModel& after);

}  // namespace raywatch
