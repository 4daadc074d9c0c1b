#include "core/ask_kernels.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <utility>

#include "core/inquiry.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/ask_kernels.cpp"
#include <hwy/foreach_target.h>  // compiles this file once for each instruction set

#include "core/cone_window-inl.hpp"
#include "core/moved_points-inl.hpp"
#include "core/spherical_simd-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace raywatch::HWY_NAMESPACE {

/// The whole answer is wanted. A cell inside of the cone that has a bound in the band settles it.
struct WantAnswer {
  using Result = Answer;
  static constexpr Answer kNothing = Answer::unseen, kSettled = Answer::supported;

  static FloatMask settled(const PriorIndex::Impl& index, const RangeBand& band, Ints cell) {
    const FloatTag d;
    return band.supports(hn::GatherIndex(d, index.least_m.data(), cell),
                         hn::GatherIndex(d, index.greatest_m.data(), cell));
  }
  static std::optional<Answer> look(const ConeWindow& window, Remains& remains) { return window.look(remains); }
  static Answer inquire(const Inquiry& inquiry, const std::array<double, 3>& point_m, const Direction& direction,
                        const Remains& remains) {
    return inquiry.answer(point_m, direction, remains);
  }
};

/// Only whether the answer is free is wanted. A cell inside with a return that is not farther denies it, whatever else
/// the cone holds: most points that are hidden, or on slanted ground, end there.
struct WantFree {
  using Result = std::uint8_t;
  static constexpr std::uint8_t kNothing = 0, kSettled = 0;

  static FloatMask settled(const PriorIndex::Impl& index, const RangeBand& band, Ints cell) {
    return band.denies_free(hn::GatherIndex(FloatTag(), index.least_m.data(), cell));
  }
  static std::optional<std::uint8_t> look(const ConeWindow& window, Remains& remains) {
    return window.look_whether_free(remains);
  }
  static std::uint8_t inquire(const Inquiry& inquiry, const std::array<double, 3>& point_m, const Direction& direction,
                              const Remains& remains) {
    return inquiry.is_free(point_m, direction, remains);
  }
};

/// Which points the bounds of the cell in a direction settle.
template <class Want>
FloatMask settled_by_cell(const PreparedPrior& prior, const RangeBand& band, const DirectionGridView& grid,
                          Floats azimuth, Floats elevation) {
  const CellLookup lookup = cells_of(grid, azimuth, elevation);
  return hn::And(Want::settled(prior.index, band, lookup.cell), lookup.in_band);
}

/// The lanes among the first `count` that `valid` holds for.
FloatMask valid_lanes(const std::uint8_t* valid, std::size_t count) {
  const hn::Rebind<std::uint8_t, FloatTag> bytes;
  const IntTag di;
  std::uint8_t rest[kMostLanes] = {};
  if (count < hn::Lanes(FloatTag())) {
    std::copy_n(valid, count, rest);
    valid = rest;
  }
  return hn::RebindMask(FloatTag(), hn::Ne(hn::PromoteTo(di, hn::LoadU(bytes, valid)), hn::Zero(di)));
}

/// The first pass over a block: answers what the points' own cells decide, and collects the others.
template <class Want>
void ask_own_cells(const PreparedPrior& prior, const PointPlanes& points, const std::uint8_t* valid,
                   const RigidMotion& motion, typename Want::Result* results, OpenPoints& open) {
  const FloatTag d;
  const IntTag di;
  const hn::Rebind<std::uint8_t, FloatTag> bytes;
  const DirectionGridView grid = prior.index.grid.view();
  const std::size_t lanes = hn::Lanes(d);
  for (std::size_t i = 0; i < points.size; i += lanes) {
    const std::size_t count = std::min(lanes, points.size - i);
    const FloatMask is_valid = valid_lanes(valid + i, count);
    if (hn::AllFalse(d, is_valid)) {
      std::fill_n(results + i, count, Want::kNothing);
      continue;
    }
    const Coordinates p = moved(motion, points, i, count);
    const Spherical s = spherical_of(p);
    FloatMask settled = hn::FirstN(d, 0);
    if (prior.own_cell_is_inside) {
      const RangeBand band(s.range, prior.thresholds.range_m);
      settled = hn::And(is_valid, settled_by_cell<Want>(prior, band, grid, s.azimuth, s.elevation));
    }
    constexpr auto kNothing = static_cast<int>(Want::kNothing), kSettled = static_cast<int>(Want::kSettled);
    const Ints result = hn::IfThenElse(hn::RebindMask(di, settled), hn::Set(di, kSettled), hn::Set(di, kNothing));
    std::uint8_t stored[kMostLanes];
    hn::StoreU(hn::DemoteTo(bytes, result), bytes, stored);
    std::memcpy(results + i, stored, count);
    const FloatMask is_open = hn::AndNot(settled, is_valid);
    if (hn::AllFalse(d, is_open)) continue;
    const Floats horizontal = hn::Sqrt(hn::MulAdd(p.x, p.x, hn::Mul(p.y, p.y)));
    const Floats cosine = hn::Div(horizontal, hn::Max(s.range, constant(1e-37f)));
    const Ints place = hn::Add(hn::Set(di, static_cast<std::int32_t>(i)), hn::Iota(di, 0));
    open.append(place, {s.range, s.azimuth, s.elevation}, cosine, is_open);
  }
}

