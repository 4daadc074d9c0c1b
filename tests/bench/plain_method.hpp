#pragma once

#include <cstdint>
#include <vector>

#include "core/prior_index.hpp"

namespace raywatch::bench {

/// The published method as one would first write it: the prior's returns in bins of azimuth and elevation as wide as
/// T_a, and a look at every return in the bins that the cone touches. Scalar, one thread; the poles and what the
/// tangent plane says there are left out.
class PlainMethod {
 public:
  PlainMethod(const PointCloud& prior, const Thresholds& thresholds);

  /// Whether each point, moved into the prior's frame, is free (Algorithm 1).
  std::vector<std::uint8_t> free(const PointCloud& points, const Pose& prior_from_points) const;

 private:
  bool is_free(const Eigen::Vector3d& point_m) const;
  std::size_t bin_of(long row, long column) const;

  Thresholds thresholds_;
  long rows_, columns_;
  std::vector<std::uint32_t> first_;
  std::vector<Eigen::Vector3d> direction_;
  std::vector<double> range_m_;
};

}  // namespace raywatch::bench
