// Vector code, compiled once for each instruction set: see spherical_simd-inl.hpp.
#if defined(RAYWATCH_CONE_SPANS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef RAYWATCH_CONE_SPANS_INL
#undef RAYWATCH_CONE_SPANS_INL
#else
#define RAYWATCH_CONE_SPANS_INL
#endif

#include <algorithm>
#include <cstring>

#include "core/ask_kernels.hpp"
#include "core/spherical_simd-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace raywatch::HWY_NAMESPACE {

/// The cells that the cones of one vector of points touch: `Cone::for_each_row` for vectors, with the same meaning of
/// touched and inside, for cones that are small against the sphere and away from its poles and the seam.
class ConeSpans {
 public:
  static constexpr std::size_t kMostRows = 24;

  explicit ConeSpans(const PreparedPrior& prior)
      : grid_(prior.index.grid.view()),
        outer_rad_(static_cast<float>(prior.thresholds.angle_rad * (1.0 + 1e-5) + kMargin_rad)),
        inner_rad_(static_cast<float>(prior.thresholds.angle_rad * (1.0 - 1e-5) - kMargin_rad)),
        fits_(prior.thresholds.angle_rad < 0.1 && inner_rad_ > 0.0f &&
              2.0f * outer_rad_ * grid_.rows_per_rad + 2.0f < static_cast<float>(kMostRows)) {}

  static constexpr std::int32_t kMostColumns = 32;

  /// Of one row and one point. `first` counts cells of the whole grid, the others columns from there. Every direction
  /// in the columns before `west_end` is west of the axis of the cone, in those from `east_first` on east.
  struct Span {
    std::int32_t first, count, inner_first, inner_end, west_end, east_first;
  };

  /// Finds the spans of the first `count` lanes. @param cosine of the elevation
  void find(Floats azimuth, Floats elevation, Floats cosine, std::size_t count) {
    const FloatTag d;
    if (!fits_) return;
    const FloatMask present = hn::FirstN(d, count);
    const auto row_of = [&](Floats angle) {
      return hn::Floor(hn::Mul(hn::Sub(angle, constant(grid_.low_rad)), constant(grid_.rows_per_rad)));
    };
    const Floats reach = constant(outer_rad_);
    const Floats low = hn::Max(row_of(hn::Sub(elevation, reach)), hn::Zero(d));
    const Floats high = hn::Min(row_of(hn::Add(elevation, reach)), constant(static_cast<float>(grid_.rows - 1)));
    unfit_ = hn::FirstN(d, 0);
    rows_ = 0;
    // North and south turn over not exactly at the elevation of the point but, off its meridian, a little beside it.
    const Floats tangent = hn::Div(hn::Abs(elevation), hn::Max(cosine, constant(1e-6f)));
    tilt_ = hn::MulAdd(constant(outer_rad_ * outer_rad_), tangent, constant(4e-6f));
    for (Floats row = low; rows_ < kMostRows; row = hn::Add(row, constant(1.0f)), ++rows_) {
      const FloatMask active = hn::And(present, hn::Le(row, high));
      if (hn::AllFalse(d, active)) break;
      find_in_row(row, active, azimuth, elevation, cosine);
    }
    hn::Store(hn::IfThenElseZero(unfit_, constant(1.0f)), d, is_unfit_);
  }

  std::size_t rows() const { return rows_; }
  /// Of one row and all points: the first cell of the whole grid, and the number of cells.
  Ints first(std::size_t row) const { return hn::Load(IntTag(), first_[row]); }
  Ints count(std::size_t row) const { return hn::Load(IntTag(), count_[row]); }
  Span span(std::size_t row, std::size_t lane) const {
    return {first_[row][lane],     count_[row][lane],    inner_first_[row][lane],
            inner_end_[row][lane], west_end_[row][lane], east_first_[row][lane]};
  }
  /// 1: every direction in the row is north of the point; -1: south; 0: neither is sure.
  std::int32_t side(std::size_t row, std::size_t lane) const { return side_[row][lane]; }
  bool fits(std::size_t lane) const { return fits_ && is_unfit_[lane] == 0.0f; }
  FloatMask fits() const { return fits_ ? hn::Not(unfit_) : hn::FirstN(FloatTag(), 0); }

 private:
  static constexpr double kMargin_rad = 8.0 * kDirectionError_rad;

  static Floats haversine(Floats angle) {  // of angles below 0.3
    const Floats s = hn::Mul(angle, angle);
    const Floats series = hn::NegMulAdd(s, constant(1.0f / 360.0f), constant(1.0f / 12.0f));
    return hn::Mul(hn::Mul(s, constant(0.25f)), hn::NegMulAdd(s, series, constant(1.0f)));
  }
  /// The angle whose haversine is `value`, below 0.02; 0 for negative ones.
  static Floats angle_of_haversine(Floats value) {
    const Floats q = hn::Max(value, hn::Zero(FloatTag()));
    const Floats series = hn::MulAdd(q, constant(3.0f / 40.0f), constant(1.0f / 6.0f));
    return hn::Mul(hn::Mul(constant(2.0f), hn::Sqrt(q)), hn::MulAdd(q, series, constant(1.0f)));
  }

