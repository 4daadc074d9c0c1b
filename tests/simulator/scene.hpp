#pragma once

#include <cstdint>
#include <set>
#include <vector>

#include "tests/simulator/shape.hpp"

namespace raywatch::simulator {

/// Names one state of one object: its shape at its place for as long as it stays there. An object that is moved has
/// another state; if it returns to exactly the same place, its former one.
using StateId = std::uint16_t;

/// What belongs to no object that ever changes.
inline constexpr StateId kBackground = 0;
/// A return that lies on no surface (a mixed return, the rig itself), a cell without a return, or a spot whose change
/// is too small to be called one. Never a change, and never counted.
inline constexpr StateId kNoSurface = 65535;

/// One shape of the world and the state that it belongs to.
struct Solid {
  Shape shape;
  StateId state = kBackground;
};

/// The world at one moment.
struct Scene {
  std::vector<Solid> solids;
  std::set<StateId> present;  ///< the states > 0 that exist now

  void add(const Shape& shape, StateId state = kBackground) {
    solids.push_back({shape, state});
    if (state != kBackground) present.insert(state);
  }
  void add(const std::vector<Shape>& shapes, StateId state = kBackground) {
    for (const Shape& shape : shapes) add(shape, state);
  }
};

}  // namespace raywatch::simulator
