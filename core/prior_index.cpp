#include "core/prior_index.hpp"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "core/index_kernels.hpp"
#include "core/prior_index_impl.hpp"

namespace raywatch {
namespace {

/// As few as 24 bytes a return allow. Then a cell of a sensor with equal steps in both angles lies inside of a cone
/// of 1.6 steps, wherever in the cell the axis of the cone is, also if a part of the band is empty sky; and the bounds
/// of that cell alone support most points.
constexpr double kReturnsPerCell = 1.02;
constexpr double kLeastCell_rad = 2e-5;
constexpr double kMostCell_rad = 0.05;

/// Cells that hold `kReturnsPerCell` returns on the average of the band that the scan covers.
DirectionGrid grid_for(const ElevationBand& band) {
  const double band_sr = 2.0 * std::numbers::pi * std::max(std::sin(band.high_rad) - std::sin(band.low_rad), 1e-4);
  const double cell = std::sqrt(kReturnsPerCell * band_sr / static_cast<double>(band.count));
  return DirectionGrid(band.low_rad, band.high_rad, std::clamp(cell, kLeastCell_rad, kMostCell_rad));
}

/// A stable counting sort of the returns by cell, in as many parts of the scan as there are threads: each part counts
/// its own returns, so that it knows where they go. The result does not depend on the number of parts.
class CellSort {
 public:
  CellSort(const PointCloud& points, const UsableRange& usable, PriorIndex::Impl& index)
      : points_(planes_of(points)), usable_(usable), index_(index), cells_(points.size()) {
    constexpr std::size_t kLeastPart = 65536;
    const auto threads = static_cast<std::size_t>(std::max(1, tbb::this_task_arena::max_concurrency()));
    const std::size_t parts = std::clamp<std::size_t>(points_.size / kLeastPart, 1, threads);
    for (std::size_t part = 0; part <= parts; ++part) begin_.push_back(points_.size * part / parts);
    counts_.resize(parts);
  }

  void run() {
    for_each_part([&](std::size_t part) { count(part); });
    number();
    for_each_part([&](std::size_t part) { place(part); });
    bound_ranges();
  }

 private:
  template <class F>
  void for_each_part(F f) {
    tbb::parallel_for(std::size_t{0}, counts_.size(), f);
  }

  void count(std::size_t part) {
    std::vector<std::uint32_t>& counts = counts_[part];
    counts.assign(index_.grid.cells(), 0);
    constexpr std::size_t kBlock = 2048;
    for (std::size_t begin = begin_[part]; begin < begin_[part + 1]; begin += kBlock) {
      const std::size_t size = std::min(kBlock, begin_[part + 1] - begin);
      assign_cells(points_.subspan(begin, size), usable_, index_.grid.view(), cells_.data() + begin);
      for (std::size_t i = begin; i < begin + size; ++i) {
        if (cells_[i] != kNoCell) ++counts[cells_[i]];
      }
    }
  }

  /// Turns the counts of the parts into the places of their first returns.
  void number() {
    std::uint32_t next = 0;
    for (std::size_t cell = 0; cell < index_.grid.cells(); ++cell) {
      index_.first[cell] = next;
      for (std::vector<std::uint32_t>& counts : counts_) {
        const std::uint32_t count = counts[cell];
        counts[cell] = next;
        next += count;
      }
    }
    index_.first[index_.grid.cells()] = next;
  }

  void place(std::size_t part) {
    std::vector<std::uint32_t>& next = counts_[part];
    for (std::size_t i = begin_[part]; i < begin_[part + 1]; ++i) {
      if (cells_[i] == kNoCell) continue;
      index_.returns[next[cells_[i]]++] = {points_.x_m[i], points_.y_m[i], points_.z_m[i]};
    }
  }

  void bound_ranges() {
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    const tbb::blocked_range<std::size_t> all(0, index_.grid.cells(), 16384);
    tbb::parallel_for(all, [&](const tbb::blocked_range<std::size_t>& cells) {
      for (std::size_t cell = cells.begin(); cell < cells.end(); ++cell) {
        float least_m = kInfinity, greatest_m = -kInfinity;
        for (std::uint32_t i = index_.first[cell]; i < index_.first[cell + 1]; ++i) {
          const auto& [x, y, z] = index_.returns[i];
          const float range_m = std::sqrt(x * x + y * y + z * z);
          least_m = std::min(least_m, range_m);
          greatest_m = std::max(greatest_m, range_m);
        }
        index_.least_m[cell] = least_m;
        index_.greatest_m[cell] = greatest_m;
      }
    });
  }

  PointPlanes points_;
  const UsableRange& usable_;
  PriorIndex::Impl& index_;
  RawArray<std::uint32_t> cells_;
  std::vector<std::size_t> begin_;                  ///< first point of each part, and the number of points
  std::vector<std::vector<std::uint32_t>> counts_;  ///< of each part, one a cell
};

}  // namespace

PriorIndex PriorIndex::build(const PointCloud& points, const UsableRange& usable) {
  auto impl = std::make_unique<Impl>();
  impl->usable = usable;
  const ElevationBand band = find_elevation_band(planes_of(points), usable);
  if (band.count > 0) {
    impl->grid = grid_for(band);
    impl->returns = RawArray<Return>(band.count);
    impl->first = RawArray<std::uint32_t>(impl->grid.cells() + 1);
    impl->least_m = RawArray<float>(impl->grid.cells());
    impl->greatest_m = RawArray<float>(impl->grid.cells());
    CellSort(points, usable, *impl).run();
  }
  return PriorIndex(std::move(impl));
}

std::vector<std::uint32_t> sources_of(const PriorIndex::Impl& index, const PointCloud& points) {
  std::vector<std::uint32_t> sources(index.returns.size());
  if (sources.empty()) return sources;
  RawArray<std::uint32_t> cells(points.size());
  assign_cells(planes_of(points), index.usable, index.grid.view(), cells.data());
  std::vector<std::uint32_t> next(index.first.begin(), index.first.end());
  for (std::uint32_t i = 0; i < cells.size(); ++i) {
    if (cells[i] != kNoCell) sources[next[cells[i]]++] = i;
  }
  return sources;
}

PriorIndex::PriorIndex(std::unique_ptr<const Impl> impl) : impl_(std::move(impl)) {}
PriorIndex::PriorIndex(PriorIndex&&) noexcept = default;
PriorIndex& PriorIndex::operator=(PriorIndex&&) noexcept = default;
PriorIndex::~PriorIndex() = default;

std::size_t PriorIndex::size() const { return impl_->returns.size(); }
std::size_t PriorIndex::bytes() const {
  constexpr std::size_t kBytesPerCell = sizeof(std::uint32_t) + 2 * sizeof(float);
  return sizeof(Impl) + size() * sizeof(Return) + impl_->grid.cells() * kBytesPerCell;
}
const UsableRange& PriorIndex::usable() const { return impl_->usable; }

}  // namespace raywatch
