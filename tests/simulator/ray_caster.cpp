#include "tests/simulator/ray_caster.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>

namespace raywatch::simulator {
namespace {

constexpr std::uint32_t kLeafSize = 4;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// The nearest solid so far. Of two at the same range the one that was added first wins, so that the order in which
/// they are tried does not matter.
struct Nearest {
  double range_m = kInfinity;
  std::uint32_t solid = 0;

  void offer(const Scene& scene, std::uint32_t candidate, const Ray& ray) {
    const auto range = intersect(ray, scene.solids[candidate].shape);
    if (!range) return;
    if (*range < range_m || (*range == range_m && candidate < solid)) {
      range_m = *range;
      solid = candidate;
    }
  }
};

std::optional<Hit> to_hit(const Scene& scene, const Nearest& nearest, const Ray& ray) {
  if (nearest.range_m == kInfinity) return std::nullopt;
  const Solid& solid = scene.solids[nearest.solid];
  StateId state = solid.state;
  if (const auto* terrain = std::get_if<Terrain>(&solid.shape); terrain && terrain->states) {
    const Eigen::Vector2d place_m = ray.at(nearest.range_m).head<2>();
    state = (*terrain->states)[terrain->field->cell_at(place_m)];
  }
  return Hit{nearest.range_m, nearest.solid, state};
}

/// Where the ray enters the box, or infinity when it misses it. Slightly generous, so that rounding loses no hit.
double entry_m(const Eigen::AlignedBox3d& box, const Ray& ray, const Eigen::Vector3d& inverse_direction) {
  double from = 0.0;
  double to = kInfinity;
  for (int axis = 0; axis < 3; ++axis) {
    if (ray.direction[axis] == 0.0) {
      if (ray.origin_m[axis] < box.min()[axis] || ray.origin_m[axis] > box.max()[axis]) return kInfinity;
      continue;
    }
    const double a = (box.min()[axis] - ray.origin_m[axis]) * inverse_direction[axis];
    const double b = (box.max()[axis] - ray.origin_m[axis]) * inverse_direction[axis];
    from = std::max(from, std::min(a, b));
    to = std::min(to, std::max(a, b));
  }
  constexpr double kGenerous_m = 1e-9;
  return from <= to + kGenerous_m ? from - kGenerous_m : kInfinity;
}

}  // namespace

RayCaster::RayCaster(const Scene& scene) : scene_(&scene) {
  std::vector<Eigen::AlignedBox3d> boxes(scene.solids.size());
  for (std::uint32_t i = 0; i < scene.solids.size(); ++i) {
    if (const auto box = bounds(scene.solids[i].shape)) {
      boxes[i] = *box;
      order_.push_back(i);
    } else {
      infinite_.push_back(i);
    }
  }
  if (!order_.empty()) build(0, static_cast<std::uint32_t>(order_.size()), boxes);
}

void RayCaster::build(std::uint32_t first, std::uint32_t last, const std::vector<Eigen::AlignedBox3d>& boxes) {
  const std::size_t here = nodes_.size();
  nodes_.emplace_back();
  Eigen::AlignedBox3d centers;
  for (std::uint32_t i = first; i < last; ++i) {
    nodes_[here].box.extend(boxes[order_[i]]);
    centers.extend(boxes[order_[i]].center());
  }
  if (last - first <= kLeafSize) {
    nodes_[here].first = first;
    nodes_[here].count = last - first;
    return;
  }
  Eigen::Index axis = 0;
  centers.sizes().maxCoeff(&axis);
  const std::uint32_t middle = first + (last - first) / 2;
  const auto by_center = [&](std::uint32_t a, std::uint32_t b) {
    return std::pair(boxes[a].center()[axis], a) < std::pair(boxes[b].center()[axis], b);
  };
  std::nth_element(order_.begin() + first, order_.begin() + middle, order_.begin() + last, by_center);
  build(first, middle, boxes);
  nodes_[here].first = static_cast<std::uint32_t>(nodes_.size());
  build(middle, last, boxes);
}

std::optional<Hit> RayCaster::cast(const Ray& ray) const {
  Nearest nearest;
  for (const std::uint32_t solid : infinite_) nearest.offer(*scene_, solid, ray);
  if (nodes_.empty()) return to_hit(*scene_, nearest, ray);

  const Eigen::Vector3d inverse_direction = ray.direction.cwiseInverse();
  struct Waiting {
    std::uint32_t node;
    double entry_m;
  };
  // Halving at the median keeps the depth below 32, and each level leaves at most one sibling waiting.
  std::array<Waiting, 64> waiting;
  std::size_t count = 0;
  waiting[count++] = {0, entry_m(nodes_[0].box, ray, inverse_direction)};
  while (count > 0) {
    const Waiting next = waiting[--count];
    if (next.entry_m > nearest.range_m || next.entry_m == kInfinity) continue;
    const Node& node = nodes_[next.node];
    for (std::uint32_t i = 0; i < node.count; ++i) nearest.offer(*scene_, order_[node.first + i], ray);
    if (node.count > 0) continue;
    Waiting near{next.node + 1, entry_m(nodes_[next.node + 1].box, ray, inverse_direction)};
    Waiting far{node.first, entry_m(nodes_[node.first].box, ray, inverse_direction)};
    if (far.entry_m < near.entry_m) std::swap(near, far);
    waiting[count++] = far;
    waiting[count++] = near;
  }
  return to_hit(*scene_, nearest, ray);
}

std::optional<Hit> cast_by_brute_force(const Scene& scene, const Ray& ray) {
  Nearest nearest;
  for (std::uint32_t i = 0; i < scene.solids.size(); ++i) nearest.offer(scene, i, ray);
  return to_hit(scene, nearest, ray);
}

}  // namespace raywatch::simulator
