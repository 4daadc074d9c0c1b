#include "core/index_kernels.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/index_kernels.cpp"
#include <hwy/foreach_target.h>  // compiles this file once for each instruction set

#include "core/spherical_simd-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace raywatch::HWY_NAMESPACE {

/// `is_usable` for vectors: lanes near a limit, and those whose squares leave the range of single precision, are
/// decided by it; all others by their range in single precision.
class UsableTest {
 public:
  explicit UsableTest(const UsableRange& usable) : usable_(usable) {
    const auto limit = [](double value) { return static_cast<float>(std::clamp(value, 0.0, 1e18)); };
    constexpr float kRounding = 1e-6f;
    min_out_ = limit(usable.min_m) * (1.0f - kRounding);
    min_in_ = limit(usable.min_m) * (1.0f + kRounding);
    max_in_ = limit(usable.max_m) * (1.0f - kRounding);
    max_out_ = limit(usable.max_m) * (1.0f + kRounding);
    if (usable.no_return_m) {
      const auto band = static_cast<float>(kNoReturnBand_m);
      sentinel_ = static_cast<float>(*usable.no_return_m);
      const float rounding = kRounding * sentinel_;
      band_out_ = band + rounding;
      band_in_ = band - rounding;
    }
  }

  FloatMask operator()(const Coordinates& p, Floats range) const {
    const FloatTag d;
    const Floats off_sentinel = hn::Abs(hn::Sub(range, constant(sentinel_)));
    const FloatMask regular = hn::And(hn::Gt(range, constant(1e-15f)), hn::Lt(range, constant(1e18f)));
    FloatMask yes = hn::And(hn::And(regular, hn::Gt(off_sentinel, constant(band_out_))),
                            hn::And(hn::Gt(range, constant(min_in_)), hn::Lt(range, constant(max_in_))));
    const Floats sum = hn::Add(hn::Add(hn::Abs(p.x), hn::Abs(p.y)), hn::Abs(p.z));
    const FloatMask zero_or_nan = hn::Or(hn::Eq(sum, hn::Zero(d)), hn::Not(hn::Eq(sum, sum)));
    const FloatMask no =
        hn::Or(zero_or_nan,
               hn::And(regular, hn::Or(hn::Lt(off_sentinel, constant(band_in_)),
                                       hn::Or(hn::Lt(range, constant(min_out_)), hn::Gt(range, constant(max_out_))))));
    const FloatMask open = hn::Not(hn::Or(yes, no));
    return hn::AllFalse(d, open) ? yes : decide(p, yes, open);
  }

 private:
  HWY_NOINLINE FloatMask decide(const Coordinates& p, FloatMask yes, FloatMask open) const {
    const FloatTag d;
    HWY_ALIGN float x[kMostLanes], y[HWY_MAX_BYTES / sizeof(float)], z[kMostLanes];
    HWY_ALIGN float decided[kMostLanes], is_open[HWY_MAX_BYTES / sizeof(float)];
    hn::Store(p.x, d, x);
    hn::Store(p.y, d, y);
    hn::Store(p.z, d, z);
    hn::Store(hn::IfThenElseZero(yes, constant(1.0f)), d, decided);
    hn::Store(hn::IfThenElseZero(open, constant(1.0f)), d, is_open);
    for (std::size_t i = 0; i < hn::Lanes(d); ++i) {
      if (is_open[i] == 0.0f) continue;
      const double px = x[i], py = y[i], pz = z[i];
      decided[i] = is_usable(std::sqrt(px * px + py * py + pz * pz), usable_) ? 1.0f : 0.0f;
    }
    return hn::Gt(hn::Load(d, decided), hn::Zero(d));
  }

  UsableRange usable_;
  float min_out_, min_in_, max_in_, max_out_;
  float sentinel_ = 0.0f, band_out_ = -1.0f, band_in_ = -1.0f;
};

Floats range_of(const Coordinates& p) {
  return hn::Sqrt(hn::MulAdd(p.z, p.z, hn::MulAdd(p.x, p.x, hn::Mul(p.y, p.y))));
}

