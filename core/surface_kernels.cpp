#include "core/surface_kernels.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/surface_kernels.cpp"
#include <hwy/foreach_target.h>  // compiles this file once for each instruction set

#include "core/cone_returns-inl.hpp"
#include "core/moved_points-inl.hpp"
#include "core/spherical_simd-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace raywatch::HWY_NAMESPACE {

/// Right-handed axes at the directions of one vector of points: east and north in the tangent plane, outward along the
/// ray. Exactly above and below the sensor the azimuth is 0.
struct TangentFrame {
  explicit TangentFrame(const Coordinates& p) {
    const Floats horizontal2 = hn::MulAdd(p.x, p.x, hn::Mul(p.y, p.y));
    horizontal = hn::Sqrt(horizontal2);
    range = hn::Sqrt(hn::MulAdd(p.z, p.z, horizontal2));
    const FloatMask is_upright = hn::Le(horizontal, constant(1e-37f));
    cosine = hn::IfThenElse(is_upright, constant(1.0f), hn::Div(p.x, horizontal));
    sine = hn::IfThenElseZero(hn::Not(is_upright), hn::Div(p.y, horizontal));
    const Floats inverse = hn::Div(constant(1.0f), hn::Max(range, constant(1e-37f)));
    level = hn::Mul(horizontal, inverse);
    rise = hn::Mul(p.z, inverse);
  }

  /// Of a vector of other points, one a lane: coordinates along the axes.
  struct Components {
    Floats east, north, outward;
  };
  Components of(const Coordinates& q) const {
    const Floats away = hn::MulAdd(cosine, q.x, hn::Mul(sine, q.y));
    return {hn::NegMulAdd(sine, q.x, hn::Mul(cosine, q.y)), hn::MulSub(level, q.z, hn::Mul(rise, away)),
            hn::MulAdd(level, away, hn::Mul(rise, q.z))};
  }

  Floats range, horizontal;
  Floats cosine, sine;  ///< of the azimuth
  Floats level, rise;   ///< cosine and sine of the elevation
};

/// A linear regression in two variables, for one vector of points at once: height ~ a east + b north + c.
struct Regression {
  Floats count, east, north, height, east2, north2, mixed, east_height, north_height;  // sums
  Regression() {
    count = east = north = height = east2 = north2 = mixed = east_height = north_height = hn::Zero(FloatTag());
  }

  void add(FloatMask in, Floats e, Floats n, Floats h) {
    count = hn::Add(count, hn::IfThenElseZero(in, constant(1.0f)));
    east = hn::Add(east, e);
    north = hn::Add(north, n);
    height = hn::Add(height, h);
    east2 = hn::MulAdd(e, e, east2);
    north2 = hn::MulAdd(n, n, north2);
    mixed = hn::MulAdd(e, n, mixed);
    east_height = hn::MulAdd(e, h, east_height);
    north_height = hn::MulAdd(n, h, north_height);
  }

  struct Coefficients {
    Floats a, b, c;
    FloatMask is_certain;
    Floats at(Floats e, Floats n) const { return hn::MulAdd(a, e, hn::MulAdd(b, n, c)); }
  };
  Coefficients solve() const {
    constexpr float kLeastDeterminant = 1e-5f;  // of the correlations: below, the points lie on a line
    const Floats inverse = hn::Div(constant(1.0f), hn::Max(count, constant(1.0f)));
    const Floats e = hn::Mul(east, inverse), n = hn::Mul(north, inverse), h = hn::Mul(height, inverse);
    const Floats ee = hn::NegMulAdd(east, e, east2), nn = hn::NegMulAdd(north, n, north2);
    const Floats en = hn::NegMulAdd(east, n, mixed);
    const Floats eh = hn::NegMulAdd(east, h, east_height), nh = hn::NegMulAdd(north, h, north_height);
    const Floats product = hn::Mul(ee, nn), determinant = hn::NegMulAdd(en, en, product);
    const FloatMask certain = hn::Gt(determinant, hn::Mul(product, constant(kLeastDeterminant)));
    const Floats scale = hn::Div(constant(1.0f), determinant);
    const Floats a = hn::Mul(scale, hn::MulSub(eh, nn, hn::Mul(nh, en)));
    const Floats b = hn::Mul(scale, hn::MulSub(nh, ee, hn::Mul(eh, en)));
    return {a, b, hn::NegMulAdd(a, e, hn::NegMulAdd(b, n, h)), certain};
  }
};

