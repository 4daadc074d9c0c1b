#include "core/point_grid.hpp"

#include <oneapi/tbb/parallel_sort.h>

#include <tuple>

#include "core/error.hpp"

namespace raywatch {
namespace {

struct Keyed {
  std::array<std::int32_t, 3> cell;
  std::uint32_t index;
  friend bool operator<(const Keyed& a, const Keyed& b) {
    return std::tie(a.cell, a.index) < std::tie(b.cell, b.index);
  }
};

}  // namespace

std::size_t PointGrid::Hash::operator()(const Cell& cell) const {
  std::uint64_t bits = 0;
  for (const std::int32_t part : cell) {
    bits = (bits ^ static_cast<std::uint32_t>(part)) * 0x9e3779b97f4a7c15ULL;
    bits ^= bits >> 29;
  }
  return bits;
}

PointGrid::PointGrid(const PointCloud& points, double cell_m) : cell_m_(cell_m) {
  constexpr double kMostCells = 1e9;  // along each axis, so that cells have numbers of 32 bits
  if (!(cell_m > 0.0)) throw InvalidInput("Points can be sorted into cells of more than 0 m only.");
  std::vector<Keyed> order;
  order.reserve(points.size());
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector3d p = points[i].cast<double>();
    if (p.allFinite() && p.cwiseAbs().maxCoeff() < kMostCells * cell_m) order.push_back({cell_of(p), i});
  }
  tbb::parallel_sort(order.begin(), order.end());
  points_.reserve(order.size());
  for (std::uint32_t n = 0; n < order.size(); ++n) {
    points_.push_back(points[order[n].index]);
    const auto [at, is_new] = cells_.try_emplace(order[n].cell, Range{n, n + 1});
    if (!is_new) at->second.last = n + 1;
  }
}

}  // namespace raywatch
