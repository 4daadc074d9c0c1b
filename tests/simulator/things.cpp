#include "tests/simulator/things.hpp"

#include <cmath>

namespace raywatch::simulator {
namespace {

/// A box between two corners.
Shape block(const Eigen::Vector3d& low_m, const Eigen::Vector3d& high_m) {
  return Box{{Eigen::Quaterniond::Identity(), 0.5 * (low_m + high_m)}, 0.5 * (high_m - low_m)};
}

/// A cylinder around the line between two points.
Shape rod(const Eigen::Vector3d& from_m, const Eigen::Vector3d& to_m, double radius_m) {
  const Eigen::Vector3d along = to_m - from_m;
  return Cylinder{{Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), along), 0.5 * (from_m + to_m)},
                  radius_m,
                  0.5 * along.norm()};
}

Eigen::Vector3d random_direction(RandomSequence& random) { return random.normal_vector().normalized(); }

void append_legs(Shapes& shapes, const Eigen::Vector2d& half_m, double height_m) {
  for (const double x : {-half_m.x(), half_m.x()}) {
    for (const double y : {-half_m.y(), half_m.y()}) shapes.push_back(rod({x, y, 0.0}, {x, y, height_m}, 0.025));
  }
}

void append_wheels(Shapes& shapes, const Eigen::Vector2d& half_m, double radius_m) {
  const double half_width_m = 0.33 * radius_m;
  for (const double x : {-half_m.x(), half_m.x()}) {
    for (const double y : {-half_m.y(), half_m.y()}) {
      shapes.push_back(rod({x, y - half_width_m, radius_m}, {x, y + half_width_m, radius_m}, radius_m));
    }
  }
}

}  // namespace

Shapes placed(const Shapes& thing, const Stand& stand) {
  const Pose pose = stand.pose();
  Shapes shapes;
  for (const Shape& shape : thing) shapes.push_back(moved(shape, pose));
  return shapes;
}

Shapes box(const Eigen::Vector3d& size_m) {
  const Eigen::Vector3d half_m(0.5 * size_m.x(), 0.5 * size_m.y(), 0.0);
  return {block(-half_m, half_m + Eigen::Vector3d(0.0, 0.0, size_m.z()))};
}

Shapes pillar(const PillarSize& size) { return {rod({0, 0, 0}, {0, 0, size.height_m}, size.radius_m)}; }

Shapes table(const Eigen::Vector3d& size_m) {
  const Eigen::Vector2d half_m = 0.5 * size_m.head<2>();
  Shapes shapes{block({-half_m.x(), -half_m.y(), size_m.z() - 0.03}, {half_m.x(), half_m.y(), size_m.z()})};
  append_legs(shapes, half_m - Eigen::Vector2d::Constant(0.05), size_m.z() - 0.03);
  return shapes;
}

Shapes chair() {
  Shapes shapes{block({-0.22, -0.22, 0.43}, {0.22, 0.22, 0.47}), block({-0.22, -0.22, 0.47}, {-0.18, 0.22, 0.9})};
  append_legs(shapes, Eigen::Vector2d::Constant(0.19), 0.43);
  return shapes;
}

Shapes shelf(const Eigen::Vector3d& size_m) {
  const Eigen::Vector3d half_m = 0.5 * size_m;
  Shapes shapes{block({-half_m.x(), -half_m.y(), 0}, {-half_m.x() + 0.02, half_m.y(), size_m.z()})};
  for (const double y : {-half_m.y(), half_m.y() - 0.02}) {
    shapes.push_back(block({-half_m.x(), y, 0}, {half_m.x(), y + 0.02, size_m.z()}));
  }
  constexpr int kBoards = 5;
  for (int i = 0; i < kBoards; ++i) {
    const double z = 0.05 + (size_m.z() - 0.08) * i / (kBoards - 1);
    shapes.push_back(block({-half_m.x(), -half_m.y(), z}, {half_m.x(), half_m.y(), z + 0.025}));
  }
  return shapes;
}

Shapes potted_plant(RandomSequence& random) {
  Shapes shapes{rod({0, 0, 0}, {0, 0, 0.35}, 0.18), rod({0, 0, 0.35}, {0, 0, 0.8}, 0.02)};
  for (int i = 0; i < 60; ++i) {
    const double distance_m = 0.35 * std::cbrt(random.in({0.0, 1.0}));
    const Eigen::Vector3d center_m = Eigen::Vector3d(0, 0, 0.95) + distance_m * random_direction(random);
    const Eigen::Vector3d normal = random_direction(random);
    shapes.push_back(Disc{center_m, normal, random.in({0.03, 0.08})});
  }
  return shapes;
}

