#include "core/prior_index.hpp"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/parallel_reduce.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <utility>
#include <vector>

#include "core/index_kernels.hpp"
#include "core/prior_index_impl.hpp"
#include "core/spread_sample.hpp"

namespace raywatch {
namespace {

/// As few as 24 bytes a return allow. Then a cell of a sensor with equal steps in both angles lies inside of a cone
/// of 1.6 steps, wherever in the cell the axis of the cone is; and the bounds of that cell alone support most points.
constexpr double kReturnsPerCell = 1.02;
/// Cells where nothing was seen cost memory, so there are not many more of them than returns.
constexpr double kMostCellsPerReturn = 6.0;
constexpr double kLeastCell_rad = 2e-5;
constexpr double kMostCell_rad = 0.05;

/// As `find_elevation_band` of all points.
ScannedBand elevation_band_of(const PointPlanes& points, const UsableRange& usable) {
  const auto merge = [](const ScannedBand& a, const ScannedBand& b) {
    if (a.count == 0 || b.count == 0) return a.count == 0 ? b : a;
    return ScannedBand{a.count + b.count, std::min(a.low_rad, b.low_rad), std::max(a.high_rad, b.high_rad)};
  };
  constexpr std::size_t kGrain = 65536;
  return tbb::parallel_reduce(
      tbb::blocked_range<std::size_t>(0, points.size, kGrain), ScannedBand{},
      [&](const tbb::blocked_range<std::size_t>& block, const ScannedBand& band) {
        return merge(band, find_elevation_band(points.subspan(block.begin(), block.size()), usable));
      },
      merge);
}

/// The share of a band of elevations in which returns lie: a scan may look to one side only, or see sky above all but a
/// few trees. Told by a sample, in bins that are wider than the gaps between the rings of common sensors.
double occupied_share(const PointPlanes& points, const UsableRange& usable, const ScannedBand& band) {
  constexpr std::size_t kColumns = 32, kRows = 8;
  constexpr std::size_t kSamples = 4096;  // so many that hardly any order of the points misses a bin
  std::array<std::uint8_t, kColumns * kRows> occupied{};
  const double low = std::sin(band.low_rad), high = std::sin(band.high_rad);
  for (std::size_t k = 0; k < kSamples; ++k) {
    const std::size_t i = spread_place(k, points.size);
    const double x = points.x_m[i], y = points.y_m[i], z = points.z_m[i];
    const double range_m = std::sqrt(x * x + y * y + z * z);
    if (!is_usable(range_m, usable)) continue;
    const double column = (std::atan2(y, x) / (2.0 * std::numbers::pi) + 0.5) * kColumns;
    const double row = (z / range_m - low) / std::max(high - low, 1e-9) * kRows;
    const auto bounded = [](double value, std::size_t count) {
      return static_cast<std::size_t>(std::clamp(value, 0.0, static_cast<double>(count - 1)));
    };
    occupied[bounded(row, kRows) * kColumns + bounded(column, kColumns)] = 1;
  }
  const auto count = std::accumulate(occupied.begin(), occupied.end(), 0);
  return count == 0 ? 1.0 : static_cast<double>(count) / occupied.size();
}

/// Cells that hold `kReturnsPerCell` returns on the average of where returns are.
DirectionGrid grid_for(const ScannedBand& band, double occupied) {
  const double band_sr = 2.0 * std::numbers::pi * std::max(std::sin(band.high_rad) - std::sin(band.low_rad), 1e-4);
  const double per_return_sr = band_sr / static_cast<double>(band.count);
  const double cell = std::sqrt(per_return_sr * std::max(kReturnsPerCell * occupied, 1.0 / kMostCellsPerReturn));
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
    RawArray<std::uint32_t> counts(index_.grid.cells());
    std::fill(counts.begin(), counts.end(), 0);
    constexpr std::size_t kBlock = 2048;
    for (std::size_t begin = begin_[part]; begin < begin_[part + 1]; begin += kBlock) {
      const std::size_t size = std::min(kBlock, begin_[part + 1] - begin);
      assign_cells(points_.subspan(begin, size), usable_, index_.grid.view(), cells_.data() + begin);
      for (std::size_t i = begin; i < begin + size; ++i) {
        if (cells_[i] != kNoCell) ++counts[cells_[i]];
      }
    }
    counts_[part] = std::move(counts);
  }

