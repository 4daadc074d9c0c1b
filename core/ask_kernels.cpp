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

/// Which points the bounds of the cell in a direction support.
FloatMask supported_by_cell(const PreparedPrior& prior, const RangeBand& band, const DirectionGridView& grid,
                            Floats azimuth, Floats elevation) {
  const FloatTag d;
  const CellLookup lookup = cells_of(grid, azimuth, elevation);
  const Floats least = hn::GatherIndex(d, prior.index.least_m.data(), lookup.cell);
  const Floats greatest = hn::GatherIndex(d, prior.index.greatest_m.data(), lookup.cell);
  return hn::And(band.supports(least, greatest), lookup.in_band);
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
void ask_own_cells(const PreparedPrior& prior, const PointPlanes& points, const std::uint8_t* valid,
                   const RigidMotion& motion, Answer* answers, OpenPoints& open) {
  const FloatTag d;
  const IntTag di;
  const hn::Rebind<std::uint8_t, FloatTag> bytes;
  const DirectionGridView grid = prior.index.grid.view();
  const std::size_t lanes = hn::Lanes(d);
  for (std::size_t i = 0; i < points.size; i += lanes) {
    const std::size_t count = std::min(lanes, points.size - i);
    const FloatMask is_valid = valid_lanes(valid + i, count);
    if (hn::AllFalse(d, is_valid)) {
      std::fill_n(answers + i, count, Answer::unseen);
      continue;
    }
    const Coordinates p = moved(motion, points, i, count);
    const Spherical s = spherical_of(p);
    FloatMask supported = hn::FirstN(d, 0);
    if (prior.own_cell_is_inside) {
      const RangeBand band(s.range, prior.thresholds.range_m);
      supported = hn::And(is_valid, supported_by_cell(prior, band, grid, s.azimuth, s.elevation));
    }
    constexpr auto kUnseen = static_cast<int>(Answer::unseen), kSupported = static_cast<int>(Answer::supported);
    const Ints answer = hn::IfThenElse(hn::RebindMask(di, supported), hn::Set(di, kSupported), hn::Set(di, kUnseen));
    std::uint8_t stored[kMostLanes];
    hn::StoreU(hn::DemoteTo(bytes, answer), bytes, stored);
    std::memcpy(answers + i, stored, count);
    const FloatMask is_open = hn::AndNot(supported, is_valid);
    if (hn::AllFalse(d, is_open)) continue;
    const Floats horizontal = hn::Sqrt(hn::MulAdd(p.x, p.x, hn::Mul(p.y, p.y)));
    const Floats cosine = hn::Div(horizontal, hn::Max(s.range, constant(1e-37f)));
    const Ints place = hn::Add(hn::Set(di, static_cast<std::int32_t>(i)), hn::Iota(di, 0));
    open.append(place, {s.range, s.azimuth, s.elevation}, cosine, is_open);
  }
}

/// The same for what is open, with the cells one row up and down.
void ask_cells_above_and_below(const PreparedPrior& prior, Answer* answers, OpenPoints& open) {
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
    FloatMask supported = hn::FirstN(d, 0);
    for (const float step : {grid.cell_rad, -grid.cell_rad}) {
      const Floats elevation = hn::Add(s.elevation, constant(step));
      supported = hn::Or(supported, supported_by_cell(prior, band, grid, s.azimuth, elevation));
    }
    for (std::uint32_t bits = bits_of(hn::And(supported, present)); bits != 0; bits &= bits - 1) {
      answers[open.place[k + static_cast<std::size_t>(std::countr_zero(bits))]] = Answer::supported;
    }
    open.append(place, s, cosine, hn::AndNot(supported, present));
  }
}

void ask_block_simd(const PreparedPrior& prior, const PointPlanes& points, const std::uint8_t* valid,
                    const RigidMotion& motion, Answer* answers) {
  OpenPoints open;
  ConeSpans spans(prior);
  const Inquiry inquiry(prior);
  for (std::size_t begin = 0; begin < points.size; begin += OpenPoints::kMost) {
    const std::size_t count = std::min(OpenPoints::kMost, points.size - begin);
    const PointPlanes block = points.subspan(begin, count);
    open.size = 0;
    ask_own_cells(prior, block, valid + begin, motion, answers + begin, open);
    ask_cells_above_and_below(prior, answers + begin, open);
    for (std::size_t k = 0; k < open.size; k += hn::Lanes(FloatTag())) {
      const std::size_t lanes = std::min(hn::Lanes(FloatTag()), open.size - k);
      spans.find(hn::LoadU(FloatTag(), open.azimuth_rad + k), hn::LoadU(FloatTag(), open.elevation_rad + k),
                 hn::LoadU(FloatTag(), open.cosine + k), lanes);
      for (std::size_t lane = 0; lane < lanes; ++lane) {
        const auto i = static_cast<std::size_t>(open.place[k + lane]);
        Remains remains;
        ConeWindow window(prior.index, spans, lane, open.range_m[k + lane], prior.thresholds.range_m);
        const std::optional<Answer> answer = window.look(remains);
        answers[begin + i] = answer ? *answer
                                    : inquiry(motion.apply(block.x_m[i], block.y_m[i], block.z_m[i]),
                                              {open.azimuth_rad[k + lane], open.elevation_rad[k + lane]}, remains);
      }
    }
  }
}

}  // namespace raywatch::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace raywatch {

HWY_EXPORT(ask_block_simd);

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

}  // namespace raywatch
#endif
