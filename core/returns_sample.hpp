#pragma once

#include <algorithm>
#include <vector>

#include "core/returns_near.hpp"
#include "core/spread_sample.hpp"

namespace raywatch {

/// At most `most` of the returns in a ball, as `for_each_return_around` goes through them, for which
/// `is_wanted(point)`: the same ones in whichever order the scan's points came.
template <class IsWanted>
std::vector<Eigen::Vector3d> sample_of_returns_around(const PriorIndex::Impl& index, const Eigen::Vector3d& center_m,
                                                      double radius_m, std::size_t most, IsWanted is_wanted) {
  std::vector<Eigen::Vector3d> wanted_m;
  for_each_return_around(index, center_m, radius_m, [&](std::uint32_t i) {
    const Eigen::Vector3d p = point_of(index.returns[i]);
    if (is_wanted(p)) wanted_m.push_back(p);
  });
  std::sort(wanted_m.begin(), wanted_m.end(), [](const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
    return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end());
  });
  return thinned(std::span<const Eigen::Vector3d>(wanted_m), most);
}

}  // namespace raywatch