/// Looks at the returns around one vector of points after the other.
class SurfaceFinder {
 public:
  explicit SurfaceFinder(const PreparedPrior& prior)
      : around_(prior), tangent_(static_cast<float>(std::tan(prior.thresholds.angle_rad))) {}

  void find(const Coordinates& points, std::size_t count, Surface* surfaces) {
    const TangentFrame frame(points);
    const Spherical s = spherical_of(points);
    around_.find(s.azimuth, s.elevation, frame.level, count);
    const Sums sums = look_around(frame);
    store(frame, sums, count, surfaces);
  }

 private:
  struct Sums {
    Regression regression;
    FloatMask west, east, south, north;
    Floats nearest2;
    Sums() {
      west = east = south = north = hn::FirstN(FloatTag(), 0);
      nearest2 = constant(std::numeric_limits<float>::infinity());
    }
    FloatMask surround() const { return hn::And(hn::And(west, east), hn::And(south, north)); }
  };

  /// What the fit needs of a return in the cone; zeros of one that is not.
  static constexpr std::size_t kKept = 4;

  /// Sums over the returns in the cones, in units of tan(T_a) across and of the point's range along the ray.
  Sums look_around(const TangentFrame& frame) {
    const FloatTag d;
    Sums sums;
    kept_ = 0;
    const Floats per_tangent = constant(1.0f / tangent_);
    around_.for_each([&](const Coordinates& returns, FloatMask present) HWY_ATTR {
      const TangentFrame::Components q = frame.of(returns);
      const Floats inverse = hn::Div(constant(1.0f), q.outward);
      const Floats scale = hn::Mul(inverse, per_tangent);
      const Floats east = hn::Mul(q.east, scale), north = hn::Mul(q.north, scale);
      const Floats before = hn::Sub(frame.range, q.outward);
      const FloatMask in = hn::And(hn::And(present, hn::Gt(q.outward, hn::Zero(d))),
                                   hn::Le(hn::MulAdd(east, east, hn::Mul(north, north)), constant(1.0f)));
      sums.west = hn::Or(sums.west, hn::And(in, hn::Le(east, hn::Zero(d))));
      sums.east = hn::Or(sums.east, hn::And(in, hn::Ge(east, hn::Zero(d))));
      sums.south = hn::Or(sums.south, hn::And(in, hn::Lt(north, hn::Zero(d))));
      sums.north = hn::Or(sums.north, hn::And(in, hn::Gt(north, hn::Zero(d))));
      const Floats distance2 = hn::MulAdd(q.east, q.east, hn::MulAdd(q.north, q.north, hn::Mul(before, before)));
      sums.nearest2 = hn::IfThenElse(in, hn::Min(sums.nearest2, distance2), sums.nearest2);
      const Floats e = hn::IfThenElseZero(in, east), n = hn::IfThenElseZero(in, north);
      const Floats h = hn::IfThenElseZero(in, hn::Mul(before, inverse));
      sums.regression.add(in, e, n, h);
      keep(e, n, h, hn::IfThenElseZero(in, q.outward));
    });
    return sums;
  }

