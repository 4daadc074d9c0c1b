#pragma once

#include <Eigen/Geometry>
#include <memory>
#include <optional>
#include <variant>

#include "core/pose.hpp"
#include "tests/simulator/height_field.hpp"
#include "tests/simulator/ray.hpp"

namespace raywatch::simulator {

/// A solid box, centred in its own frame.
struct Box {
  Pose world_from_box;
  Eigen::Vector3d half_size_m;
};

/// The inside of a box: four walls, floor and ceiling. Seen from outside it is transparent.
struct Room {
  Pose world_from_room;
  Eigen::Vector3d half_size_m;
};

/// A solid cylinder with caps, centred in its own frame, its axis along z.
struct Cylinder {
  Pose world_from_cylinder;
  double radius_m;
  double half_height_m;
};

struct Sphere {
  Eigen::Vector3d center_m;
  double radius_m;
};

/// A flat round leaf, seen from both sides.
struct Disc {
  Eigen::Vector3d center_m;
  Eigen::Vector3d normal;  ///< of unit length
  double radius_m;
};

/// An infinite plane, seen from both sides.
struct Plane {
  Eigen::Vector3d point_m;
  Eigen::Vector3d normal;  ///< of unit length
};

/// The surface of a height field, which may be shared by many scenes.
struct Terrain {
  std::shared_ptr<const HeightField> field;
  std::shared_ptr<const CellStates> states;  ///< absent: the whole terrain has the state of its solid
};

using Shape = std::variant<Box, Room, Cylinder, Sphere, Disc, Plane, Terrain>;

/// The distance along the ray to the first point of the shape that lies in front of the ray's origin.
std::optional<double> intersect(const Ray& ray, const Shape& shape);

/// The smallest box around the shape; nothing for an infinite one.
std::optional<Eigen::AlignedBox3d> bounds(const Shape& shape);

/// The volume that a solid shape encloses; 0 for surfaces.
double volume_m3(const Shape& shape);

/// Whether a place lies inside a solid shape; never inside a surface.
bool encloses(const Shape& shape, const Eigen::Vector3d& place_m);

/// The shape moved by a rigid motion of the world. Planes and discs move too; terrain cannot.
Shape moved(const Shape& shape, const Pose& motion);

}  // namespace raywatch::simulator
