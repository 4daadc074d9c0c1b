// Vector code, compiled once for each instruction set: see spherical_simd-inl.hpp.
#if defined(RAYWATCH_CONE_SPANS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef RAYWATCH_CONE_SPANS_INL
#undef RAYWATCH_CONE_SPANS_INL
#else
#define RAYWATCH_CONE_SPANS_INL
#endif

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/ask_kernels.hpp"
#include "core/spherical_simd-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace raywatch::HWY_NAMESPACE {

/// The cells that the cones of one vector of points touch: `Cone::for_each_cell` for vectors, with the same meaning of
/// touched and inside, for cones that are small against the sphere and away from its poles. A row of the grid that
/// some cone touches on both sides of the seam stands here as two rows.
class ConeSpans {
 public:
  static constexpr std::size_t kMostGridRows = 32, kMostRows = 2 * kMostGridRows;
  static constexpr std::int32_t kMostColumns = 31;

  explicit ConeSpans(const PreparedPrior& prior)
      : grid_(prior.index.grid.view()),
        outer_rad_(static_cast<float>(prior.thresholds.angle_rad * (1.0 + 1e-5) + kMargin_rad)),
        inner_rad_(static_cast<float>(prior.thresholds.angle_rad * (1.0 - 1e-5) - kMargin_rad)),
        outer_haversine_(haversine_of(outer_rad_)),
        inner_haversine_(haversine_of(inner_rad_)),
        fits_(prior.thresholds.angle_rad < 0.1 && inner_rad_ > 0.0f &&
              2.0f * outer_rad_ * grid_.rows_per_rad + 2.0f < static_cast<float>(kMostGridRows)) {}

  /// Of one row and one point. `first` counts cells of the whole grid; bit k of `inside` stands for cell `first` + k.
  struct Span {
    std::int32_t first, count;
    std::uint32_t inside;
  };

  /// Every direction in the columns of a span before `west_end` is west of the axis of the cone, in those from
  /// `east_first` on east; and every direction in its row is north of it, or south, or neither is sure.
  struct Sides {
    std::int32_t west_end, east_first;
    bool is_north, is_south;
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
    const Floats turn = hn::MulAdd(azimuth, constant(0.5f * std::numbers::inv_pi_v<float>), constant(0.5f));
    unfit_ = hn::FirstN(d, 0);
    rows_ = 0;
    most_columns_ = hn::Zero(IntTag());
    for (std::uint8_t step = 0; step < kMostGridRows; ++step) {
      const Floats row = hn::Add(low, constant(step));
      const FloatMask active = hn::And(present, hn::Le(row, high));
      if (hn::AllFalse(d, active)) break;
      find_in_row(row, step, active, turn, elevation, cosine);
    }
    pair_rows();
    hn::Store(hn::IfThenElseZero(unfit_, constant(1.0f)), d, is_unfit_);
    hn::Store(low, d, low_);
    hn::Store(turn, d, turn_);
    hn::Store(elevation, d, elevation_rad_);
    hn::Store(cosine, d, cosine_);
  }

  std::size_t rows() const { return rows_; }
  Span span(std::size_t row, std::size_t lane) const {
    return {first_[row][lane], count_[row][lane], static_cast<std::uint32_t>(inside_[row][lane])};
  }
  /// Two rows of one point in one vector of cells: the first half of the lanes, and bits, stands for row 2 * `pair`,
  /// the other for the next. Only when all rows of all points are that short.
  struct PairedSpan {
    std::int32_t first, next_first;
    std::uint32_t present, inside;
  };
  bool are_paired() const { return are_paired_; }
  PairedSpan paired_span(std::size_t pair, std::size_t lane) const {
    return {first_[2 * pair][lane], first_[2 * pair + 1][lane], static_cast<std::uint32_t>(paired_present_[pair][lane]),
            static_cast<std::uint32_t>(paired_inside_[pair][lane])};
  }

