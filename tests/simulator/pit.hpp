#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "tests/simulator/height_field.hpp"
#include "tests/simulator/scene.hpp"

namespace raywatch::simulator {

/// An open pit in which the lowest bench is blasted, section by section, one a night. Night n is what the ground looks
/// like after n blasts: blast k leaves its muck pile in night k + 1, half of it is dug away in night k + 2, the rest in
/// night k + 3. The pit's floor lies around z = 0 at x < 0, its benches climb along x.
class Pit {
 public:
  explicit Pit(std::uint64_t seed);

  HeightField ground(std::uint32_t night) const;

  /// The part of the floor that no blast reaches.
  static constexpr double kFloorFrom_m = -95.0;
  static constexpr double kFloorTo_m = -28.0;
  static constexpr double kHalfWidth_m = 100.0;

 private:
  double height_m(const Eigen::Vector2d& place_m, std::uint32_t night) const;
  double toe_m(double y_m, std::uint32_t blasts) const;
  double floor_m(const Eigen::Vector2d& place_m) const;
  double pile_m(const Eigen::Vector2d& place_m, std::uint32_t blast, std::uint32_t night) const;
  double blasted_share(double y_m, std::uint32_t blast) const;
  double section_middle_m(std::uint32_t blast) const;

  std::uint64_t seed_;
  std::vector<double> sections_m_;  ///< the middles of the sections along y, in the order in which they are blasted
};

/// Ground that is there in some nights and free in others.
struct GroundState {
  std::uint64_t nights = 0;  ///< bit n: in night n this ground is there, seen or buried
  Eigen::AlignedBox3d box;
  double volume_m3 = 0.0;  ///< from it down to the next surface at which it is gone
};

/// The truth about changing ground: for each night the state of each cell, and what those states are.
struct GroundTruth {
  std::vector<std::shared_ptr<const CellStates>> cells;  ///< one per night
  std::vector<GroundState> states;                       ///< state id `first_id` + i
};

/// Compares every night with every other one. A cell of a night has the state of all nights at which its surface is not
/// free: ground that was dug away later, or is a pile that was not there earlier. Newly exposed ground was inside the
/// rock before, not free, and is therefore background. Cells in which the distance to another night's surface is more
/// than rounding but less than 0.3 m have `kNoSurface`. At most 64 nights of one layout.
GroundTruth compare_nights(const std::vector<std::shared_ptr<const HeightField>>& nights, StateId first_id);

}  // namespace raywatch::simulator
