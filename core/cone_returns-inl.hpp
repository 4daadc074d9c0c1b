// Vector code, compiled once for each instruction set: see spherical_simd-inl.hpp.
#if defined(RAYWATCH_CONE_RETURNS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef RAYWATCH_CONE_RETURNS_INL
#undef RAYWATCH_CONE_RETURNS_INL
#else
#define RAYWATCH_CONE_RETURNS_INL
#endif

#include <algorithm>
#include <cstring>
#include <vector>

#include "core/cone_spans-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace raywatch::HWY_NAMESPACE {

/// The returns in the cells that the cones of one vector of points touch: for each point (lane) some stretches of
/// neighbouring returns, one a row or, at the seam, two.
class ConeReturns {
 public:
  explicit ConeReturns(const PreparedPrior& prior) : prior_(prior), spans_(prior) {}

  /// Finds the returns around the first `count` lanes. @param cosine of the elevation
  void find(Floats azimuth, Floats elevation, Floats cosine, std::size_t count) {
    stretches_ = 0;
    spans_.find(azimuth, elevation, cosine, count);
    const IntTag di;
    const auto* first = reinterpret_cast<const std::int32_t*>(prior_.index.first.data());
    const Ints fits = hn::VecFromMask(di, hn::RebindMask(di, spans_.fits()));
    for (std::size_t row = 0; row < spans_.rows(); ++row) {
      const Ints cell = hn::And(spans_.first(row), fits);
      grow(row + 1);
      hn::StoreU(hn::GatherIndex(di, first, cell), di, &begin_[row * kMostLanes]);
      hn::StoreU(hn::GatherIndex(di, first, hn::Add(cell, hn::And(spans_.count(row), fits))), di,
                 &end_[row * kMostLanes]);
    }
    FloatTag d;
    HWY_ALIGN float azimuths[kMostLanes], elevations[kMostLanes];
    hn::Store(azimuth, d, azimuths);
    hn::Store(elevation, d, elevations);
    for (std::size_t lane = 0; lane < count; ++lane) {
      if (!spans_.fits(lane)) find_one({azimuths[lane], elevations[lane]}, lane);
    }
  }

  /// Calls `visit(coordinates, lanes that have one)`: one return a lane, until every lane has had all of its own. The
  /// other lanes hold any return. Copies the returns of some vectors at a time: much faster than to gather them.
  template <class Visit>
  HWY_INLINE void for_each(Visit visit) {
    const FloatTag d;
    const IntTag di;
    for (std::size_t k = 0; k < stretches_; ++k) {
      const Ints begin = hn::LoadU(di, &begin_[k * kMostLanes]), end = hn::LoadU(di, &end_[k * kMostLanes]);
      const std::int32_t most = hn::GetLane(hn::MaxOfLanes(di, hn::Sub(end, begin)));
      for (std::int32_t at = 0; at < most; at += kAtOnce) {
        const std::int32_t count = std::min(kAtOnce, most - at);
        copy(&begin_[k * kMostLanes], at, count);
        for (std::int32_t i = 0; i < count; ++i) {
          Coordinates returns;
          Floats unused;
          hn::LoadInterleaved4(d, copied_[i], returns.x, returns.y, returns.z, unused);
          const auto present = hn::Lt(hn::Add(begin, hn::Set(di, at + i)), end);
          visit(returns, hn::RebindMask(d, present));
        }
      }
    }
  }

 private:
  static constexpr std::int32_t kAtOnce = 8;
  static constexpr std::size_t kWidth = 4;  // floats that a return takes in `copied_`; one is unused

  /// Copies `count` returns of each lane, beginning `at` behind its first.
  HWY_INLINE void copy(const std::int32_t* begin, std::int32_t at, std::int32_t count) {
    static_assert(sizeof(Return) == 3 * sizeof(float));
    const auto& returns = prior_.index.returns;
    const auto last = static_cast<std::int32_t>(returns.size()) - 1;
    for (std::int32_t i = 0; i < count; ++i) {
      for (std::size_t lane = 0; lane < hn::Lanes(IntTag()); ++lane) {
        // Reads into the next return, or into the padding behind the last.
        std::memcpy(&copied_[i][lane * kWidth], &returns[std::min(begin[lane] + at + i, last)], kWidth * sizeof(float));
      }
    }
  }

  void grow(std::size_t stretches) {
    if (stretches <= stretches_) return;
    stretches_ = stretches;
    if (begin_.size() < stretches * kMostLanes) {
      begin_.resize(stretches * kMostLanes);
      end_.resize(stretches * kMostLanes);
    }
    std::fill_n(&begin_[(stretches - 1) * kMostLanes], kMostLanes, 0);
    std::fill_n(&end_[(stretches - 1) * kMostLanes], kMostLanes, 0);
  }

  /// The same for one point whose cone is large, or touches a pole or the seam.
  HWY_NOINLINE void find_one(const Direction& axis, std::size_t lane) {
    const auto& index = prior_.index;
    std::size_t stretch = 0;
    prior_.cone.for_each_stretch(index.grid, axis, [&](std::uint32_t first_cell, std::uint32_t end_cell) {
      grow(stretch + 1);
      begin_[stretch * kMostLanes + lane] = static_cast<std::int32_t>(index.first[first_cell]);
      end_[stretch * kMostLanes + lane] = static_cast<std::int32_t>(index.first[end_cell]);
      ++stretch;
      return true;
    });
  }

  const PreparedPrior& prior_;
  ConeSpans spans_;
  std::size_t stretches_ = 0;
  std::vector<std::int32_t> begin_, end_;  ///< first return of each stretch, and the one behind it; by stretch, lane
  HWY_ALIGN float copied_[kAtOnce][kMostLanes * kWidth];
};

}  // namespace raywatch::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
