#pragma once

#include <Eigen/Core>
#include <cstddef>

#include "core/compare.hpp"

namespace raywatch::evaluation {

/// What a scan returned around the direction of a point.
struct Surroundings {
  std::size_t nearer = 0;   ///< returns before the point by more than the margin
  std::size_t farther = 0;  ///< returns behind it by more than the margin
  bool flat =
      false;  ///< the returns lie in a plane, to within 5 cm (root mean square) and much less than their spread in it
  double incidence_rad = 0.0;  ///< between the ray and the normal of that plane; 0..pi/2
};

/// Looks at the returns of `view` within 1.5 spacings of its shots around the direction of a world point.
/// @param margin_m how much nearer or farther a return must be to count as such.
Surroundings surroundings_of(const ScanView& view, const Eigen::Vector3d& world_m, double margin_m);

}  // namespace raywatch::evaluation
