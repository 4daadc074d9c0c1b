#include "core/reach.hpp"

#include <algorithm>

namespace raywatch {

float reach_m(const ScanView& view, const Eigen::Vector3f& point_m, const CompareParameters& parameters) {
  constexpr double kReachPerSpacing = 2.0;  // bridges a lost return, and surfaces seen aslant
  const auto least_m = static_cast<float>(parameters.cluster_distance_m);
  if (parameters.grouping == Grouping::union_ || !view.sensor.angular_resolution_rad) return least_m;
  const double spacing_m = view.sensor.angular_resolution_rad->maxCoeff() * point_m.norm();
  return std::max(least_m, static_cast<float>(kReachPerSpacing * spacing_m));
}

}  // namespace raywatch