  /// Of one row and all points.
  Ints first(std::size_t row) const { return hn::Load(IntTag(), first_[row]); }
  Ints count(std::size_t row) const { return hn::Load(IntTag(), count_[row]); }

  bool fits(std::size_t lane) const { return fits_ && is_unfit_[lane] == 0.0f; }
  FloatMask fits() const { return fits_ ? hn::Not(unfit_) : hn::FirstN(FloatTag(), 0); }

  /// @param row one that the cone of that lane touches: its span is not empty
  Sides sides(std::size_t row, std::size_t lane) const {
    const std::size_t grid_row = static_cast<std::size_t>(low_[lane]) + steps_[row];
    const float columns = grid_.columns[grid_row], rounding = 1e-6f * columns + 0.01f;
    const std::int32_t first = first_[row][lane] - static_cast<std::int32_t>(grid_.first[grid_row]);
    float center = turn_[lane] * columns;
    if (is_beyond_seam_[row]) center += static_cast<float>(first) > center ? columns : -columns;
    const float bottom_rad = grid_.low_rad + static_cast<float>(grid_row) * grid_.cell_rad;
    // North and south turn over not exactly at the elevation of the point but, off its meridian, a little beside it.
    const float tangent = std::abs(elevation_rad_[lane]) / std::max(cosine_[lane], 1e-6f);
    const float tilt_rad = outer_rad_ * outer_rad_ * tangent + 4e-6f;
    return {.west_end = static_cast<std::int32_t>(std::floor(center - rounding)) - first,
            .east_first = static_cast<std::int32_t>(std::floor(center + rounding + 1.0f)) - first,
            .is_north = bottom_rad - elevation_rad_[lane] > tilt_rad,
            .is_south = elevation_rad_[lane] - (bottom_rad + grid_.cell_rad) > tilt_rad};
  }

 private:
  static constexpr double kMargin_rad = 8.0 * kDirectionError_rad;

  static float haversine_of(float angle_rad) { return hn::GetLane(haversine(constant(angle_rad))); }
  static Floats haversine(Floats angle) {  // of angles below 0.3
    const Floats s = hn::Mul(angle, angle);
    const Floats series = hn::NegMulAdd(s, constant(1.0f / 360.0f), constant(1.0f / 12.0f));
    return hn::Mul(hn::Mul(s, constant(0.25f)), hn::NegMulAdd(s, series, constant(1.0f)));
  }

  /// The angle of which `value` / `scale` is the haversine, below `kMostHaversine`, within `kRootError` of it; 0 when
  /// `value` is negative.
  struct Angle {
    Floats rad, haversine;
  };
  static constexpr float kRootError = 1e-3f;
  static constexpr float kMostHaversine = 0.2f;
  static Angle angle_of_haversine(Floats value, Floats scale) {
    const Floats least = constant(1e-15f);
    const Floats root = hn::ApproximateReciprocalSqrt(hn::Max(hn::Mul(value, scale), hn::Mul(least, least)));
    const Floats sine = hn::Mul(hn::Max(value, hn::Zero(FloatTag())), root);
    const Floats q = hn::Mul(sine, sine);
    const Floats high = hn::MulAdd(q, constant(15.0f / 336.0f), constant(3.0f / 40.0f));
    const Floats series = hn::MulAdd(q, high, constant(1.0f / 6.0f));
    return {hn::Mul(hn::Add(sine, sine), hn::MulAdd(q, series, constant(1.0f))), q};
  }

