#include "core/prior_index.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "core/prior_index_impl.hpp"

namespace raywatch {
namespace {

constexpr double kReturnsPerCell = 2.0;
constexpr double kLeastCell_rad = 2e-5;
constexpr double kMostCell_rad = 0.05;

struct UsableReturns {
  std::vector<std::uint32_t> index;
  std::vector<Direction> direction;
  float low_rad = std::numeric_limits<float>::infinity();
  float high_rad = -std::numeric_limits<float>::infinity();
};

UsableReturns usable_returns(const PointCloud& points, const UsableRange& usable) {
  UsableReturns returns;
  returns.index.reserve(points.size());
  returns.direction.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double x = points.x_m[i], y = points.y_m[i], z = points.z_m[i];
    if (!is_usable(std::sqrt(x * x + y * y + z * z), usable)) continue;
    const Direction direction = direction_of(points.x_m[i], points.y_m[i], points.z_m[i]);
    returns.index.push_back(static_cast<std::uint32_t>(i));
    returns.direction.push_back(direction);
    returns.low_rad = std::min(returns.low_rad, direction.elevation_rad);
    returns.high_rad = std::max(returns.high_rad, direction.elevation_rad);
  }
  return returns;
}

/// Cells that hold `kReturnsPerCell` returns on the average of the band that the scan covers.
DirectionGrid grid_for(const UsableReturns& returns) {
  if (returns.index.empty()) return {};
  const double low = returns.low_rad, high = returns.high_rad;
  const double band_sr = 2.0 * std::numbers::pi * std::max(std::sin(high) - std::sin(low), 1e-4);
  const double cell = std::sqrt(kReturnsPerCell * band_sr / static_cast<double>(returns.index.size()));
  return DirectionGrid(low, high, std::clamp(cell, kLeastCell_rad, kMostCell_rad));
}

}  // namespace

PriorIndex PriorIndex::build(const PointCloud& points, const UsableRange& usable) {
  auto impl = std::make_unique<Impl>();
  impl->usable = usable;
  const UsableReturns returns = usable_returns(points, usable);
  impl->grid = grid_for(returns);
  const std::size_t n = returns.index.size();
  const std::size_t cells = impl->grid.cells();

  // Counting sort by cell; within a cell the order of the scan stays.
  std::vector<std::uint32_t> cell_of(n);
  impl->first.assign(cells + 1, 0);
  for (std::size_t k = 0; k < n; ++k) {
    cell_of[k] = impl->grid.cell_of(returns.direction[k]);
    ++impl->first[cell_of[k] + 1];
  }
  std::partial_sum(impl->first.begin(), impl->first.end(), impl->first.begin());
  std::vector<std::uint32_t> next(impl->first.begin(), impl->first.end());
  impl->x_m.resize(n);
  impl->y_m.resize(n);
  impl->z_m.resize(n);
  impl->source.resize(n);
  impl->range_m.assign(cells, RangeInterval{});
  for (std::size_t k = 0; k < n; ++k) {
    const std::uint32_t i = returns.index[k];
    const std::uint32_t slot = next[cell_of[k]]++;
    const double x = impl->x_m[slot] = points.x_m[i];
    const double y = impl->y_m[slot] = points.y_m[i];
    const double z = impl->z_m[slot] = points.z_m[i];
    impl->source[slot] = i;
    impl->range_m[cell_of[k]].extend(std::sqrt(x * x + y * y + z * z));
  }
  return PriorIndex(std::move(impl));
}

PriorIndex::PriorIndex(std::unique_ptr<const Impl> impl) : impl_(std::move(impl)) {}
PriorIndex::PriorIndex(PriorIndex&&) noexcept = default;
PriorIndex& PriorIndex::operator=(PriorIndex&&) noexcept = default;
PriorIndex::~PriorIndex() = default;

std::size_t PriorIndex::size() const { return impl_->source.size(); }
std::size_t PriorIndex::bytes() const {
  return sizeof(Impl) + size() * (3 * sizeof(float) + sizeof(std::uint32_t)) +
         impl_->grid.cells() * (sizeof(RangeInterval) + sizeof(std::uint32_t));
}
const UsableRange& PriorIndex::usable() const { return impl_->usable; }

}  // namespace raywatch