/// The same for what is open, with the cells one row up and down.
template <class Want>
void ask_cells_above_and_below(const PreparedPrior& prior, typename Want::Result* results, OpenPoints& open) {
  if (!prior.cells_above_and_below_are_inside) return;
  const FloatTag d;
  const DirectionGridView grid = prior.index.grid.view();
  const std::size_t size = std::exchange(open.size, 0);
  for (std::size_t k = 0; k < size; k += hn::Lanes(d)) {
    const std::size_t count = std::min(hn::Lanes(d), size - k);
    const FloatMask present = hn::FirstN(d, count);
    const Spherical s = open.directions(k);
    const Floats cosine = hn::LoadU(d, open.cosine + k);
    const Ints place = hn::LoadU(IntTag(), open.place + k);
    const RangeBand band(s.range, prior.thresholds.range_m);
    FloatMask settled = hn::FirstN(d, 0);
    for (const float step : {grid.cell_rad, -grid.cell_rad}) {
      const Floats elevation = hn::Add(s.elevation, constant(step));
      settled = hn::Or(settled, settled_by_cell<Want>(prior, band, grid, s.azimuth, elevation));
    }
    for (std::uint32_t bits = bits_of(hn::And(settled, present)); bits != 0; bits &= bits - 1) {
      results[open.place[k + static_cast<std::size_t>(std::countr_zero(bits))]] = Want::kSettled;
    }
    open.append(place, s, cosine, hn::AndNot(settled, present));
  }
}

template <class Want>
void ask_block_for(const PreparedPrior& prior, const PointPlanes& points, const std::uint8_t* valid,
                   const RigidMotion& motion, typename Want::Result* results) {
  OpenPoints open;
  ConeSpans spans(prior);
  const Inquiry inquiry(prior);
  for (std::size_t begin = 0; begin < points.size; begin += OpenPoints::kMost) {
    const std::size_t count = std::min(OpenPoints::kMost, points.size - begin);
    const PointPlanes block = points.subspan(begin, count);
    open.size = 0;
    ask_own_cells<Want>(prior, block, valid + begin, motion, results + begin, open);
    ask_cells_above_and_below<Want>(prior, results + begin, open);
    for (std::size_t k = 0; k < open.size; k += hn::Lanes(FloatTag())) {
      const std::size_t lanes = std::min(hn::Lanes(FloatTag()), open.size - k);
      spans.find(hn::LoadU(FloatTag(), open.azimuth_rad + k), hn::LoadU(FloatTag(), open.elevation_rad + k),
                 hn::LoadU(FloatTag(), open.cosine + k), lanes);
      for (std::size_t lane = 0; lane < lanes; ++lane) {
        const auto i = static_cast<std::size_t>(open.place[k + lane]);
        Remains remains;
        const ConeWindow window(prior.index, spans, lane, open.range_m[k + lane], prior.thresholds.range_m);
        const std::optional<typename Want::Result> result = Want::look(window, remains);
        results[begin + i] = result
                                 ? *result
                                 : Want::inquire(inquiry, motion.apply(block.x_m[i], block.y_m[i], block.z_m[i]),
                                                 {open.azimuth_rad[k + lane], open.elevation_rad[k + lane]}, remains);
      }
    }
  }
}

void ask_block_simd(const PreparedPrior& prior, const PointPlanes& points, const std::uint8_t* valid,
                    const RigidMotion& motion, Answer* answers) {
  ask_block_for<WantAnswer>(prior, points, valid, motion, answers);
}

void find_free_in_block_simd(const PreparedPrior& prior, const PointPlanes& points, const std::uint8_t* valid,
                             const RigidMotion& motion, std::uint8_t* free) {
  ask_block_for<WantFree>(prior, points, valid, motion, free);
}

}  // namespace raywatch::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace raywatch {

HWY_EXPORT(ask_block_simd);
HWY_EXPORT(find_free_in_block_simd);

RigidMotion::RigidMotion(const Pose& to_from) {
  Eigen::Map<Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(rotation, 3, 3) = to_from.orientation.toRotationMatrix();
  Eigen::Map<Eigen::Vector3d>(translation_m, 3) = to_from.position_m;
}

PreparedPrior::PreparedPrior(const PriorIndex::Impl& asked, const Thresholds& how)
    : index(asked),
      thresholds(how),
      cone(how.angle_rad),
      own_cell_is_inside(cone.encloses_block_of_axis(asked.grid, 1.0)),
      cells_above_and_below_are_inside(cone.encloses_block_of_axis(asked.grid, 2.0)) {}

void ask_block(const PreparedPrior& prior, const PointPlanes& points, const std::uint8_t* valid,
               const RigidMotion& prior_from_points, Answer* answers) {
  HWY_DYNAMIC_DISPATCH(ask_block_simd)(prior, points, valid, prior_from_points, answers);
}

void find_free_in_block(const PreparedPrior& prior, const PointPlanes& points, const std::uint8_t* valid,
                        const RigidMotion& prior_from_points, std::uint8_t* free) {
  HWY_DYNAMIC_DISPATCH(find_free_in_block_simd)(prior, points, valid, prior_from_points, free);
}

}  // namespace raywatch
#endif