  /// Turns the counts of the parts into the places of their first returns: block by block of cells, once it is known
  /// how many returns stand before each block.
  void number() {
    const std::size_t cells = index_.grid.cells(), blocks = (cells + kCellGrain - 1) / kCellGrain;
    std::vector<std::uint32_t> next(blocks + 1, 0);
    tbb::parallel_for(std::size_t{0}, blocks, [&](std::size_t block) {
      const std::size_t begin = block * kCellGrain, end = std::min(begin + kCellGrain, cells);
      for (const RawArray<std::uint32_t>& counts : counts_) {
        next[block + 1] = std::accumulate(counts.begin() + begin, counts.begin() + end, next[block + 1]);
      }
    });
    std::partial_sum(next.begin(), next.end(), next.begin());
    tbb::parallel_for(std::size_t{0}, blocks, [&](std::size_t block) {
      const std::size_t begin = block * kCellGrain, end = std::min(begin + kCellGrain, cells);
      number_cells(begin, end, next[block]);
    });
    index_.first[cells] = next[blocks];
  }

  void number_cells(std::size_t begin, std::size_t end, std::uint32_t next) {
    std::vector<std::uint32_t*> parts;
    for (RawArray<std::uint32_t>& counts : counts_) parts.push_back(counts.data());
    std::uint32_t* const first = index_.first.data();
    for (std::size_t cell = begin; cell < end; ++cell) {
      first[cell] = next;
      for (std::uint32_t* const counts : parts) next += std::exchange(counts[cell], next);
    }
  }

  void place(std::size_t part) {
    RawArray<std::uint32_t>& next = counts_[part];
    for (std::size_t i = begin_[part]; i < begin_[part + 1]; ++i) {
      if (cells_[i] == kNoCell) continue;
      index_.returns[next[cells_[i]]++] = {points_.x_m[i], points_.y_m[i], points_.z_m[i]};
    }
  }

  void bound_ranges() {
    const tbb::blocked_range<std::size_t> all(0, index_.grid.cells(), kCellGrain);
    tbb::parallel_for(all, [&](const tbb::blocked_range<std::size_t>& cells) {
      raywatch::bound_ranges(index_.returns.data(), index_.first.data() + cells.begin(), cells.size(),
                             index_.least_m.data() + cells.begin(), index_.greatest_m.data() + cells.begin());
    });
  }

  static constexpr std::size_t kCellGrain = 16384;

  PointPlanes points_;
  const UsableRange& usable_;
  PriorIndex::Impl& index_;
  RawArray<std::uint32_t> cells_;
  std::vector<std::size_t> begin_;               ///< first point of each part, and the number of points
  std::vector<RawArray<std::uint32_t>> counts_;  ///< of each part, one a cell
};

}  // namespace

PriorIndex PriorIndex::build(const PointCloud& points, const UsableRange& usable) {
  auto impl = std::make_unique<Impl>();
  impl->usable = usable;
  impl->own = OwnReturns(points, usable);
  const ScannedBand band = elevation_band_of(planes_of(points), usable);
  if (band.count > 0) {
    impl->grid = grid_for(band, occupied_share(planes_of(points), usable, band));
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
  return sizeof(Impl) + size() * sizeof(Return) + impl_->grid.cells() * kBytesPerCell + impl_->own.bytes();
}
const UsableRange& PriorIndex::usable() const { return impl_->usable; }

}  // namespace raywatch
