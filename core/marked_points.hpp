#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "core/compare.hpp"
#include "core/prior_index_impl.hpp"

namespace raywatch {

/// Points of a scan that are marked one by one, and for each cell of its index how many of its returns are not: most
/// looks around a point that lies amid marked ones end at that number.
class MarkedPoints {
 public:
  /// @param sources the place in the scan of each return of its index (`sources_of`).
  MarkedPoints(const ScanView& view, std::span<const std::uint32_t> sources)
      : marked_(view.points.size(), 0), cell_of_(view.points.size(), kNoCell) {
    const PriorIndex::Impl& index = view.index.impl();
    left_.resize(index.first.size() - 1);
    for (std::uint32_t cell = 0; cell < left_.size(); ++cell) {
      left_[cell] = index.first[cell + 1] - index.first[cell];
      for (std::uint32_t i = index.first[cell]; i < index.first[cell + 1]; ++i) cell_of_[sources[i]] = cell;
    }
  }

  void mark(std::uint32_t point) {
    if (marked_[point]) return;
    marked_[point] = 1;
    if (cell_of_[point] != kNoCell) --left_[cell_of_[point]];
  }
  bool operator[](std::uint32_t point) const { return marked_[point] != 0; }
  bool some_left_in(std::uint32_t cell) const { return left_[cell] != 0; }

 private:
  static constexpr std::uint32_t kNoCell = std::numeric_limits<std::uint32_t>::max();

  std::vector<std::uint8_t> marked_;
  std::vector<std::uint32_t> cell_of_;  ///< of each point; `kNoCell` when it is not in the index
  std::vector<std::uint32_t> left_;     ///< returns of each cell whose points are not marked
};

}  // namespace raywatch
