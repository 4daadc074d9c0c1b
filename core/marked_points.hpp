#pragma once

#include <bit>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "core/compare.hpp"
#include "core/prior_index_impl.hpp"

namespace raywatch {

/// Points of a scan that are marked one by one, and which cells of its index have returns that are not: most looks
/// around a point that lies amid marked ones end with a word of bits for each row of cells.
class MarkedPoints {
 public:
  /// @param sources the place in the scan of each return of its index (`sources_of`).
  MarkedPoints(const ScanView& view, std::span<const std::uint32_t> sources)
      : marked_(view.points.size(), 0), cell_of_(view.points.size(), kNoCell) {
    const PriorIndex::Impl& index = view.index.impl();
    left_.resize(index.first.size() - 1);
    open_.resize(left_.size() / kBits + 1, 0);
    for (std::uint32_t cell = 0; cell < left_.size(); ++cell) {
      left_[cell] = index.first[cell + 1] - index.first[cell];
      if (left_[cell] != 0) open_[cell / kBits] |= bit_of(cell);
      for (std::uint32_t i = index.first[cell]; i < index.first[cell + 1]; ++i) cell_of_[sources[i]] = cell;
    }
  }

  void mark(std::uint32_t point) {
    if (marked_[point]) return;
    marked_[point] = 1;
    const std::uint32_t cell = cell_of_[point];
    if (cell != kNoCell && --left_[cell] == 0) open_[cell / kBits] &= ~bit_of(cell);
  }
  bool operator[](std::uint32_t point) const { return marked_[point] != 0; }

  /// The cells with returns whose points are not marked, for `for_each_return_around`: see `EveryCell::for_each`.
  template <class MayHold, class Look>
  bool for_each(std::uint32_t first, std::uint32_t end, const MayHold& may_hold, const Look& look) const {
    for (std::uint32_t word = first / kBits; word * kBits < end; ++word) {
      std::uint64_t open = open_[word];
      if (word == first / kBits) open &= ~std::uint64_t{0} << first % kBits;
      for (; open != 0; open &= open - 1) {
        const std::uint32_t cell = word * kBits + static_cast<std::uint32_t>(std::countr_zero(open));
        if (cell >= end) return true;
        if (may_hold(cell) && !look(cell)) return false;
      }
    }
    return true;
  }

 private:
  static constexpr std::uint32_t kNoCell = std::numeric_limits<std::uint32_t>::max();
  static constexpr std::uint32_t kBits = 64;

  static constexpr std::uint64_t bit_of(std::uint32_t cell) { return std::uint64_t{1} << cell % kBits; }

  std::vector<std::uint8_t> marked_;
  std::vector<std::uint32_t> cell_of_;  ///< of each point; `kNoCell` when it is not in the index
  std::vector<std::uint32_t> left_;     ///< returns of each cell whose points are not marked
  std::vector<std::uint64_t> open_;     ///< of each cell a bit: whether any are left
};

}  // namespace raywatch
