// Vector code, compiled once for each instruction set: see spherical_simd-inl.hpp.
#if defined(RAYWATCH_MOVED_POINTS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef RAYWATCH_MOVED_POINTS_INL
#undef RAYWATCH_MOVED_POINTS_INL
#else
#define RAYWATCH_MOVED_POINTS_INL
#endif

#include <algorithm>

#include "core/ask_kernels.hpp"
#include "core/spherical_simd-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace raywatch::HWY_NAMESPACE {

/// One vector of points in the prior's frame: computed in double precision, as far points of one scan may be near ones
/// of another.
inline Coordinates moved(const RigidMotion& motion, const PointPlanes& points, std::size_t i, std::size_t count) {
  const FloatTag d;
  const hn::ScalableTag<double> dd;
  const hn::Rebind<float, decltype(dd)> df;
  HWY_ALIGN float rest[3][kMostLanes] = {};
  const float* from[3] = {points.x_m + i, points.y_m + i, points.z_m + i};
  if (count < hn::Lanes(d)) {
    for (int axis = 0; axis < 3; ++axis) {
      std::copy_n(from[axis], count, rest[axis]);
      from[axis] = rest[axis];
    }
  }
  HWY_ALIGN float to[3][kMostLanes];
  for (std::size_t k = 0; k < hn::Lanes(d); k += hn::Lanes(dd)) {
    const auto x = hn::PromoteTo(dd, hn::LoadU(df, from[0] + k));
    const auto y = hn::PromoteTo(dd, hn::LoadU(df, from[1] + k));
    const auto z = hn::PromoteTo(dd, hn::LoadU(df, from[2] + k));
    for (int r = 0; r < 3; ++r) {
      auto sum = hn::MulAdd(hn::Set(dd, motion.rotation[3 * r]), x, hn::Set(dd, motion.translation_m[r]));
      sum = hn::MulAdd(hn::Set(dd, motion.rotation[3 * r + 1]), y, sum);
      sum = hn::MulAdd(hn::Set(dd, motion.rotation[3 * r + 2]), z, sum);
      hn::Store(hn::DemoteTo(df, sum), df, to[r] + k);
    }
  }
  return {hn::Load(d, to[0]), hn::Load(d, to[1]), hn::Load(d, to[2])};
}

}  // namespace raywatch::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