/// Calls `visit(i, count, coordinates)` for one vector of points after the other; the last may be of fewer points.
template <class Visit>
void for_each_vector(const PointPlanes& points, Visit visit) {
  const std::size_t lanes = hn::Lanes(FloatTag());
  for (std::size_t i = 0; i < points.size; i += lanes) {
    const std::size_t count = std::min(lanes, points.size - i);
    visit(i, count, load(points.x_m + i, points.y_m + i, points.z_m + i, count));
  }
}

/// Stores the first `count` lanes.
template <class D, class V, class T>
void store(D d, V values, T* to, std::size_t count) {
  if (count >= hn::Lanes(d)) return hn::StoreU(values, d, to);
  HWY_ALIGN T all[HWY_MAX_BYTES / sizeof(T)];
  hn::Store(values, d, all);
  std::copy(all, all + count, to);
}

void find_usable_simd(const PointPlanes& points, const UsableRange& usable, std::uint8_t* valid) {
  const UsableTest is_valid(usable);
  const hn::Rebind<std::uint8_t, FloatTag> bytes;
  for_each_vector(points, [&](std::size_t i, std::size_t count, const Coordinates& p) {
    const auto ones = hn::VecFromMask(IntTag(), hn::RebindMask(IntTag(), is_valid(p, range_of(p))));
    store(bytes, hn::DemoteTo(bytes, hn::Abs(ones)), valid + i, count);
  });
}

ScannedBand find_elevation_band_simd(const PointPlanes& points, const UsableRange& usable) {
  const FloatTag d;
  const UsableTest is_valid(usable);
  Floats low = constant(2.0f), high = constant(-2.0f);
  std::size_t total = 0;
  for_each_vector(points, [&](std::size_t, std::size_t, const Coordinates& p) {
    const Floats range = range_of(p);
    const FloatMask valid = is_valid(p, range);
    const Floats sine = hn::Div(p.z, range);
    low = hn::Min(low, hn::IfThenElse(valid, sine, constant(2.0f)));
    high = hn::Max(high, hn::IfThenElse(valid, sine, constant(-2.0f)));
    total += hn::CountTrue(d, valid);
  });
  if (total == 0) return {};
  // Widened by the error of a sine in single precision, which is a large angle near the poles.
  constexpr double kSineError = 3e-7;
  const double low_sine = hn::GetLane(hn::MinOfLanes(d, low)) - kSineError;
  const double high_sine = hn::GetLane(hn::MaxOfLanes(d, high)) + kSineError;
  return {total, std::asin(std::max(low_sine, -1.0)), std::asin(std::min(high_sine, 1.0))};
}

void assign_cells_simd(const PointPlanes& points, const UsableRange& usable, const DirectionGridView& grid,
                       std::uint32_t* cells) {
  const UsableTest is_valid(usable);
  const IntTag di;
  for_each_vector(points, [&](std::size_t i, std::size_t count, const Coordinates& p) {
    const Spherical s = spherical_of(p);
    const FloatMask valid = is_valid(p, s.range);
    const Ints cell = cells_of(grid, s.azimuth, s.elevation).cell;
    const Ints chosen = hn::IfThenElse(hn::RebindMask(di, valid), cell, hn::Set(di, -1));
    store(di, chosen, reinterpret_cast<std::int32_t*>(cells) + i, count);
  });
}

/// Ranges of `count` returns in a row.
void find_ranges(const Return* returns, std::size_t count, float* ranges_m) {
  const FloatTag d;
  const auto* from = reinterpret_cast<const float*>(returns);
  std::size_t i = 0;
  for (; i + hn::Lanes(d) <= count; i += hn::Lanes(d)) {
    Coordinates p;
    hn::LoadInterleaved3(d, from + 3 * i, p.x, p.y, p.z);
    hn::StoreU(range_of(p), d, ranges_m + i);
  }
  for (; i < count; ++i) {
    const auto& [x, y, z] = returns[i];
    ranges_m[i] = std::sqrt(x * x + y * y + z * z);
  }
}

