#include "api/voxel_thinning.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

namespace raywatch {
namespace {

/// A point and its cube. The cube's indexes are whole numbers kept as double: no coordinate overflows them.
struct Placed {
  double i, j, k;
  std::uint32_t place;
  std::uint8_t group;

  auto cube() const { return std::tie(i, j, k, group); }
};

Eigen::Vector3d point_at(const ThinningInput& points, std::size_t place) {
  return {points.x_m[place], points.y_m[place], points.z_m[place]};
}

std::vector<Placed> sorted_by_cube(const ThinningInput& points, double voxel_m) {
  std::vector<Placed> placed;
  placed.reserve(points.x_m.size());
  for (std::size_t place = 0; place < points.x_m.size(); ++place) {
    const Eigen::Vector3d point_m = point_at(points, place);
    if (!point_m.allFinite()) continue;
    const Eigen::Vector3d cube = (point_m / voxel_m).array().floor();
    const std::uint8_t group = points.groups.empty() ? std::uint8_t{0} : points.groups[place];
    placed.push_back({cube.x(), cube.y(), cube.z(), static_cast<std::uint32_t>(place), group});
  }
  std::ranges::sort(placed, [](const Placed& a, const Placed& b) {
    return a.cube() != b.cube() ? a.cube() < b.cube() : a.place < b.place;
  });
  return placed;
}

std::uint32_t nearest_to_mean(const ThinningInput& points, std::span<const Placed> cube) {
  Eigen::Vector3d mean_m = Eigen::Vector3d::Zero();
  for (const Placed& point : cube) mean_m += point_at(points, point.place) / static_cast<double>(cube.size());
  std::uint32_t best = cube.front().place;
  double least_m2 = std::numeric_limits<double>::infinity();
  for (const Placed& point : cube) {
    const double distance_m2 = (point_at(points, point.place) - mean_m).squaredNorm();
    if (distance_m2 >= least_m2) continue;
    least_m2 = distance_m2;
    best = point.place;
  }
  return best;
}

}  // namespace

std::vector<std::uint32_t> thin(const ThinningInput& points, double voxel_m) {
  const std::vector<Placed> placed = sorted_by_cube(points, voxel_m);
  std::vector<std::uint32_t> kept;
  for (auto first = placed.begin(); first != placed.end();) {
    const auto last = std::find_if(first, placed.end(), [&](const Placed& p) { return p.cube() != first->cube(); });
    kept.push_back(nearest_to_mean(points, {first, last}));
    first = last;
  }
  std::ranges::sort(kept);
  return kept;
}

}  // namespace raywatch
