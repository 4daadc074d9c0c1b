#include "core/footprint.hpp"

#include <algorithm>
#include <numbers>

#include "core/assumed_sensor.hpp"
#include "core/cone.hpp"
#include "core/for_each_point.hpp"
#include "core/prior_index_impl.hpp"

namespace raywatch {
namespace {

/// Whether shots lie on each side of a point, and all ended at `least_range_m` or beyond. Looks at those in an ellipse
/// of directions: the cone of T_a is as wide as the coarser of the two spacings demands.
/// @param least_range_m 0: whatever their ranges, and no more of them than are needed
bool are_around(const PriorIndex::Impl& index, const Eigen::Vector3d& point_m, const Eigen::Vector2d& radii_rad,
                double least_range_m) {
  const double range_m = point_m.norm();
  const Eigen::Vector3d east = Eigen::Vector3d::UnitZ().cross(point_m).normalized();
  const Eigen::Vector3d north = point_m.cross(east) / range_m;
  bool on_west = false, on_east = false, on_south = false, on_north = false, behind = true;
  const auto surround = [&] { return on_west && on_east && on_south && on_north; };
  const auto look_at = [&](const Return& shot) {
    const Eigen::Vector3d end_m = point_of(shot);
    const double end_range_m = end_m.norm();
    const Eigen::Vector2d offset_rad = Eigen::Vector2d(east.dot(end_m), north.dot(end_m)) / end_range_m;
    if (end_m.dot(point_m) < 0.0 || offset_rad.cwiseQuotient(radii_rad).squaredNorm() > 1.0) return;
    behind &= end_range_m >= least_range_m;
    on_west |= offset_rad.x() <= 0.0;
    on_east |= offset_rad.x() >= 0.0;
    on_south |= offset_rad.y() < 0.0;
    on_north |= offset_rad.y() > 0.0;
  };
  const Direction axis = direction_of(point_m.x(), point_m.y(), point_m.z());
  const Cone cone(std::min(radii_rad.maxCoeff(), std::numbers::pi / 2));
  cone.for_each_cell(index.grid, axis, [&](std::uint32_t cell, bool) {
    for (std::uint32_t i = index.first[cell]; i < index.first[cell + 1] && behind; ++i) look_at(index.returns[i]);
    return behind && !(least_range_m == 0.0 && surround());
  });
  return behind && surround();
}

}  // namespace

void ask_footprints(const ScanView& asked, const PointCloud& points, const Pose& asked_from_points, double range_m,
                    std::span<Answer> answers) {
  constexpr double kBeside = 1.1;  // in spacings: reaches the corners of a grid's cell from nearly anywhere in it
  const PriorIndex::Impl& index = asked.index.impl();
  const Eigen::Vector2d radii_rad = kBeside * spacing_of(asked);
  for_each_point(points, asked_from_points, [&](std::size_t i, const Eigen::Vector3d& point_m) {
    if (answers[i] != Answer::ambiguous) return;
    if (are_around(index, point_m, radii_rad, point_m.norm() + range_m)) answers[i] = Answer::free;
  });
}

void withhold_at_borders(const ScanView& asked, const PointCloud& points, const Pose& asked_from_points, double noise_m,
                         std::span<Answer> answers) {
  constexpr double kAround = 2.5;  // in spacings: on each side several shots, of which some may have been lost
  constexpr double kNoise = 2.5;   // in standard deviations
  const PriorIndex::Impl& index = asked.index.impl();
  const Eigen::Vector2d radii_rad = kAround * spacing_of(asked);
  for_each_point(points, asked_from_points, [&](std::size_t i, const Eigen::Vector3d& point_m) {
    if (answers[i] != Answer::free) return;
    const Eigen::Vector2d moved_rad = radii_rad + Eigen::Vector2d::Constant(kNoise * noise_m / point_m.norm());
    if (index.own.hide(point_m, moved_rad) || !are_around(index, point_m, radii_rad, 0.0)) {
      answers[i] = Answer::unseen;
    }
  });
}

}  // namespace raywatch
