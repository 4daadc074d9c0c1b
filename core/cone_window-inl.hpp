// Vector code, compiled once for each instruction set: see spherical_simd-inl.hpp.
#if defined(RAYWATCH_CONE_WINDOW_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef RAYWATCH_CONE_WINDOW_INL
#undef RAYWATCH_CONE_WINDOW_INL
#else
#define RAYWATCH_CONE_WINDOW_INL
#endif

#include <algorithm>
#include <bit>
#include <cstring>
#include <limits>
#include <optional>

#include "core/cone_spans-inl.hpp"
#include "core/inquiry.hpp"
#include "core/spherical_simd-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace raywatch::HWY_NAMESPACE {

/// Points that their own cells did not decide, one after the other: places in the block, and directions in the prior's
/// frame.
struct OpenPoints {
  static constexpr std::size_t kMost = 4096;
  std::size_t size = 0;
  std::int32_t place[kMost + kMostLanes];
  float range_m[kMost + kMostLanes], azimuth_rad[kMost + kMostLanes], elevation_rad[kMost + kMostLanes];
  float cosine[kMost + kMostLanes];  ///< of the elevation

  /// Adds the lanes of `mask`. Writes beyond them, up to a whole vector: some processors are slow to store less.
  HWY_INLINE void append(Ints places, const Spherical& s, Floats cosines, FloatMask mask) {
    const FloatTag d;
    const IntTag di;
    hn::StoreU(hn::Compress(places, hn::RebindMask(di, mask)), di, place + size);
    hn::StoreU(hn::Compress(s.range, mask), d, range_m + size);
    hn::StoreU(hn::Compress(s.azimuth, mask), d, azimuth_rad + size);
    hn::StoreU(hn::Compress(s.elevation, mask), d, elevation_rad + size);
    hn::StoreU(hn::Compress(cosines, mask), d, cosine + size);
    size += hn::CountTrue(d, mask);
  }
  Spherical directions(std::size_t k) const {
    const FloatTag d;
    return {hn::LoadU(d, range_m + k), hn::LoadU(d, azimuth_rad + k), hn::LoadU(d, elevation_rad + k)};
  }
};

/// Where ranges stand to rho - T_r and rho + T_r, for bounds of cells in single precision: each test only holds when no
/// rounding can have made it so.
struct RangeBand {
  RangeBand(Floats range, double threshold_m) : rho(range) {
    const Floats rounding = hn::MulAdd(range, constant(3.0f * kRangeError), constant(1e-9f));
    const Floats threshold = constant(static_cast<float>(threshold_m));
    within = hn::Sub(threshold, rounding);
    near = hn::Sub(hn::Sub(range, threshold), rounding);
    far = hn::Add(hn::Add(range, threshold), rounding);
  }

  /// Bounds of a cell that lie in the band: a return does.
  FloatMask supports(Floats least, Floats greatest) const {
    return hn::Or(hn::Lt(hn::Abs(hn::Sub(least, rho)), within), hn::Lt(hn::Abs(hn::Sub(greatest, rho)), within));
  }

  /// Least bounds of a cell that deny that the point is free: a return is not at rho + T_r or beyond.
  FloatMask denies_free(Floats least) const { return hn::Lt(hn::Sub(least, rho), within); }

  Floats rho, within, near, far;
};

inline std::uint32_t bits_of(FloatMask mask) {
  std::uint8_t bytes[8] = {};
  hn::StoreMaskBits(FloatTag(), mask, bytes);
  std::uint32_t bits;
  std::memcpy(&bits, bytes, sizeof bits);
  return bits;
}

inline FloatMask mask_of(std::uint32_t bits) {
  std::uint8_t bytes[8] = {};
  std::memcpy(bytes, &bits, sizeof bits);
  return hn::LoadMaskBits(FloatTag(), bytes);
}

/// Looks at the bounds of all cells that the cone of one point touches.
class ConeWindow {
 public:
  ConeWindow(const PriorIndex::Impl& index, const ConeSpans& spans, std::size_t lane, float range_m, double threshold_m)
      : index_(index), spans_(spans), lane_(lane), band_(constant(range_m), threshold_m) {}

  /// The answer, if bounds alone decide it; else none, and `remains` says what is left to be looked at.
  std::optional<Answer> look(Remains& remains) const {
    remains.count = 0;
    remains.is_complete = spans_.fits(lane_);
    if (!remains.is_complete) return std::nullopt;
    Bounds all;
    look_at_all(all);
    if (all.settle(band_)) return Answer::supported;
    const bool is_nearer = has(hn::Le(all.inside_least, band_.near));
    const bool is_farther = has(hn::Ge(all.inside_greatest, band_.far));
    const bool any = is_nearer || is_farther || has(hn::Le(all.inside_least, all.inside_greatest));
    remains.evidence = {.any = any, .not_farther = is_nearer, .not_nearer = is_farther};
    const bool borders_matter = (!is_nearer && has(hn::Le(all.least, band_.near))) ||
                                (!is_farther && has(hn::Ge(all.greatest, band_.far))) || all.may_lie_in_band();
    if (!borders_matter) {
      if (!any) return Answer::unseen;
      if (is_nearer) return is_farther ? Answer::ambiguous : Answer::occluded;
    }
    list_cells_of_interest(!is_nearer, !is_farther, remains);
    if (is_nearer) {
      if (remains.count > 0) return std::nullopt;
      return is_farther ? Answer::ambiguous : Answer::occluded;
    }
    remains.is_surrounded = is_surrounded();
    if (!borders_matter && remains.is_surrounded) return Answer::free;
    return std::nullopt;
  }