void bound_ranges_simd(const Return* returns, const std::uint32_t* first, std::size_t cells, float* least_m,
                       float* greatest_m) {
  const FloatTag d;
  const IntTag di;
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  constexpr std::size_t kBlock = 1024;
  std::vector<float> ranges_m;
  for (std::size_t begin = 0; begin < cells; begin += kBlock) {
    const std::size_t end = std::min(begin + kBlock, cells);
    const std::uint32_t offset = first[begin];
    if (ranges_m.size() < first[end] - offset) ranges_m.resize(first[end] - offset);
    find_ranges(returns + offset, first[end] - offset, ranges_m.data());
    for (std::size_t cell = begin; cell < end; cell += hn::Lanes(d)) {
      const auto* places = reinterpret_cast<const std::int32_t*>(first) + cell;
      const Ints behind = hn::Sub(hn::LoadU(di, places + 1), hn::Set(di, static_cast<std::int32_t>(offset)));
      Ints i = hn::Sub(hn::LoadU(di, places), hn::Set(di, static_cast<std::int32_t>(offset)));
      Floats least = constant(kInfinity), greatest = constant(-kInfinity);
      const std::size_t count = std::min(hn::Lanes(d), end - cell);
      for (;; i = hn::Add(i, hn::Set(di, 1))) {
        const auto present = hn::And(hn::FirstN(di, count), hn::Lt(i, behind));
        if (hn::AllFalse(di, present)) break;
        const Floats range = hn::GatherIndex(d, ranges_m.data(), hn::IfThenElseZero(present, i));
        const FloatMask has = hn::RebindMask(d, present);
        least = hn::IfThenElse(has, hn::Min(least, range), least);
        greatest = hn::IfThenElse(has, hn::Max(greatest, range), greatest);
      }
      store(d, least, least_m + cell, count);
      store(d, greatest, greatest_m + cell, count);
    }
  }
}

void to_spherical_simd(const PointPlanes& points, float* ranges_m, float* azimuths_rad, float* elevations_rad) {
  const FloatTag d;
  for_each_vector(points, [&](std::size_t i, std::size_t count, const Coordinates& p) {
    const Spherical s = spherical_of(p);
    store(d, s.range, ranges_m + i, count);
    store(d, s.azimuth, azimuths_rad + i, count);
    store(d, s.elevation, elevations_rad + i, count);
  });
}

}  // namespace raywatch::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace raywatch {

HWY_EXPORT(find_usable_simd);
HWY_EXPORT(find_elevation_band_simd);
HWY_EXPORT(assign_cells_simd);
HWY_EXPORT(bound_ranges_simd);
HWY_EXPORT(to_spherical_simd);

void find_usable(const PointPlanes& points, const UsableRange& usable, std::uint8_t* valid) {
  HWY_DYNAMIC_DISPATCH(find_usable_simd)(points, usable, valid);
}

ScannedBand find_elevation_band(const PointPlanes& points, const UsableRange& usable) {
  return HWY_DYNAMIC_DISPATCH(find_elevation_band_simd)(points, usable);
}

void assign_cells(const PointPlanes& points, const UsableRange& usable, const DirectionGridView& grid,
                  std::uint32_t* cells) {
  HWY_DYNAMIC_DISPATCH(assign_cells_simd)(points, usable, grid, cells);
}

void bound_ranges(const Return* returns, const std::uint32_t* first, std::size_t cells, float* least_m,
                  float* greatest_m) {
  HWY_DYNAMIC_DISPATCH(bound_ranges_simd)(returns, first, cells, least_m, greatest_m);
}

void to_spherical(const PointPlanes& points, float* ranges_m, float* azimuths_rad, float* elevations_rad) {
  HWY_DYNAMIC_DISPATCH(to_spherical_simd)(points, ranges_m, azimuths_rad, elevations_rad);
}

}  // namespace raywatch
#endif
