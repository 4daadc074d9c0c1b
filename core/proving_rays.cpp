#include "core/proving_rays.hpp"

#include "core/returns_near.hpp"

namespace raywatch {

std::vector<std::uint32_t> proving_rays(const PointCloud& change, const PointCloud& returns, const UsableRange& usable,
                                        const Thresholds& thresholds) {
  const PriorIndex index = PriorIndex::build(change, {});
  const PriorIndex::Impl& points = index.impl();
  const double cosine = std::cos(thresholds.angle_rad);
  std::vector<std::uint32_t> proving;
  for (std::uint32_t i = 0; i < returns.size(); ++i) {
    const Eigen::Vector3d end_m = returns[i].cast<double>();
    const double range_m = end_m.norm();
    if (!is_usable(range_m, usable)) continue;
    bool passes = false, behind = true;
    for_each_return_near(points, end_m, thresholds.angle_rad, [&](std::uint32_t k) {
      const Eigen::Vector3d point_m = point_of(points.returns[k]);
      const double point_range_m = point_m.norm();
      if (end_m.dot(point_m) < cosine * range_m * point_range_m) return;
      passes = true;
      behind &= range_m >= point_range_m + thresholds.range_m;
    });
    if (passes && behind) proving.push_back(i);
  }
  return proving;
}

}  // namespace raywatch