Shapes car(RandomSequence& random) {
  const double length_m = random.in({3.8, 4.8});
  const double width_m = random.in({1.65, 1.85});
  const double bonnet_m = random.in({0.85, 1.0});
  const double roof_m = random.in({1.4, 1.65});
  const double x = 0.5 * length_m;
  const double y = 0.5 * width_m;
  Shapes shapes{block({-x, -y, 0.25}, {x, y, bonnet_m}),
                block({-0.85 * x, -y + 0.12, bonnet_m}, {0.35 * x, y - 0.12, roof_m})};
  append_wheels(shapes, {0.62 * x, y - 0.11}, 0.32);
  return shapes;
}

Shapes truck() {
  Shapes shapes{block({-4.5, -2.2, 1.2}, {4.5, 2.2, 2.4}), block({-4.5, -2.6, 2.4}, {1.6, 2.6, 4.4}),
                block({2.2, -1.6, 2.4}, {4.2, 1.6, 4.0})};
  append_wheels(shapes, {2.9, 2.0}, 1.1);
  return shapes;
}

Shapes person(RandomSequence& random) {
  const double stride_m = random.in({-0.3, 0.3});
  const double hip_m = 0.88;
  const double shoulder_m = 1.45;
  return {rod({stride_m, 0.1, 0.0}, {0.0, 0.1, hip_m}, 0.08),
          rod({-stride_m, -0.1, 0.0}, {0.0, -0.1, hip_m}, 0.08),
          rod({0.0, 0.0, hip_m - 0.05}, {0.0, 0.0, shoulder_m}, 0.18),
          rod({-0.7 * stride_m, 0.24, 0.8}, {0.0, 0.22, shoulder_m - 0.05}, 0.05),
          rod({0.7 * stride_m, -0.24, 0.8}, {0.0, -0.22, shoulder_m - 0.05}, 0.05),
          Sphere{{0.0, 0.0, 1.62}, 0.12}};
}

Shapes fence(const FenceSize& size) {
  Shapes shapes;
  for (const double z : {0.15, size.height_m - 0.1}) shapes.push_back(rod({0, 0, z}, {size.length_m, 0, z}, 0.015));
  constexpr double kBarSpacing_m = 0.15;
  constexpr int kBarsPerPost = 16;
  const int bars = static_cast<int>(size.length_m / kBarSpacing_m);
  for (int i = 0; i <= bars; ++i) {
    const double x = kBarSpacing_m * i;
    const bool is_post = i % kBarsPerPost == 0;
    shapes.push_back(rod({x, 0, is_post ? 0.0 : 0.1}, {x, 0, size.height_m}, is_post ? 0.04 : 0.008));
  }
  return shapes;
}

Shapes trunk(const TreeSize& size) {
  const double fork_m = size.height_m - 1.4 * size.crown_radius_m;
  Shapes shapes{rod({0, 0, 0}, {0, 0, fork_m}, 0.03 * size.height_m)};
  RandomSequence random(size.seed);
  for (int i = 0; i < 6; ++i) {
    const Eigen::Vector3d direction = (random_direction(random) + Eigen::Vector3d(0, 0, 1.2)).normalized();
    const Eigen::Vector3d fork{0, 0, fork_m - 0.1};
    shapes.push_back(rod(fork, fork + size.crown_radius_m * direction, 0.03));
  }
  return shapes;
}

Shapes leaves(const TreeSize& size, std::uint64_t wind_seed) {
  constexpr double kLean_m = 0.08;
  constexpr double kFlutter_m = 0.02;
  constexpr double kLeavesPerSquareMetre = 90.0;
  const double wind = wind_seed == 0 ? 0.0 : 1.0;
  RandomSequence still(scrambled(size.seed) ^ 1);
  RandomSequence moving(wind_seed, Purpose::sway);
  const Eigen::Vector3d lean_m = wind * kLean_m * moving.normal_vector().cwiseProduct(Eigen::Vector3d(1.0, 1.0, 0.0));
  const Eigen::Vector3d center_m(0, 0, size.height_m - size.crown_radius_m);
  const auto count = static_cast<int>(kLeavesPerSquareMetre * size.crown_radius_m * size.crown_radius_m);
  Shapes shapes;
  for (int i = 0; i < count; ++i) {
    const double distance_m = size.crown_radius_m * std::cbrt(still.in({0.1, 1.0}));
    const Eigen::Vector3d offset_m = distance_m * random_direction(still);
    const Eigen::Vector3d flutter_m = wind * kFlutter_m * moving.normal_vector();
    const Eigen::Vector3d turned = random_direction(still) + 0.3 * wind * random_direction(moving);
    shapes.push_back(Disc{center_m + offset_m + lean_m + flutter_m, turned.normalized(), still.in({0.06, 0.14})});
  }
  return shapes;
}

}  // namespace raywatch::simulator
