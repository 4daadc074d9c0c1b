#include "core/sensor.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>
#include <tuple>
#include <vector>

#include "core/median.hpp"
#include "core/prior_index_impl.hpp"

namespace raywatch {
namespace {

constexpr std::size_t kSamples = 600;  // at least half as many are taken of a scan that has more
constexpr double kWidestSearch_rad = 0.2;
/// Where so many returns lie around one and none on one of its sides, it stands at the edge of what the sensor sees.
constexpr std::size_t kReturnsAround = 800;

/// The axes of the plane that touches the unit sphere in a direction.
struct TangentPlane {
  explicit TangentPlane(const Eigen::Vector3d& direction) : axis(direction.normalized()) {
    const Eigen::Vector2d horizontal = axis.head<2>();
    const Eigen::Vector2d outward = horizontal.norm() > 0.0 ? horizontal.normalized() : Eigen::Vector2d::UnitX();
    east = {-outward.y(), outward.x(), 0.0};
    north = axis.cross(east);
  }
  Eigen::Vector3d axis, east, north;
};

/// Another return beside one.
struct NearestReturn {
  double squared = std::numeric_limits<double>::infinity();  ///< of the angular distance (tangents)
  double range_m = std::numeric_limits<double>::infinity();

  double offset_rad() const { return std::sqrt(squared); }
};

/// The neighbours of a return on either side, and above and below: the nearest return in each quarter of the directions
/// around it.
struct Neighbours {
  NearestReturn east, west, north, south;
  std::size_t looked_at = 0;

