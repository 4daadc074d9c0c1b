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

  FloatMask supports(Floats least, Floats greatest) const {
    return hn::Or(hn::Lt(hn::Abs(hn::Sub(least, rho)), within), hn::Lt(hn::Abs(hn::Sub(greatest, rho)), within));
  }

  Floats rho, within, near, far;
};

inline std::uint32_t bits_of(FloatMask mask) {
  std::uint8_t bytes[8] = {};
  hn::StoreMaskBits(FloatTag(), mask, bytes);
  std::uint32_t bits;
  std::memcpy(&bits, bytes, sizeof bits);
  return bits;
}

/// What the bounds of one vector of cells, next to each other in a row, say about one point.
struct CellMasks {
  CellMasks(const PriorIndex::Impl& index, const RangeBand& band, const ConeSpans::Span& span, std::int32_t k) {
    const FloatTag d;
    const IntTag di;
    const Ints column = hn::Iota(di, 0);
    const auto below = [&](std::int32_t bound) { return hn::RebindMask(d, hn::Lt(column, hn::Set(di, bound - k))); };
    const Floats least = hn::LoadU(d, index.least_m.data() + span.first + k);
    const Floats greatest = hn::LoadU(d, index.greatest_m.data() + span.first + k);
    full = hn::And(below(span.count), hn::Le(least, greatest));
    inside = hn::AndNot(below(span.inner_first), hn::And(full, below(span.inner_end)));
    border = hn::AndNot(inside, full);
    all_nearer = hn::Le(greatest, band.near);
    all_farther = hn::Ge(least, band.far);
    some_nearer = hn::Le(least, band.near);
    some_farther = hn::Ge(greatest, band.far);
    supports = hn::And(inside, band.supports(least, greatest));
    open = hn::AndNot(hn::Or(all_nearer, all_farther), full);
  }

  FloatMask full, inside, border;
  FloatMask all_nearer, all_farther, some_nearer, some_farther;
  FloatMask supports;
  FloatMask open;  ///< whose returns may lie in the band
};

/// Looks at the bounds of all cells that the cone of one point touches.
class ConeWindow {
 public:
  ConeWindow(const PriorIndex::Impl& index, const ConeSpans& spans, std::size_t lane, float range_m, double threshold_m)
      : index_(index), spans_(spans), lane_(lane), band_(constant(range_m), threshold_m) {}

  /// The answer, if bounds alone decide it; else none, and `remains` says what is left to be looked at.
  std::optional<Answer> look(Remains& remains) {
    remains.count = 0;
    remains.is_complete = spans_.fits(lane_);
    if (!remains.is_complete) return std::nullopt;
    // The middle rows first, where most support is. No branch depends on a single row: it could not be predicted.
    const std::size_t rows = spans_.rows(), begin = rows / 3, end = rows - rows / 3;
    Sums sums;
    for (std::size_t row = begin; row < end; ++row) look_at_row(row, sums);
    if (has(sums.supports)) return Answer::supported;
    for (std::size_t row = 0; row < begin; ++row) look_at_row(row, sums);
    for (std::size_t row = end; row < rows; ++row) look_at_row(row, sums);
    if (has(sums.supports)) return Answer::supported;
    Evidence& inside = remains.evidence;
    inside = {.any = has(sums.any), .not_farther = has(sums.not_farther), .not_nearer = has(sums.not_nearer)};
    const bool is_nearer = inside.any && inside.not_farther, is_farther = inside.any && inside.not_nearer;
    const bool borders_matter =
        (!is_nearer && has(sums.border_nearer)) || (!is_farther && has(sums.border_farther)) || has(sums.open);
    if (!borders_matter) {
      if (!inside.any) return Answer::unseen;
      if (is_nearer) return is_farther ? Answer::ambiguous : Answer::occluded;
    }
    list_cells(!is_nearer, !is_farther, remains);
    if (!borders_matter && remains.is_surrounded) return Answer::free;
    return std::nullopt;
  }

 private:
  static bool has(FloatMask mask) { return !hn::AllFalse(FloatTag(), mask); }

  struct Sums {
    Sums() {
      any = supports = open = hn::FirstN(FloatTag(), 0);
      not_farther = not_nearer = border_nearer = border_farther = any;
    }
    FloatMask any, supports, open, not_farther, not_nearer, border_nearer, border_farther;
  };

  template <class Visit>
  HWY_INLINE void for_each_vector_of(std::size_t row, Visit visit) const {
    const ConeSpans::Span span = spans_.span(row, lane_);
    for (std::int32_t k = 0; k < span.count; k += static_cast<std::int32_t>(hn::Lanes(FloatTag()))) {
      visit(CellMasks(index_, band_, span, k), span, k);
    }
  }

  HWY_INLINE void look_at_row(std::size_t row, Sums& sums) const {
    for_each_vector_of(row, [&](const CellMasks& cells, const ConeSpans::Span&, std::int32_t) HWY_ATTR {
      sums.supports = hn::Or(sums.supports, cells.supports);
      sums.open = hn::Or(sums.open, cells.open);
      sums.any = hn::Or(sums.any, cells.inside);
      sums.not_farther = hn::Or(sums.not_farther, hn::And(cells.inside, cells.some_nearer));
      sums.not_nearer = hn::Or(sums.not_nearer, hn::And(cells.inside, cells.some_farther));
      sums.border_nearer = hn::Or(sums.border_nearer, hn::And(cells.border, cells.all_nearer));
      sums.border_farther = hn::Or(sums.border_farther, hn::And(cells.border, cells.all_farther));
    });
  }

  /// Lists the cells whose returns can make a difference, and finds whether cells inside lie to every side of the axis.
  HWY_NOINLINE void list_cells(bool with_nearer, bool with_farther, Remains& remains) const {
    bool west = false, east = false, south = false, north = false;
    for (std::size_t row = 0; row < spans_.rows(); ++row) {
      for_each_vector_of(row, [&](const CellMasks& cells, const ConeSpans::Span& span, std::int32_t k) {
        FloatMask listed = cells.open;
        if (with_nearer) listed = hn::Or(listed, hn::And(cells.border, cells.all_nearer));
        if (with_farther) listed = hn::Or(listed, hn::And(cells.border, cells.all_farther));
        for (std::uint32_t bits = bits_of(listed); bits != 0; bits &= bits - 1) {
          remains.add(static_cast<std::uint32_t>(span.first + k + std::countr_zero(bits)));
        }
        const std::uint32_t inside = bits_of(cells.inside);
        if (inside == 0) return;
        west |= k + std::countr_zero(inside) < span.west_end;
        east |= k + 31 - std::countl_zero(inside) >= span.east_first;
        south |= spans_.side(row, lane_) < 0;
        north |= spans_.side(row, lane_) > 0;
      });
    }
    remains.is_surrounded = west && east && south && north;
  }

  const PriorIndex::Impl& index_;
  const ConeSpans& spans_;
  std::size_t lane_;
  RangeBand band_;
};

}  // namespace raywatch::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
