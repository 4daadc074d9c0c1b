#pragma once

#include <numbers>

#include "core/compare.hpp"

namespace raywatch {

/// One step of the scans that are made here.
inline constexpr double kStep_rad = std::numbers::pi / 180.0;

/// Adds a return; column and row count steps from the x axis, to the left and up.
inline void push_shot(PointCloud& cloud, double column, double row, double range_m) {
  const double a = kStep_rad * column, e = kStep_rad * row;
  cloud.push_back(static_cast<float>(range_m * std::cos(e) * std::cos(a)),
                  static_cast<float>(range_m * std::cos(e) * std::sin(a)), static_cast<float>(range_m * std::sin(e)));
}

/// A scan of one degree's steps around the x axis; range_m(column, row) with both in -20..20.
template <class Range>
PointCloud shoot(Range range_m) {
  PointCloud cloud;
  for (int row = -20; row <= 20; ++row) {
    for (int column = -20; column <= 20; ++column) push_shot(cloud, column, row, range_m(column, row));
  }
  return cloud;
}

/// The place of a shot in what `shoot` returns.
inline std::uint32_t shot(int column, int row) { return static_cast<std::uint32_t>((row + 20) * 41 + column + 20); }

/// A scan, indexed.
struct Taken {
  explicit Taken(PointCloud cloud) : points(std::move(cloud)), index(PriorIndex::build(points, {})) {}
  ScanView view(const Pose& world_from_sensor = {}, Time captured_at = {}) const {
    return {points,
            index,
            world_from_sensor,
            captured_at,
            {.range_noise_m = 0.01, .angular_resolution_rad = Eigen::Vector2d(kStep_rad, kStep_rad)}};
  }
  PointCloud points;
  PriorIndex index;
};

}  // namespace raywatch