  bool complete() const { return std::isfinite(std::max({east.squared, west.squared, north.squared, south.squared})); }
  void offer(double eastward, double northward, double range_m) {
    constexpr double kSame_rad = 1e-6;  // the return itself, or a second echo of the same shot
    const double squared = eastward * eastward + northward * northward;
    if (squared < kSame_rad * kSame_rad) return;
    NearestReturn& nearest =
        std::abs(eastward) >= std::abs(northward) ? (eastward > 0.0 ? east : west) : (northward > 0.0 ? north : south);
    if (std::tie(squared, range_m) < std::tie(nearest.squared, nearest.range_m)) nearest = {squared, range_m};
  }
};

Neighbours look_around(const PriorIndex::Impl& index, const Eigen::Vector3d& center_m, double radius_rad) {
  const DirectionGrid& grid = index.grid;
  const Direction from = direction_of(center_m.x(), center_m.y(), center_m.z());
  const TangentPlane plane(center_m);
  Neighbours neighbours;
  const std::size_t first_row = grid.row_of(from.elevation_rad - radius_rad);
  const std::size_t last_row = grid.row_of(from.elevation_rad + radius_rad);
  for (std::size_t row = first_row; row <= last_row; ++row) {
    const auto columns = static_cast<std::int64_t>(grid.columns(row));
    const auto reach = static_cast<std::int64_t>(std::ceil(radius_rad / grid.cell_rad()));
    const auto column = static_cast<std::int64_t>(grid.column_coordinate(row, from.azimuth_rad));
    const std::int64_t first = 2 * reach + 1 >= columns ? 0 : column - reach;
    const std::int64_t last = 2 * reach + 1 >= columns ? columns - 1 : column + reach;
    for (std::int64_t c = first; c <= last; ++c) {
      const std::uint32_t cell = grid.first_cell(row) + static_cast<std::uint32_t>((c + columns) % columns);
      for (std::uint32_t i = index.first[cell]; i < index.first[cell + 1]; ++i) {
        ++neighbours.looked_at;
        const Eigen::Vector3d to_m(index.returns[i].x_m, index.returns[i].y_m, index.returns[i].z_m);
        const double ahead_m = to_m.dot(plane.axis);
        if (ahead_m > 0.0) {
          neighbours.offer(to_m.dot(plane.east) / ahead_m, to_m.dot(plane.north) / ahead_m, to_m.norm());
        }
      }
    }
  }
  return neighbours;
}

/// A return with neighbours on all sides.
struct Surrounded {
  double range_m;
  Neighbours neighbours;
};

/// Those of some of the returns that are surrounded.
std::vector<Surrounded> surrounded_returns(const PriorIndex::Impl& index) {
  std::vector<Surrounded> found;
  const auto stride = static_cast<std::uint32_t>(index.returns.size() / kSamples + 1);
  for (const Return& center : index.returns) {
    if (!is_chosen(center, stride)) continue;
    const Eigen::Vector3d center_m = point_of(center);
    Neighbours neighbours;
    for (double radius = 2.0 * index.grid.cell_rad(); radius <= kWidestSearch_rad; radius *= 2.0) {
      neighbours = look_around(index, center_m, radius);
      if (neighbours.complete() || neighbours.looked_at > kReturnsAround) break;
    }
    if (neighbours.complete()) found.push_back({center_m.norm(), neighbours});
  }
  return found;
}

std::optional<Eigen::Vector2d> angular_resolution(std::span<const Surrounded> returns) {
  std::vector<double> azimuth, elevation;
  for (const auto& [range_m, around] : returns) {
    azimuth.push_back(std::max(around.east.offset_rad(), around.west.offset_rad()));
    elevation.push_back(std::max(around.north.offset_rad(), around.south.offset_rad()));
  }
  if (azimuth.size() < 8) return std::nullopt;
  return Eigen::Vector2d(median(azimuth), median(elevation));
}

/// The ranges of every `stride`-th point.
std::vector<float> ranges_of(const PointCloud& cloud, std::size_t stride) {
  std::vector<float> ranges_m;
  ranges_m.reserve(cloud.size() / stride + 1);
  for (std::size_t i = 0; i < cloud.size(); i += stride) ranges_m.push_back(cloud[i].norm());
  return ranges_m;
}

/// A real farthest range is that of few returns; a sentinel is that of many, and all of them to the millimetre.
std::optional<double> sentinel_among(const std::vector<float>& ranges_m, std::size_t least_returns) {
  constexpr double kLeastShare = 0.005;
  constexpr double kToTheMillimetre_m = 2e-3;
  double farthest_m = 0.0;
  std::size_t measured = 0;
  for (const float range_m : ranges_m) {
    if (!(std::isfinite(range_m) && range_m > 0.0f)) continue;
    ++measured;
    farthest_m = std::max<double>(farthest_m, range_m);
  }
  const auto at_the_end = static_cast<std::size_t>(std::count_if(ranges_m.begin(), ranges_m.end(), [&](float range_m) {
    return std::isfinite(range_m) && range_m >= farthest_m - kToTheMillimetre_m;
  }));
  const auto needed = std::max(least_returns, static_cast<std::size_t>(kLeastShare * static_cast<double>(measured)));
  if (measured == 0 || at_the_end < needed) return std::nullopt;
  return farthest_m;
}

/// Few scans have a sentinel: what a sample does not show is not looked for in all points.
std::optional<double> sentinel_range(const PointCloud& cloud) {
  constexpr std::size_t kSample = 50'000, kLeastReturns = 50;
  const std::size_t stride = std::max<std::size_t>(1, cloud.size() / kSample);
  if (stride > 1 && !sentinel_among(ranges_of(cloud, stride), kLeastReturns / 2)) return std::nullopt;
  return sentinel_among(ranges_of(cloud, 1), kLeastReturns);
}

/// From how far returns are from where those on both sides of them would have a plane, in which the inverse range is
/// linear in the (tangent of the) angle. The median absolute deviation leaves edges out of account.
std::optional<double> range_noise(std::span<const Surrounded> returns, double spacing_rad) {
  constexpr std::size_t kLeast = 100;
  std::vector<double> deviations_m;
  for (const auto& [range_m, around] : returns) {
    const double east = around.east.offset_rad(), west = around.west.offset_rad();
    if (std::max(east, west) > 2.0 * spacing_rad) continue;
    const double weight_east = west / (east + west), weight_west = east / (east + west);
    const double expected_m = 1.0 / (weight_east / around.east.range_m + weight_west / around.west.range_m);
    const double variances = 1.0 + weight_east * weight_east + weight_west * weight_west;
    deviations_m.push_back(std::abs(range_m - expected_m) / std::sqrt(variances));
  }
  if (deviations_m.size() < kLeast) return std::nullopt;
  return 1.4826 * median(std::move(deviations_m));
}

}  // namespace

SensorModel estimate_sensor(const PointCloud& cloud) { return estimate_sensor(cloud, PriorIndex::build(cloud, {})); }

SensorModel estimate_sensor(const PointCloud& cloud, const PriorIndex& index) {
  SensorModel model;
  model.no_return_m = sentinel_range(cloud);
  const std::vector<Surrounded> returns = surrounded_returns(index.impl());
  model.angular_resolution_rad = angular_resolution(returns);
  if (model.angular_resolution_rad) {
    model.range_noise_m = range_noise(returns, model.angular_resolution_rad->maxCoeff());
  }
  return model;
}

SensorModel merged(const SensorModel& known, const SensorModel& estimated) {
  const auto either = [](const auto& first, const auto& second) { return first ? first : second; };
  return {.range_noise_m = either(known.range_noise_m, estimated.range_noise_m),
          .angular_resolution_rad = either(known.angular_resolution_rad, estimated.angular_resolution_rad),
          .beam_divergence_rad = either(known.beam_divergence_rad, estimated.beam_divergence_rad),
          .min_range_m = either(known.min_range_m, estimated.min_range_m),
          .max_range_m = either(known.max_range_m, estimated.max_range_m),
          .no_return_m = either(known.no_return_m, estimated.no_return_m)};
}

}  // namespace raywatch