  void pair_rows() {
    const IntTag di;
    constexpr int kHalf = static_cast<int>(kMostLanes / 2);
    are_paired_ = HWY_TARGET != HWY_SCALAR && hn::AllFalse(di, hn::Gt(most_columns_, hn::Set(di, kHalf)));
    if (!are_paired_) return;
    const Ints zero = hn::Zero(di), ones = hn::Set(di, 1);
    hn::Store(zero, di, first_[rows_]);
    hn::Store(zero, di, count_[rows_]);
    hn::Store(zero, di, inside_[rows_]);
    const auto present = [&](std::size_t row) { return hn::Sub(hn::Shl(ones, count(row)), ones); };
    const auto inside = [&](std::size_t row) { return hn::Load(di, inside_[row]); };
    for (std::size_t row = 0; row < rows_; row += 2) {
      hn::Store(hn::Or(present(row), hn::ShiftLeft<kHalf>(present(row + 1))), di, paired_present_[row / 2]);
      hn::Store(hn::Or(inside(row), hn::ShiftLeft<kHalf>(inside(row + 1))), di, paired_inside_[row / 2]);
    }
  }

  /// As `outer_columns` and `inner_columns` of `Cone`, but with bounds of the cosines in the row that follow from its
  /// number of columns c: c - 1 < 2 pi / cell * greatest <= c, and the least is smaller by at most a cell.
  void find_in_row(Floats row, std::uint8_t step, FloatMask active, Floats turn, Floats elevation, Floats cosine) {
    constexpr float kTurn = 2.0f * std::numbers::pi_v<float>;
    const FloatTag d;
    const Floats zero = hn::Zero(d), one = constant(1.0f);
    const Floats highest = constant(static_cast<float>(grid_.rows - 1));  // rows that no lane is active in may be none
    const auto [columns, base] = RowEntries(grid_, hn::ConvertTo(IntTag(), hn::Min(row, highest)));
    const Floats bottom = hn::MulAdd(row, constant(grid_.cell_rad), constant(grid_.low_rad));
    const Floats above = hn::Sub(bottom, elevation);
    const Floats below = hn::Sub(elevation, hn::Add(bottom, constant(grid_.cell_rad)));
    const Floats nearest = hn::Max(zero, hn::Max(above, below));
    const Floats farthest = hn::Max(hn::Abs(above), hn::Abs(below));
    const Floats outer = hn::Sub(constant(outer_haversine_), haversine(nearest));
    const Floats inner = hn::Sub(constant(inner_haversine_), haversine(farthest));
    const Floats scale = hn::Mul(cosine, constant(grid_.cell_rad * (1.0f / kTurn)));
    const Floats least = hn::Max(hn::Sub(columns, constant(1.001f + kTurn)), constant(1e-3f));
    const Angle outer_angle = angle_of_haversine(outer, hn::Mul(scale, least));
    const Angle inner_angle = angle_of_haversine(inner, hn::Mul(scale, columns));
    const Floats per_rad = hn::Mul(columns, constant(1.0f / kTurn));
    const Floats margin = constant(static_cast<float>(kMargin_rad));
    const Floats outer_columns = hn::Mul(hn::MulAdd(outer_angle.rad, constant(1.0f + kRootError), margin), per_rad);
    const Floats inner_columns = hn::Mul(hn::MulSub(inner_angle.rad, constant(1.0f - kRootError), margin), per_rad);
    const Floats center = hn::Mul(turn, columns);
    const Floats first = hn::Floor(hn::Sub(center, outer_columns));
    const Floats end = hn::Add(hn::Floor(hn::Add(center, outer_columns)), one);
    const FloatMask touches = hn::And(active, hn::Ge(outer, zero));
    const FloatMask wraps = hn::And(touches, hn::Or(hn::Lt(first, zero), hn::Gt(end, columns)));
    const Floats most = hn::Min(constant(static_cast<float>(kMostColumns)), columns);
    const FloatMask is_wide =
        hn::Or(hn::Gt(outer_angle.haversine, constant(0.99f * kMostHaversine)), hn::Gt(hn::Sub(end, first), most));
    unfit_ = hn::Or(unfit_, hn::And(touches, is_wide));
    const FloatMask usable = hn::AndNot(unfit_, touches);
    const FloatMask has_inside = hn::And(hn::Gt(inner, zero), usable);
    const Floats inner_first = hn::Max(first, hn::Ceil(hn::Sub(center, inner_columns)));
    const Floats inner_end = hn::Min(end, hn::Floor(hn::Add(center, inner_columns)));
    const Reach reach{first, end, inner_first, inner_end, usable, has_inside};
    add_row(reach.part(zero, columns), base, step, false);
    if (hn::AllFalse(d, hn::And(wraps, usable))) return;
    const Floats turned = hn::IfThenElse(hn::Lt(first, zero), columns, hn::Neg(columns));
    const Reach beyond{hn::Add(first, turned),     hn::Add(end, turned),   hn::Add(inner_first, turned),
                       hn::Add(inner_end, turned), hn::And(usable, wraps), hn::And(has_inside, wraps)};
    add_row(beyond.part(zero, columns), base, step, true);
  }