  /// Whether the point is free, if bounds alone decide that; else none, and `remains` says what is left.
  std::optional<bool> look_whether_free(Remains& remains) const {
    remains.count = 0;
    remains.is_complete = spans_.fits(lane_);
    if (!remains.is_complete) return std::nullopt;
    LeastBounds all;
    look_at_all(all);
    if (all.settle(band_) || !has(hn::Lt(all.least, constant(std::numeric_limits<float>::infinity())))) return false;
    const bool borders_matter = has(hn::Lt(all.least, band_.far));
    if (borders_matter) {
      list_cells(remains, [&](const Cells& cells) HWY_ATTR { return bits_of(hn::Lt(cells.least, band_.far)); });
    }
    remains.evidence = {};
    remains.is_surrounded = is_surrounded();
    if (!borders_matter && remains.is_surrounded) return true;
    return std::nullopt;
  }

 private:
  static constexpr std::int32_t kHalf = static_cast<std::int32_t>(kMostLanes / 2);

  static bool has(FloatMask mask) { return !hn::AllFalse(FloatTag(), mask); }

  /// One vector of cells, of one row or of two paired rows: their bounds, infinite where there is no cell or no return.
  struct Cells {
    std::int32_t first, next_first;  ///< the cells of the first lane, and of the first one of the other half
    std::uint32_t inside;            ///< bits
    Floats least, greatest;

    void keep(FloatMask present) {
      const Floats infinity = constant(std::numeric_limits<float>::infinity());
      least = hn::IfThenElse(present, least, infinity);
      greatest = hn::IfThenElse(present, greatest, hn::Neg(infinity));
    }
    std::uint32_t cell(int lane) const {
      return static_cast<std::uint32_t>(lane < kHalf ? first + lane : next_first + lane - kHalf);
    }
    std::uint32_t occupied() const { return bits_of(hn::Le(least, greatest)); }
  };

  /// Of all cells together. No branch depends on a single row, as it could not be predicted.
  struct Bounds {
    Bounds() {
      least = inside_least = off = constant(std::numeric_limits<float>::infinity());
      greatest = inside_greatest = hn::Neg(least);
      open = hn::FirstN(FloatTag(), 0);
    }

    HWY_INLINE void add(const Cells& cells, const RangeBand& band) {
      const FloatMask inside = mask_of(cells.inside);
      const Floats off_rho =
          hn::Min(hn::Abs(hn::Sub(cells.least, band.rho)), hn::Abs(hn::Sub(cells.greatest, band.rho)));
      off = hn::IfThenElse(inside, hn::Min(off, off_rho), off);
      inside_least = hn::IfThenElse(inside, hn::Min(inside_least, cells.least), inside_least);
      inside_greatest = hn::IfThenElse(inside, hn::Max(inside_greatest, cells.greatest), inside_greatest);
      least = hn::Min(least, cells.least);
      greatest = hn::Max(greatest, cells.greatest);
      open = hn::Or(open, hn::And(hn::Lt(cells.least, band.far), hn::Gt(cells.greatest, band.near)));
    }
    bool settle(const RangeBand& band) const { return has(hn::Lt(off, band.within)); }
    bool may_lie_in_band() const { return has(open); }

    Floats least, greatest, inside_least, inside_greatest;
    Floats off;      ///< the least distance of a bound inside from the point's range
    FloatMask open;  ///< whose returns may lie in the band
  };

  /// What of them matters when only free is asked for.
  struct LeastBounds {
    LeastBounds() { least = inside_least = constant(std::numeric_limits<float>::infinity()); }

    HWY_INLINE void add(const Cells& cells, const RangeBand&) {
      inside_least = hn::IfThenElse(mask_of(cells.inside), hn::Min(inside_least, cells.least), inside_least);
      least = hn::Min(least, cells.least);
    }
    bool settle(const RangeBand& band) const { return has(band.denies_free(inside_least)); }

    Floats least, inside_least;
  };

  /// Looks at the middle rows first, where most is settled.
  template <class SomeBounds>
  HWY_INLINE void look_at_all(SomeBounds& all) const {
    if (spans_.are_paired()) {
      look_at_lines((spans_.rows() + 1) / 2, all,
                    [&](std::size_t pair) HWY_ATTR { all.add(pair_of_rows(pair), band_); });
    } else {
      look_at_lines(spans_.rows(), all, [&](std::size_t row) HWY_ATTR {
        for_each_vector_of(row, [&](const Cells& cells) HWY_ATTR { all.add(cells, band_); });
      });
    }
  }

