#include "tests/simulator/shape.hpp"

#include <cmath>
#include <limits>
#include <numbers>

namespace raywatch::simulator {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Where a line is inside something convex: from..to along the ray, empty when from > to.
struct Span {
  double from = -kInfinity;
  double to = kInfinity;

  bool empty() const { return from > to; }
  void narrow(const Span& other) {
    from = std::max(from, other.from);
    to = std::min(to, other.to);
  }
};

constexpr Span kNowhere{kInfinity, -kInfinity};

/// The first border of the span in front of the origin.
std::optional<double> first_border(const Span& span) {
  if (span.empty()) return std::nullopt;
  if (span.from > kNearestHit_m) return span.from;
  if (span.to > kNearestHit_m) return span.to;
  return std::nullopt;
}

Ray in_frame(const Ray& ray, const Pose& world_from_local) {
  const Eigen::Quaterniond local_from_world = world_from_local.orientation.conjugate();
  return {local_from_world * (ray.origin_m - world_from_local.position_m), local_from_world * ray.direction};
}

/// Between two parallel planes at -half and +half of one axis.
Span slab(double origin, double direction, double half) {
  if (direction == 0.0) return std::abs(origin) <= half ? Span{} : kNowhere;
  const double a = (-half - origin) / direction;
  const double b = (half - origin) / direction;
  return {std::min(a, b), std::max(a, b)};
}

Span box_span(const Ray& local, const Eigen::Vector3d& half_size_m) {
  Span span;
  for (int axis = 0; axis < 3; ++axis) {
    span.narrow(slab(local.origin_m[axis], local.direction[axis], half_size_m[axis]));
  }
  return span;
}

/// Inside a circle or sphere around the origin, in two or three dimensions.
template <class Vector>
Span round_span(const Vector& origin, const Vector& direction, double radius) {
  const double length_squared = direction.squaredNorm();
  if (length_squared == 0.0) return origin.squaredNorm() <= radius * radius ? Span{} : kNowhere;
  // Measured from the point of closest approach, which keeps the digits when the origin is far away.
  const double middle = -origin.dot(direction) / length_squared;
  const double miss_squared = (origin + middle * direction).squaredNorm();
  const double inside_squared = radius * radius - miss_squared;
  if (inside_squared < 0.0) return kNowhere;
  const double half = std::sqrt(inside_squared / length_squared);
  return {middle - half, middle + half};
}

struct Intersect {
  const Ray& ray;

  std::optional<double> operator()(const Box& box) const {
    return first_border(box_span(in_frame(ray, box.world_from_box), box.half_size_m));
  }
  std::optional<double> operator()(const Room& room) const {
    const Span span = box_span(in_frame(ray, room.world_from_room), room.half_size_m);
    if (span.empty() || span.to <= kNearestHit_m) return std::nullopt;
    return span.to;
  }
  std::optional<double> operator()(const Cylinder& cylinder) const {
    const Ray local = in_frame(ray, cylinder.world_from_cylinder);
    const Eigen::Vector2d origin = local.origin_m.head<2>();
    const Eigen::Vector2d direction = local.direction.head<2>();
    Span span = round_span(origin, direction, cylinder.radius_m);
    span.narrow(slab(local.origin_m.z(), local.direction.z(), cylinder.half_height_m));
    return first_border(span);
  }
  std::optional<double> operator()(const Sphere& sphere) const {
    const Eigen::Vector3d origin = ray.origin_m - sphere.center_m;
    return first_border(round_span(origin, ray.direction, sphere.radius_m));
  }
  std::optional<double> operator()(const Disc& disc) const {
    const auto range_m = (*this)(Plane{disc.center_m, disc.normal});
    if (!range_m || (ray.at(*range_m) - disc.center_m).squaredNorm() > disc.radius_m * disc.radius_m) {
      return std::nullopt;
    }
    return range_m;
  }
  std::optional<double> operator()(const Plane& plane) const {
    const double approach = plane.normal.dot(ray.direction);
    if (approach == 0.0) return std::nullopt;
    const double range_m = plane.normal.dot(plane.point_m - ray.origin_m) / approach;
    return range_m > kNearestHit_m ? std::optional(range_m) : std::nullopt;
  }
  std::optional<double> operator()(const Terrain& terrain) const { return terrain.field->intersect(ray); }
};

/// Around an oriented box.
Eigen::AlignedBox3d box_bounds(const Pose& pose, const Eigen::Vector3d& half_size_m) {
  const Eigen::Vector3d reach_m = pose.orientation.toRotationMatrix().cwiseAbs() * half_size_m;
  return {pose.position_m - reach_m, pose.position_m + reach_m};
}

struct Bounds {
  using Result = std::optional<Eigen::AlignedBox3d>;

