#pragma once

#include <string>
#include <vector>

#include "tests/simulator/simulated_scan.hpp"
#include "tests/simulator/things.hpp"

namespace raywatch::simulator {

/// An object while it stays at one place.
struct ObjectState {
  StateId id = kBackground;
  std::string name;  ///< of the object; its other states have the same
  std::string kind;  ///< "box", "car", "person", "rock", ...
  std::vector<Shape> shapes;
  Eigen::AlignedBox3d box;  ///< in the world
  double volume_m3 = 0.0;
};

struct Tree {
  TreeSize size;
  Stand stand;
};

/// One scan to be taken, and what of the world is there at that time besides `Timeline::background`.
struct Moment {
  ScanPlan plan;
  std::size_t scanner = 0;          ///< its place in `Timeline::scanners`
  std::vector<StateId> present;     ///< objects, and states of `passing` terrain
  std::vector<Shape> passing = {};  ///< background of this moment only, such as the ground as it is now
  std::uint64_t wind_seed = 0;      ///< how the wind has moved the leaves; 0: not at all
};

/// The ground of each night on a grid, row by row from its lowest corner.
struct TrueGround {
  Eigen::Vector2d corner_m = Eigen::Vector2d::Zero();
  double cell_m = 1.0;
  std::uint32_t columns = 0, rows = 0;
  std::vector<std::vector<double>> mean_height_m;  ///< one a night: exact, over each cell
};

/// What happens at a place over time, as a list of scans to be taken, in order of time.
struct Timeline {
  std::vector<Scanner> scanners;
  std::vector<Shape> background;
  std::vector<Tree> trees;           ///< background too, but their leaves may move
  std::vector<ObjectState> objects;  ///< the state with id i stands at i - 1
  std::vector<Moment> moments;
  std::vector<VolumeChange> earthworks;  ///< from each night to the next, where the ground changes
  TrueGround ground;                     ///< where volumes are to be checked; else empty

  const ObjectState& object(StateId id) const { return objects.at(id - 1U); }
};

/// What an object is and where: its parts in the world, which may overlap.
struct NewObject {
  std::string name;
  std::string kind;
  std::vector<Shape> shapes;
};

/// Gives the object a state with box and volume. The volume of a single shape is exact, that of overlapping ones is
/// counted on a lattice, to about one percent.
StateId add_object(Timeline& timeline, const NewObject& object);

/// The background and the objects, without trees and what is only passing.
Scene lasting_scene(const Timeline& timeline, const std::vector<StateId>& present);

Scene scene_at(const Timeline& timeline, const Moment& moment);

SimulatedScan take_scan(const Timeline& timeline, const Moment& moment);

}  // namespace raywatch::simulator