  template <class SomeBounds, class Look>
  HWY_INLINE void look_at_lines(std::size_t lines, const SomeBounds& all, Look look) const {
    const std::size_t begin = lines / 3, end = lines - lines / 3;
    for (std::size_t line = begin; line < end; ++line) look(line);
    if (all.settle(band_)) return;
    for (std::size_t line = 0; line < begin; ++line) look(line);
    for (std::size_t line = end; line < lines; ++line) look(line);
  }

  /// Calls `visit(Cells)` for all vectors of cells.
  template <class Visit>
  HWY_INLINE void for_each_vector(Visit visit) const {
    if (spans_.are_paired()) {
      for (std::size_t pair = 0; pair < (spans_.rows() + 1) / 2; ++pair) visit(pair_of_rows(pair));
    } else {
      for (std::size_t row = 0; row < spans_.rows(); ++row) for_each_vector_of(row, visit);
    }
  }

  /// The same for one row.
  template <class Visit>
  HWY_INLINE void for_each_vector_of(std::size_t row, Visit visit) const {
    const FloatTag d;
    const ConeSpans::Span span = spans_.span(row, lane_);
    for (std::int32_t k = 0; k < span.count; k += static_cast<std::int32_t>(hn::Lanes(d))) {
      const std::int32_t first = span.first + k;
      Cells cells{first, first + kHalf, span.inside >> k, hn::LoadU(d, index_.least_m.data() + first),
                  hn::LoadU(d, index_.greatest_m.data() + first)};
      cells.keep(hn::FirstN(d, static_cast<std::size_t>(span.count - k)));
      visit(cells);
    }
  }

  HWY_INLINE Cells pair_of_rows(std::size_t pair) const {
    const FloatTag d;
    const ConeSpans::PairedSpan span = spans_.paired_span(pair, lane_);
#if HWY_TARGET != HWY_SCALAR
    const hn::Half<FloatTag> dh;
    const auto load = [&](const float* bounds) HWY_ATTR {
      return hn::Combine(d, hn::LoadU(dh, bounds + span.next_first), hn::LoadU(dh, bounds + span.first));
    };
#else
    const auto load = [&](const float* bounds) { return hn::LoadU(d, bounds + span.first); };
#endif
    Cells cells{span.first, span.next_first, span.inside, load(index_.least_m.data()), load(index_.greatest_m.data())};
    cells.keep(mask_of(span.present));
    return cells;
  }

  /// Lists the cells whose returns can make a difference to an answer.
  HWY_NOINLINE void list_cells_of_interest(bool with_nearer, bool with_farther, Remains& remains) const {
    list_cells(remains, [&](const Cells& cells) HWY_ATTR {
      std::uint32_t listed = bits_of(hn::And(hn::Lt(cells.least, band_.far), hn::Gt(cells.greatest, band_.near)));
      if (with_nearer) listed |= bits_of(hn::Le(cells.least, band_.near)) & ~cells.inside;
      if (with_farther) listed |= bits_of(hn::Ge(cells.greatest, band_.far)) & ~cells.inside;
      if (with_nearer || with_farther) return listed;
      std::uint32_t open = listed;
      for (std::uint32_t bits = listed; bits != 0; bits &= bits - 1) {
        if (is_settled(cells.cell(std::countr_zero(bits)))) open &= ~(bits & (~bits + 1));
      }
      return open;
    });
  }

  /// Lists the cells that `choose(Cells)` names, as bits.
  template <class Choose>
  HWY_INLINE void list_cells(Remains& remains, Choose choose) const {
    for_each_vector([&](const Cells& cells) HWY_ATTR {
      for (std::uint32_t bits = choose(cells); bits != 0; bits &= bits - 1) {
        remains.add(cells.cell(std::countr_zero(bits)));
      }
    });
  }

  /// A cell of no more than two returns, neither of which lies in the band: the bounds are all that there is of them.
  bool is_settled(std::uint32_t cell) const {
    return index_.first[cell + 1] - index_.first[cell] <= 2 && index_.least_m[cell] <= hn::GetLane(band_.near) &&
           index_.greatest_m[cell] >= hn::GetLane(band_.far);
  }

  /// Whether occupied cells inside lie to every side of the axis.
  bool is_surrounded() const {
    bool west = false, east = false, south = false, north = false;
    for (std::size_t row = 0; row < spans_.rows(); ++row) {
      // A row that only cones of other lanes touch may be none of the grid's.
      const ConeSpans::Span span = spans_.span(row, lane_);
      if (span.count == 0) continue;
      const ConeSpans::Sides sides = spans_.sides(row, lane_);
      for_each_vector_of(row, [&](const Cells& cells) HWY_ATTR {
        const std::uint32_t inside = cells.inside & cells.occupied();
        if (inside == 0) return;
        const std::int32_t column = cells.first - span.first;
        west |= column + std::countr_zero(inside) < sides.west_end;
        east |= column + 31 - std::countl_zero(inside) >= sides.east_first;
        south |= sides.is_south;
        north |= sides.is_north;
      });
    }
    return west && east && south && north;
  }

  const PriorIndex::Impl& index_;
  const ConeSpans& spans_;
  std::size_t lane_;
  RangeBand band_;
};

}  // namespace raywatch::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
