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
  std::optional<Answer> look(Remains& remains) {
    remains.count = 0;
    remains.is_complete = spans_.fits(lane_);
    if (!remains.is_complete) return std::nullopt;
    Bounds all;
    if (spans_.are_paired()) {
      look_at_rows((spans_.rows() + 1) / 2, all,
                   [this](std::size_t pair, Bounds& sum) HWY_ATTR { look_at_pair(pair, sum); });
    } else {
      look_at_rows(spans_.rows(), all, [this](std::size_t row, Bounds& sum) HWY_ATTR { look_at_row(row, sum); });
    }
    if (is_supported(all)) return Answer::supported;
    const bool is_nearer = has(hn::Le(all.inside_least, band_.near));
    const bool is_farther = has(hn::Ge(all.inside_greatest, band_.far));
    const bool any = is_nearer || is_farther || has(hn::Le(all.inside_least, all.inside_greatest));
    remains.evidence = {.any = any, .not_farther = is_nearer, .not_nearer = is_farther};
    const bool borders_matter = (!is_nearer && has(hn::Le(all.least, band_.near))) ||
                                (!is_farther && has(hn::Ge(all.greatest, band_.far))) || has(all.open);
    if (!borders_matter) {
      if (!any) return Answer::unseen;
      if (is_nearer) return is_farther ? Answer::ambiguous : Answer::occluded;
    }
    list_cells(!is_nearer, !is_farther, remains);
    if (is_nearer && remains.count == 0) return is_farther ? Answer::ambiguous : Answer::occluded;
    if (!borders_matter && remains.is_surrounded) return Answer::free;
    return std::nullopt;
  }

 private:
  static bool has(FloatMask mask) { return !hn::AllFalse(FloatTag(), mask); }

  /// Of all cells together: bounds of ranges, also of the cells inside alone, the least distance of those from the
  /// point's range, and whether returns of a cell may lie in the band.
  struct Bounds {
    Bounds() {
      least = inside_least = off = constant(std::numeric_limits<float>::infinity());
      greatest = inside_greatest = hn::Neg(least);
      open = hn::FirstN(FloatTag(), 0);
    }
    Floats least, greatest, inside_least, inside_greatest, off;
    FloatMask open;
  };

  bool is_supported(const Bounds& all) const { return has(hn::Lt(all.off, band_.within)); }

  /// The bounds of one vector of cells; infinite where there is no cell or no return.
  struct Cells {
    Cells(Floats any_least, Floats any_greatest, FloatMask present, FloatMask in, const RangeBand& band)
        : least(hn::IfThenElse(present, any_least, constant(std::numeric_limits<float>::infinity()))),
          greatest(hn::IfThenElse(present, any_greatest, constant(-std::numeric_limits<float>::infinity()))),
          inside(in),
          open(hn::And(hn::Lt(least, band.far), hn::Gt(greatest, band.near))) {}
    Floats least, greatest;
    FloatMask inside;
    FloatMask open;  ///< whose returns may lie in the band
  };

  /// The middle rows first, where most support is. No branch depends on a single row: it could not be predicted.
  template <class Look>
  HWY_INLINE void look_at_rows(std::size_t rows, Bounds& all, Look look) const {
    const std::size_t begin = rows / 3, end = rows - rows / 3;
    for (std::size_t row = begin; row < end; ++row) look(row, all);
    if (is_supported(all)) return;
    for (std::size_t row = 0; row < begin; ++row) look(row, all);
    for (std::size_t row = end; row < rows; ++row) look(row, all);
  }

  HWY_INLINE void look_at_pair(std::size_t pair, Bounds& all) const {
#if HWY_TARGET != HWY_SCALAR
    const FloatTag d;
    const hn::Half<FloatTag> dh;
    const ConeSpans::PairedSpan span = spans_.paired_span(pair, lane_);
    const float *least = index_.least_m.data(), *greatest = index_.greatest_m.data();
    add(Cells(hn::Combine(d, hn::LoadU(dh, least + span.next_first), hn::LoadU(dh, least + span.first)),
              hn::Combine(d, hn::LoadU(dh, greatest + span.next_first), hn::LoadU(dh, greatest + span.first)),
              mask_of(span.present), mask_of(span.inside), band_),
        all);
#else
    HWY_ASSERT(false && pair && &all);
#endif
  }

  HWY_INLINE void look_at_row(std::size_t row, Bounds& all) const {
    for_each_vector_of(row, [&](const Cells& cells, std::int32_t) HWY_ATTR { add(cells, all); });
  }

  /// Calls `visit(cells, k)` for the vectors of cells of a row; the first cell of each is the k-th of the row.
  template <class Visit>
  HWY_INLINE void for_each_vector_of(std::size_t row, Visit visit) const {
    const FloatTag d;
    const ConeSpans::Span span = spans_.span(row, lane_);
    const float *least = index_.least_m.data() + span.first, *greatest = index_.greatest_m.data() + span.first;
    for (std::int32_t k = 0; k < span.count; k += static_cast<std::int32_t>(hn::Lanes(d))) {
      visit(Cells(hn::LoadU(d, least + k), hn::LoadU(d, greatest + k),
                  hn::FirstN(d, static_cast<std::size_t>(span.count - k)), mask_of(span.inside >> k), band_),
            k);
    }
  }

  HWY_INLINE void add(const Cells& cells, Bounds& all) const {
    const Floats off = hn::Min(hn::Abs(hn::Sub(cells.least, band_.rho)), hn::Abs(hn::Sub(cells.greatest, band_.rho)));
    all.off = hn::IfThenElse(cells.inside, hn::Min(all.off, off), all.off);
    all.inside_least = hn::IfThenElse(cells.inside, hn::Min(all.inside_least, cells.least), all.inside_least);
    all.inside_greatest =
        hn::IfThenElse(cells.inside, hn::Max(all.inside_greatest, cells.greatest), all.inside_greatest);
    all.least = hn::Min(all.least, cells.least);
    all.greatest = hn::Max(all.greatest, cells.greatest);
    all.open = hn::Or(all.open, cells.open);
  }

  /// Lists the cells whose returns can make a difference, and finds whether cells inside lie to every side of the axis.
  HWY_NOINLINE void list_cells(bool with_nearer, bool with_farther, Remains& remains) const {
    bool west = false, east = false, south = false, north = false;
    for (std::size_t row = 0; row < spans_.rows(); ++row) {
      const ConeSpans::Span span = spans_.span(row, lane_);
      if (span.count == 0) continue;  // a row that only cones of other lanes touch, and which the grid may not have
      const ConeSpans::Sides sides = spans_.sides(row, lane_);
      for_each_vector_of(row, [&](const Cells& cells, std::int32_t k) HWY_ATTR {
        const FloatMask full = hn::Le(cells.least, cells.greatest), border = hn::AndNot(cells.inside, full);
        FloatMask listed = cells.open;
        if (!with_nearer && !with_farther) listed = hn::AndNot(are_settled(cells, span.first + k), listed);
        if (with_nearer) listed = hn::Or(listed, hn::And(border, hn::Le(cells.greatest, band_.near)));
        if (with_farther) listed = hn::Or(listed, hn::And(border, hn::Ge(cells.least, band_.far)));
        for (std::uint32_t bits = bits_of(listed); bits != 0; bits &= bits - 1) {
          remains.add(static_cast<std::uint32_t>(span.first + k + std::countr_zero(bits)));
        }
        const std::uint32_t inside = bits_of(hn::And(cells.inside, full));
        if (inside == 0) return;
        west |= k + std::countr_zero(inside) < sides.west_end;
        east |= k + 31 - std::countl_zero(inside) >= sides.east_first;
        south |= sides.is_south;
        north |= sides.is_north;
      });
    }
    remains.is_surrounded = west && east && south && north;
  }

  /// The cells of no more than two returns, none of which lies in the band: the bounds are all that there is of them.
  HWY_INLINE FloatMask are_settled(const Cells& cells, std::int32_t first_cell) const {
    const IntTag di;
    const auto* first = reinterpret_cast<const std::int32_t*>(index_.first.data()) + first_cell;
    const Ints returns = hn::Sub(hn::LoadU(di, first + 1), hn::LoadU(di, first));
    const FloatMask few = hn::RebindMask(FloatTag(), hn::Lt(returns, hn::Set(di, 3)));
    return hn::And(few, hn::And(hn::Le(cells.least, band_.near), hn::Ge(cells.greatest, band_.far)));
  }

  const PriorIndex::Impl& index_;
  const ConeSpans& spans_;
  std::size_t lane_;
  RangeBand band_;
};

}  // namespace raywatch::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
