#pragma once

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>

#include <Eigen/Core>
#include <cstddef>

#include "core/point_cloud.hpp"
#include "core/pose.hpp"

namespace raywatch {

/// Calls `visit(i, point in the prior's frame)` for every point, in parallel inside the caller's arena.
template <class Visit>
void for_each_point(const PointCloud& points, const Pose& prior_from_points, Visit visit) {
  const Eigen::Matrix3d rotation = prior_from_points.orientation.toRotationMatrix();
  const Eigen::Vector3d translation_m = prior_from_points.position_m;
  constexpr std::size_t kGrain = 4096;
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, points.size(), kGrain), [&](const auto& block) {
    for (std::size_t i = block.begin(); i < block.end(); ++i) {
      visit(i, rotation * Eigen::Vector3d(points.x_m[i], points.y_m[i], points.z_m[i]) + translation_m);
    }
  });
}

}  // namespace raywatch
