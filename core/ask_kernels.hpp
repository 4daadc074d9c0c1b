#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "core/cone.hpp"
#include "core/index_kernels.hpp"
#include "core/prior_index_impl.hpp"

namespace raywatch {

/// A rigid motion as vector code reads it: y = rotation x + translation, rows of the rotation one after the other.
struct RigidMotion {
  explicit RigidMotion(const Pose& to_from);
  std::array<double, 3> apply(double x, double y, double z) const {
    std::array<double, 3> moved;
    for (std::size_t r = 0; r < 3; ++r) {
      moved[r] = rotation[3 * r] * x + rotation[3 * r + 1] * y + rotation[3 * r + 2] * z + translation_m[r];
    }
    return moved;
  }
  double rotation[9];
  double translation_m[3];
};

/// One prior with the thresholds of a question, prepared for many points. Refers to the index, which must not be empty.
struct PreparedPrior {
  PreparedPrior(const PriorIndex::Impl& index, const Thresholds& thresholds);

  const PriorIndex::Impl& index;
  Thresholds thresholds;
  Cone cone;
  bool own_cell_is_inside;  ///< the cell of a point's direction lies inside of its cone, wherever in the cell that is
  bool cells_above_and_below_are_inside;  ///< the same of those one row up and down
};

/// Answers for points whose `valid` is not 0; unseen for all others. Thread-safe.
///
/// Three passes, each for what the one before leaves open: the bounds of the cell in a point's own direction; the
/// bounds of all cells that its cone touches, for one vector of points at a time; single returns, in double precision.
/// The first two only decide what no rounding can change.
void ask_block(const PreparedPrior& prior, const PointPlanes& points, const std::uint8_t* valid,
               const RigidMotion& prior_from_points, Answer* answers);

/// The same when only whether the answer is free matters: 1 if it is, else 0. Much faster where the prior stood
/// elsewhere, as one nearer return settles a point that is hidden.
void find_free_in_block(const PreparedPrior& prior, const PointPlanes& points, const std::uint8_t* valid,
                        const RigidMotion& prior_from_points, std::uint8_t* free);

}  // namespace raywatch