  void keep(Floats east, Floats north, Floats height, Floats outward) {
    const FloatTag d;
    if (memory_.size() < (kept_ + 1) * kKept * kMostLanes) memory_.resize(2 * (kept_ + 8) * kKept * kMostLanes);
    float* to = memory_.data() + kept_++ * kKept * kMostLanes;
    hn::StoreU(east, d, to);
    hn::StoreU(north, d, to + kMostLanes);
    hn::StoreU(height, d, to + 2 * kMostLanes);
    hn::StoreU(outward, d, to + 3 * kMostLanes);
  }

  /// The greatest distance of the returns from the plane, times the length of the plane's vector.
  Floats farthest_off(const Regression::Coefficients& fit) const {
    const FloatTag d;
    Floats farthest = hn::Zero(d);
    for (std::size_t k = 0; k < kept_; ++k) {
      const float* from = memory_.data() + k * kKept * kMostLanes;
      const Floats error =
          hn::Sub(hn::LoadU(d, from + 2 * kMostLanes), fit.at(hn::LoadU(d, from), hn::LoadU(d, from + kMostLanes)));
      farthest = hn::Max(farthest, hn::Abs(hn::Mul(error, hn::LoadU(d, from + 3 * kMostLanes))));
    }
    return farthest;
  }

  /// With heights R / (u . p_i) - 1 over the point's range R, the fitted plane n . p = 1 has R n = a / tan(T_a) east +
  /// b / tan(T_a) north + (1 + c) u.
  void store(const TangentFrame& frame, const Sums& sums, std::size_t count, Surface* surfaces) const {
    constexpr float kLeastReturns = 5.0f;
    const FloatTag d;
    const Regression::Coefficients fit = sums.regression.solve();
    const Floats outward = hn::Add(fit.c, constant(1.0f)), per_tangent = constant(1.0f / tangent_);
    const Floats a = hn::Mul(fit.a, per_tangent), b = hn::Mul(fit.b, per_tangent);
    const Floats length = hn::Sqrt(hn::MulAdd(a, a, hn::MulAdd(b, b, hn::Mul(outward, outward))));
    const FloatMask enough = hn::Ge(sums.regression.count, constant(kLeastReturns));
    const FloatMask is_plane =
        hn::And(hn::And(enough, hn::Gt(outward, hn::Zero(d))), hn::And(fit.is_certain, sums.surround()));
    HWY_ALIGN float before[kMostLanes], cosine[kMostLanes], off[kMostLanes], nearest[kMostLanes], plane[kMostLanes];
    hn::Store(hn::Neg(hn::Div(hn::Mul(fit.c, frame.range), length)), d, before);
    hn::Store(hn::Div(outward, length), d, cosine);
    hn::Store(hn::Div(farthest_off(fit), length), d, off);
    hn::Store(hn::Sqrt(sums.nearest2), d, nearest);
    hn::Store(hn::IfThenElseZero(is_plane, constant(1.0f)), d, plane);
    for (std::size_t k = 0; k < count; ++k) surfaces[k] = {plane[k] != 0.0f, before[k], cosine[k], off[k], nearest[k]};
  }

  ConeReturns around_;
  float tangent_;
  std::size_t kept_ = 0;
  std::vector<float> memory_;
};

void find_surfaces_simd(const PreparedPrior& prior, const PointPlanes& points, const RigidMotion& motion,
                        Surface* surfaces) {
  SurfaceFinder finder(prior);
  const std::size_t lanes = hn::Lanes(FloatTag());
  for (std::size_t i = 0; i < points.size; i += lanes) {
    const std::size_t count = std::min(lanes, points.size - i);
    finder.find(moved(motion, points, i, count), count, surfaces + i);
  }
}

}  // namespace raywatch::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace raywatch {

HWY_EXPORT(find_surfaces_simd);

void find_surfaces(const PreparedPrior& prior, const PointPlanes& points, const RigidMotion& prior_from_points,
                   Surface* surfaces) {
  HWY_DYNAMIC_DISPATCH(find_surfaces_simd)(prior, points, prior_from_points, surfaces);
}

}  // namespace raywatch
#endif