  /// As `Cone::widths` and `Cone::columns_of`.
  void find_in_row(Floats row, FloatMask active, Floats azimuth, Floats elevation, Floats cosine) {
    const FloatTag d;
    const IntTag di;
    const Floats zero = hn::Zero(d), one = constant(1.0f);
    const Ints index = hn::ConvertTo(di, hn::IfThenElseZero(active, row));
    const Floats bottom = hn::MulAdd(row, constant(grid_.cell_rad), constant(grid_.low_rad));
    const Floats above = hn::Sub(bottom, elevation);
    const Floats below = hn::Sub(elevation, hn::Add(bottom, constant(grid_.cell_rad)));
    const Floats nearest = hn::Max(zero, hn::Max(above, below));
    const Floats farthest = hn::Max(hn::Abs(above), hn::Abs(below));
    const Floats outer = hn::Sub(haversine(constant(outer_rad_)), haversine(nearest));
    const Floats inner = hn::Sub(haversine(constant(inner_rad_)), haversine(farthest));
    const Floats outer_scale = hn::Mul(cosine, hn::GatherIndex(d, grid_.least_cosine, index));
    const Floats inner_scale = hn::Mul(cosine, hn::GatherIndex(d, grid_.greatest_cosine, index));
    const Floats columns = hn::GatherIndex(d, grid_.columns, index);
    const Floats per_rad = hn::Mul(columns, constant(0.5f * std::numbers::inv_pi_v<float>));
    const Floats margin = constant(static_cast<float>(kMargin_rad));
    const Floats outer_value = hn::Div(outer, hn::Max(outer_scale, constant(1e-12f)));
    const Floats outer_columns = hn::Mul(hn::Add(angle_of_haversine(outer_value), margin), per_rad);
    const Floats inner_angle =
        hn::Sub(angle_of_haversine(hn::Div(inner, hn::Max(inner_scale, constant(1e-12f)))), margin);
    const Floats inner_columns = hn::Mul(inner_angle, per_rad);
    const Floats turn = hn::MulAdd(azimuth, constant(0.5f * std::numbers::inv_pi_v<float>), constant(0.5f));
    const Floats center = hn::Mul(turn, columns);
    const Floats first = hn::Floor(hn::Sub(center, outer_columns)), last = hn::Floor(hn::Add(center, outer_columns));
    const FloatMask touches = hn::And(active, hn::Ge(outer, zero));
    const FloatMask wraps = hn::Or(hn::Lt(first, zero), hn::Ge(last, columns));
    const FloatMask is_wide = hn::Or(hn::Gt(outer_value, constant(0.02f)),
                                     hn::Ge(hn::Sub(last, first), constant(static_cast<float>(kMostColumns))));
    unfit_ = hn::Or(unfit_, hn::And(touches, hn::Or(wraps, is_wide)));
    const FloatMask has_inside = hn::And(hn::Gt(inner, zero), hn::Gt(inner_angle, zero));
    const Floats inner_first = hn::Sub(hn::Max(first, hn::Ceil(hn::Sub(center, inner_columns))), first);
    const Floats inner_end = hn::Sub(hn::Min(hn::Add(last, one), hn::Floor(hn::Add(center, inner_columns))), first);
    const Ints base = hn::GatherIndex(di, reinterpret_cast<const std::int32_t*>(grid_.first), index);
    const FloatMask usable = hn::AndNot(unfit_, touches);
    const auto as_int = [&](Floats value) { return hn::ConvertTo(di, hn::IfThenElseZero(usable, value)); };
    hn::Store(hn::Add(base, as_int(first)), di, first_[rows_]);
    hn::Store(as_int(hn::Add(hn::Sub(last, first), one)), di, count_[rows_]);
    hn::Store(as_int(hn::IfThenElseZero(has_inside, inner_first)), di, inner_first_[rows_]);
    hn::Store(as_int(hn::IfThenElseZero(has_inside, inner_end)), di, inner_end_[rows_]);
    const Floats rounding = hn::MulAdd(columns, constant(1e-6f), constant(0.01f));
    hn::Store(as_int(hn::Sub(hn::Floor(hn::Sub(center, rounding)), first)), di, west_end_[rows_]);
    hn::Store(as_int(hn::Sub(hn::Floor(hn::Add(hn::Add(center, rounding), one)), first)), di, east_first_[rows_]);
    const Floats side =
        hn::Sub(hn::IfThenElseZero(hn::Gt(above, tilt_), one), hn::IfThenElseZero(hn::Gt(below, tilt_), one));
    hn::Store(as_int(side), di, side_[rows_]);
  }

  DirectionGridView grid_;
  float outer_rad_, inner_rad_;
  bool fits_;
  std::size_t rows_ = 0;
  FloatMask unfit_ = hn::FirstN(FloatTag(), 0);
  Floats tilt_ = hn::Zero(FloatTag());
  HWY_ALIGN float is_unfit_[kMostLanes] = {};
  HWY_ALIGN std::int32_t first_[kMostRows][kMostLanes], count_[kMostRows][kMostLanes];
  HWY_ALIGN std::int32_t inner_first_[kMostRows][kMostLanes], inner_end_[kMostRows][kMostLanes];
  HWY_ALIGN std::int32_t west_end_[kMostRows][kMostLanes], east_first_[kMostRows][kMostLanes],
      side_[kMostRows][kMostLanes];
};

}  // namespace raywatch::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
