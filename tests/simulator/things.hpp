#pragma once

#include <cstdint>
#include <vector>

#include "tests/simulator/random.hpp"
#include "tests/simulator/shape.hpp"

/// Things that stand about in scenes, as shapes in a frame of their own: z upwards, the ground at z = 0, x forwards.
namespace raywatch::simulator {

using Shapes = std::vector<Shape>;

/// Where a thing stands and which way it looks.
struct Stand {
  Eigen::Vector3d foot_m = Eigen::Vector3d::Zero();
  double yaw_rad = 0.0;

  Pose pose() const { return {Eigen::Quaterniond(Eigen::AngleAxisd(yaw_rad, Eigen::Vector3d::UnitZ())), foot_m}; }
};

Shapes placed(const Shapes& thing, const Stand& stand);

/// A box on the ground.
Shapes box(const Eigen::Vector3d& size_m);
/// An upright cylinder on the ground.
struct PillarSize {
  double radius_m = 0.2;
  double height_m = 3.0;
};
Shapes pillar(const PillarSize& size);

/// A top on four legs. Its height is `size_m.z()`.
Shapes table(const Eigen::Vector3d& size_m);
Shapes chair();
/// Uprights and boards, open at the front.
Shapes shelf(const Eigen::Vector3d& size_m);
Shapes potted_plant(RandomSequence& random);

Shapes car(RandomSequence& random);
/// A haul truck, 9 m long.
Shapes truck();
/// Legs mid-stride, at a random phase.
Shapes person(RandomSequence& random);

/// Posts, two rails and upright bars along the x axis, from x = 0.
struct FenceSize {
  double length_m = 10.0;
  double height_m = 1.8;
};
Shapes fence(const FenceSize& size);

/// What of a tree stands still.
struct TreeSize {
  double height_m = 6.0;
  double crown_radius_m = 1.8;
  std::uint64_t seed = 0;  ///< where its leaves are
};
Shapes trunk(const TreeSize& size);
/// Its leaves at one moment: the crown leans with the wind, and each leaf flutters. Seed 0 is no wind.
Shapes leaves(const TreeSize& size, std::uint64_t wind_seed);

}  // namespace raywatch::simulator
