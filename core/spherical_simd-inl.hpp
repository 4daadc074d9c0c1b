// Vector code that several .cpp files share, compiled once for each instruction set: included after
// hwy/foreach_target.h, therefore without an include guard of the usual kind.
#if defined(RAYWATCH_SPHERICAL_SIMD_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef RAYWATCH_SPHERICAL_SIMD_INL
#undef RAYWATCH_SPHERICAL_SIMD_INL
#else
#define RAYWATCH_SPHERICAL_SIMD_INL
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <numbers>

#include "core/direction_grid.hpp"

HWY_BEFORE_NAMESPACE();
namespace raywatch::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using FloatTag = hn::ScalableTag<float>;
using IntTag = hn::RebindToSigned<FloatTag>;
using Floats = hn::Vec<FloatTag>;
using Ints = hn::Vec<IntTag>;
using FloatMask = hn::Mask<FloatTag>;
constexpr std::size_t kMostLanes = HWY_MAX_BYTES / sizeof(float);

/// Coordinates of one vector of points.
struct Coordinates {
  Floats x, y, z;
};

inline Floats constant(float value) { return hn::Set(FloatTag(), value); }

/// atan2(y, x) within 3e-7 rad; 0 where both are 0.
inline Floats angle_of(Floats y, Floats x) {
  constexpr float kPi = std::numbers::pi_v<float>;
  const Floats ax = hn::Abs(x), ay = hn::Abs(y);
  const Floats low = hn::Min(ax, ay), high = hn::Max(hn::Max(ax, ay), constant(1e-37f));
  // atan(low / high) = pi/4 + atan((low - high) / (low + high)) keeps the argument of the series below tan(pi/8).
  const FloatMask is_steep = hn::Gt(low, hn::Mul(high, constant(0.41421356f)));
  const Floats t =
      hn::Div(hn::IfThenElse(is_steep, hn::Sub(low, high), low), hn::IfThenElse(is_steep, hn::Add(low, high), high));
  // The minimax polynomial of Cephes' atanf (S. Moshier) for |t| <= tan(pi/8).
  const Floats s = hn::Mul(t, t);
  Floats p = hn::MulAdd(constant(8.05374449538e-2f), s, constant(-1.38776856032e-1f));
  p = hn::MulAdd(p, s, constant(1.99777106478e-1f));
  p = hn::MulAdd(p, s, constant(-3.33329491539e-1f));
  Floats angle = hn::MulAdd(hn::Mul(p, s), t, t);
  angle = hn::Add(angle, hn::IfThenElseZero(is_steep, constant(kPi / 4)));
  angle = hn::IfThenElse(hn::Gt(ay, ax), hn::Sub(constant(kPi / 2), angle), angle);
  angle = hn::IfThenElse(hn::Lt(x, hn::Zero(FloatTag())), hn::Sub(constant(kPi), angle), angle);
  return hn::CopySign(angle, y);
}

/// Ranges and directions of one vector of points.
struct Spherical {
  Floats range, azimuth, elevation;
};
inline Spherical spherical_of(const Coordinates& p) {
  const Floats horizontal2 = hn::MulAdd(p.x, p.x, hn::Mul(p.y, p.y));
  return {hn::Sqrt(hn::MulAdd(p.z, p.z, horizontal2)), angle_of(p.y, p.x), angle_of(p.z, hn::Sqrt(horizontal2))};
}

/// What the tables of a grid say of one vector of rows, each of which must be one of the grid's. The rows of
/// neighbouring points lie close together: then a load and a shuffle serve instead of gathering.
struct RowEntries {
  RowEntries(const DirectionGridView& grid, Ints row) {
    const FloatTag d;
    const IntTag di;
    const auto* first_cells = reinterpret_cast<const std::int32_t*>(grid.first);
    static_assert(kMostLanes <= DirectionGridView::kPadding);
    const auto lanes = static_cast<std::int32_t>(hn::Lanes(di));
    const std::int32_t base = std::max(0, hn::GetLane(row) - lanes / 2);
    const Ints offset = hn::Sub(row, hn::Set(di, base));
    if (hn::AllTrue(di, hn::AndNot(hn::Lt(offset, hn::Zero(di)), hn::Lt(offset, hn::Set(di, lanes))))) {
      columns = hn::TableLookupLanes(hn::LoadU(d, grid.columns + base), hn::IndicesFromVec(d, offset));
      first = hn::TableLookupLanes(hn::LoadU(di, first_cells + base), hn::IndicesFromVec(di, offset));
    } else {
      columns = hn::GatherIndex(d, grid.columns, row);
      first = hn::GatherIndex(di, first_cells, row);
    }
  }
  Floats columns;
  Ints first;
};

/// The cells of directions. Lanes out of the band of elevations are not `in_band` and get the nearest row's cell; lanes
/// that are no numbers get some valid cell. The grid must have a row.
struct CellLookup {
  Ints cell;
  FloatMask in_band;
};
inline CellLookup cells_of(const DirectionGridView& grid, Floats azimuth, Floats elevation) {
  const FloatTag d;
  const IntTag di;
  const Floats rows = constant(static_cast<float>(grid.rows));
  const Floats row = hn::Mul(hn::Sub(elevation, constant(grid.low_rad)), constant(grid.rows_per_rad));
  const FloatMask in_band = hn::And(hn::Ge(row, hn::Zero(d)), hn::Lt(row, rows));
  const Floats bounded =
      hn::Min(hn::Max(hn::IfThenElseZero(hn::Eq(row, row), row), hn::Zero(d)), hn::Sub(rows, constant(1.0f)));
  const auto [columns, first] = RowEntries(grid, hn::ConvertTo(di, bounded));
  const Floats turn = hn::MulAdd(azimuth, constant(0.5f * std::numbers::inv_pi_v<float>), constant(0.5f));
  const Floats column = hn::Mul(hn::IfThenElseZero(hn::Ge(turn, hn::Zero(d)), turn), columns);
  const Ints column_index = hn::ConvertTo(di, hn::Min(column, hn::Sub(columns, constant(1.0f))));
  return {hn::Add(first, column_index), in_band};
}

/// Loads up to one vector of coordinates; lanes beyond `count` are zero.
inline Coordinates load(const float* x, const float* y, const float* z, std::size_t count) {
  const FloatTag d;
  if (count >= hn::Lanes(d)) return {hn::LoadU(d, x), hn::LoadU(d, y), hn::LoadU(d, z)};
  HWY_ALIGN float rest[3][kMostLanes] = {};
  for (std::size_t i = 0; i < count; ++i) {
    rest[0][i] = x[i];
    rest[1][i] = y[i];
    rest[2][i] = z[i];
  }
  return {hn::Load(d, rest[0]), hn::Load(d, rest[1]), hn::Load(d, rest[2])};
}

}  // namespace raywatch::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
