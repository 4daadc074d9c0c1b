#pragma once

#include <cstdint>
#include <memory>

#include "tests/simulator/height_field.hpp"

namespace raywatch::simulator {

/// Smooth noise in -1..1 with features of about one unit, from random values on a lattice.
double lattice_noise(const Eigen::Vector2d& place, std::uint64_t seed);

/// Nearly level ground: bumps of a few metres' width around z = 0.
struct BumpyGround {
  double half_size_m = 60.0;
  double bump_height_m = 0.03;
  std::uint64_t seed = 0;
};
std::shared_ptr<const HeightField> bumpy_ground(const BumpyGround& ground);

}  // namespace raywatch::simulator