  /// Columns first..end - 1 of one row that cones touch, and those inside of them, where the masks say so.
  struct Reach {
    Floats first, end, inner_first, inner_end;
    FloatMask present, has_inside;

    /// What lies in columns `from`..`to` - 1.
    Reach part(Floats from, Floats to) const {
      Reach result{hn::Max(first, from),   hn::Min(end, to), hn::Max(inner_first, from),
                   hn::Min(inner_end, to), present,          has_inside};
      result.present = hn::And(present, hn::Lt(result.first, result.end));
      result.has_inside = hn::And(hn::And(has_inside, result.present), hn::Lt(result.inner_first, result.inner_end));
      return result;
    }
  };

  /// @param base first cell of the row. @param step its place above the lowest row of each cone
  void add_row(const Reach& reach, Ints base, std::uint8_t step, bool is_beyond_seam) {
    const IntTag di;
    // Whole numbers below 2^23 stand in the mantissa of their sum with it.
    const Floats two23 = constant(8388608.0f);
    const auto as_int = [&](Floats value) HWY_ATTR {
      return hn::Sub(hn::BitCast(di, hn::Add(hn::IfThenElseZero(reach.present, value), two23)), hn::BitCast(di, two23));
    };
    const Ints ones = hn::Set(di, 1);
    const Ints inside = hn::Sub(hn::Shl(ones, as_int(hn::Sub(reach.inner_end, reach.first))),
                                hn::Shl(ones, as_int(hn::Sub(reach.inner_first, reach.first))));
    const Ints count = as_int(hn::Sub(reach.end, reach.first));
    most_columns_ = hn::Max(most_columns_, count);
    hn::Store(hn::Add(base, as_int(reach.first)), di, first_[rows_]);
    hn::Store(count, di, count_[rows_]);
    hn::Store(hn::IfThenElseZero(hn::RebindMask(di, reach.has_inside), inside), di, inside_[rows_]);
    steps_[rows_] = step;
    is_beyond_seam_[rows_] = is_beyond_seam;
    ++rows_;
  }

  DirectionGridView grid_;
  float outer_rad_, inner_rad_;
  float outer_haversine_, inner_haversine_;
  bool fits_;
  std::size_t rows_ = 0;
  FloatMask unfit_ = hn::FirstN(FloatTag(), 0);
  HWY_ALIGN float is_unfit_[kMostLanes] = {};
  HWY_ALIGN float low_[kMostLanes], turn_[kMostLanes], elevation_rad_[kMostLanes], cosine_[kMostLanes];
  HWY_ALIGN std::int32_t first_[kMostRows + 1][kMostLanes], count_[kMostRows + 1][kMostLanes];
  HWY_ALIGN std::int32_t inside_[kMostRows + 1][kMostLanes];  // bits
  std::uint8_t steps_[kMostRows];                             ///< of each row above the lowest of its cone
  bool is_beyond_seam_[kMostRows];
  bool are_paired_ = false;
  Ints most_columns_ = hn::Zero(IntTag());
  HWY_ALIGN std::int32_t paired_present_[kMostRows / 2][kMostLanes], paired_inside_[kMostRows / 2][kMostLanes];
};

}  // namespace raywatch::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