  Result operator()(const Box& box) const { return box_bounds(box.world_from_box, box.half_size_m); }
  Result operator()(const Room& room) const { return box_bounds(room.world_from_room, room.half_size_m); }
  Result operator()(const Cylinder& cylinder) const {
    // A disc of radius r with unit normal n reaches r * sqrt(1 - n_i^2) along axis i.
    const Pose& pose = cylinder.world_from_cylinder;
    const Eigen::Vector3d axis = pose.orientation * Eigen::Vector3d::UnitZ();
    const Eigen::Vector3d reach_m =
        cylinder.half_height_m * axis.cwiseAbs() +
        cylinder.radius_m * (Eigen::Vector3d::Ones() - axis.cwiseAbs2()).cwiseMax(0.0).cwiseSqrt();
    return Eigen::AlignedBox3d(pose.position_m - reach_m, pose.position_m + reach_m);
  }
  Result operator()(const Sphere& sphere) const {
    const Eigen::Vector3d reach_m = Eigen::Vector3d::Constant(sphere.radius_m);
    return Eigen::AlignedBox3d(sphere.center_m - reach_m, sphere.center_m + reach_m);
  }
  Result operator()(const Disc& disc) const {
    const Eigen::Vector3d reach_m =
        disc.radius_m * (Eigen::Vector3d::Ones() - disc.normal.cwiseAbs2()).cwiseMax(0.0).cwiseSqrt();
    return Eigen::AlignedBox3d(disc.center_m - reach_m, disc.center_m + reach_m);
  }
  Result operator()(const Plane&) const { return std::nullopt; }
  Result operator()(const Terrain& terrain) const {
    const HeightField& field = *terrain.field;
    const FieldLayout& layout = field.layout();
    const Eigen::Vector2d last_m = layout.node_m(layout.columns - 1, layout.rows - 1);
    return Eigen::AlignedBox3d(Eigen::Vector3d(layout.origin_m.x(), layout.origin_m.y(), field.lowest_m()),
                               Eigen::Vector3d(last_m.x(), last_m.y(), field.highest_m()));
  }
};

struct Volume {
  double operator()(const Box& box) const { return 8.0 * box.half_size_m.prod(); }
  double operator()(const Cylinder& cylinder) const {
    return std::numbers::pi * cylinder.radius_m * cylinder.radius_m * 2.0 * cylinder.half_height_m;
  }
  double operator()(const Sphere& sphere) const {
    return 4.0 / 3.0 * std::numbers::pi * sphere.radius_m * sphere.radius_m * sphere.radius_m;
  }
  template <class Surface>
  double operator()(const Surface&) const {
    return 0.0;
  }
};

struct Encloses {
  const Eigen::Vector3d& place_m;

  bool operator()(const Box& box) const {
    const Eigen::Vector3d local_m = box.world_from_box.inverse() * place_m;
    return (local_m.cwiseAbs().array() <= box.half_size_m.array()).all();
  }
  bool operator()(const Cylinder& cylinder) const {
    const Eigen::Vector3d local_m = cylinder.world_from_cylinder.inverse() * place_m;
    return local_m.head<2>().norm() <= cylinder.radius_m && std::abs(local_m.z()) <= cylinder.half_height_m;
  }
  bool operator()(const Sphere& sphere) const { return (place_m - sphere.center_m).norm() <= sphere.radius_m; }
  template <class Surface>
  bool operator()(const Surface&) const {
    return false;
  }
};

struct Moved {
  const Pose& motion;

  Shape operator()(const Box& box) const { return Box{motion * box.world_from_box, box.half_size_m}; }
  Shape operator()(const Room& room) const { return Room{motion * room.world_from_room, room.half_size_m}; }
  Shape operator()(const Cylinder& cylinder) const {
    return Cylinder{motion * cylinder.world_from_cylinder, cylinder.radius_m, cylinder.half_height_m};
  }
  Shape operator()(const Sphere& sphere) const { return Sphere{motion * sphere.center_m, sphere.radius_m}; }
  Shape operator()(const Disc& disc) const {
    return Disc{motion * disc.center_m, motion.orientation * disc.normal, disc.radius_m};
  }
  Shape operator()(const Plane& plane) const {
    return Plane{motion * plane.point_m, motion.orientation * plane.normal};
  }
  Shape operator()(const Terrain& terrain) const { return terrain; }
};

}  // namespace

std::optional<double> intersect(const Ray& ray, const Shape& shape) { return std::visit(Intersect{ray}, shape); }

std::optional<Eigen::AlignedBox3d> bounds(const Shape& shape) { return std::visit(Bounds{}, shape); }

double volume_m3(const Shape& shape) { return std::visit(Volume{}, shape); }

bool encloses(const Shape& shape, const Eigen::Vector3d& place_m) { return std::visit(Encloses{place_m}, shape); }

Shape moved(const Shape& shape, const Pose& motion) { return std::visit(Moved{motion}, shape); }

}  // namespace raywatch::simulator
