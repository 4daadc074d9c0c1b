#pragma once

#include <cmath>

#include "core/prior_index.hpp"

namespace raywatch {

/// The thresholds as the tests use them.
struct SquaredThresholds {
  explicit SquaredThresholds(const Thresholds& thresholds)
      : cosine2(std::cos(thresholds.angle_rad) * std::cos(thresholds.angle_rad)), range_m(thresholds.range_m) {}
  double cosine2;  ///< of T_a
  double range_m;  ///< T_r
};

/// A point of the question in the prior's frame, with everything that the tests on a return need. The tests are in
/// double precision and use no root and no angle: they compare squares, so their only error is that of the last bits.
class Question {
 public:
  Question(double x_m, double y_m, double z_m, const SquaredThresholds& thresholds)
      : x_m_(x_m),
        y_m_(y_m),
        z_m_(z_m),
        horizontal_m2_(x_m * x_m + y_m * y_m),
        squared_m2_(horizontal_m2_ + z_m * z_m),
        range_m_(std::sqrt(squared_m2_)) {
    cone_ = thresholds.cosine2 * squared_m2_;
    const double near_m = range_m_ - thresholds.range_m, far_m = range_m_ + thresholds.range_m;
    near_m2_ = near_m > 0.0 ? near_m * near_m : -1.0;
    far_m2_ = far_m * far_m;
  }

  double range_m() const { return range_m_; }

  /// angle(u, u_i) <= T_a, for T_a <= pi/2.
  bool in_cone(double x, double y, double z, double squared_m2) const {
    const double dot = x_m_ * x + y_m_ * y + z_m_ * z;
    return dot >= 0.0 && dot * dot >= cone_ * squared_m2;
  }
  bool is_farther(double squared_m2) const { return squared_m2 >= far_m2_; }  // rho_i >= rho + T_r
  bool is_nearer(double squared_m2) const { return squared_m2 <= near_m2_; }  // rho_i <= rho - T_r

  /// a_i and e_i of the tangent plane, scaled by positive factors. Exactly above and below the sensor the azimuth is 0.
  double east(double x, double y) const { return horizontal_m2_ > 0.0 ? x_m_ * y - y_m_ * x : y; }
  double north(double x, double y, double z) const {
    if (horizontal_m2_ > 0.0) return z * horizontal_m2_ - z_m_ * (x * x_m_ + y * y_m_);
    return z_m_ > 0.0 ? -x : x;
  }

 private:
  double x_m_, y_m_, z_m_;
  double horizontal_m2_;
  double squared_m2_;
  double range_m_;
  double cone_;
  double near_m2_;
  double far_m2_;
};

/// What has been seen of N so far.
struct Evidence {
  bool any = false;
  bool supported = false;
  bool not_farther = false;  ///< some return is not at rho + T_r or beyond
  bool not_nearer = false;   ///< some return is not at rho - T_r or before
  bool west = false, east = false, south = false, north = false;

  void look_at(const Question& question, double x, double y, double z) {
    const double squared_m2 = x * x + y * y + z * z;
    if (!question.in_cone(x, y, z, squared_m2)) return;
    const bool is_farther = question.is_farther(squared_m2), is_nearer = question.is_nearer(squared_m2);
    any = true;
    not_farther |= !is_farther;
    not_nearer |= !is_nearer;
    supported |= !is_farther && !is_nearer;
    const double a = question.east(x, y), e = question.north(x, y, z);
    west |= a <= 0.0;
    east |= a >= 0.0;
    south |= e < 0.0;
    north |= e > 0.0;
  }

  bool surrounded() const { return west && east && south && north; }
  Answer answer() const {
    if (!any) return Answer::unseen;
    if (!not_farther && surrounded()) return Answer::free;
    if (supported) return Answer::supported;
    return not_nearer ? Answer::ambiguous : Answer::occluded;
  }
};

}  // namespace raywatch
