#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "core/cone.hpp"
#include "core/error.hpp"
#include "core/for_each_point.hpp"
#include "core/prior_index_impl.hpp"

namespace raywatch {
namespace {

constexpr double kPi = std::numbers::pi;

/// A point of the question in the prior's frame, with everything that the tests on a return need. The tests are in
/// double precision and use no root and no angle: they compare squares, so their only error is that of the last bits.
class Question {
 public:
  Question(const Eigen::Vector3d& point_m, const Thresholds& thresholds)
      : point_m_(point_m),
        horizontal_m2_(point_m.x() * point_m.x() + point_m.y() * point_m.y()),
        squared_m2_(horizontal_m2_ + point_m.z() * point_m.z()),
        range_m_(std::sqrt(squared_m2_)) {
    const double cosine = std::cos(thresholds.angle_rad);
    cone_ = cosine * cosine * squared_m2_;
    const double near_m = range_m_ - thresholds.range_m, far_m = range_m_ + thresholds.range_m;
    near_m2_ = near_m > 0.0 ? near_m * near_m : -1.0;
    far_m2_ = far_m * far_m;
  }

  double range_m() const { return range_m_; }
  const Eigen::Vector3d& point_m() const { return point_m_; }

  /// angle(u, u_i) <= T_a, for T_a <= pi/2.
  bool in_cone(const Eigen::Vector3d& p, double p_squared_m2) const {
    const double dot = point_m_.dot(p);
    return dot >= 0.0 && dot * dot >= cone_ * p_squared_m2;
  }
  bool is_farther(double p_squared_m2) const { return p_squared_m2 >= far_m2_; }  // rho_i >= rho + T_r
  bool is_nearer(double p_squared_m2) const { return p_squared_m2 <= near_m2_; }  // rho_i <= rho - T_r

  /// a_i and e_i of the tangent plane, scaled by positive factors. Exactly above and below the sensor the azimuth is 0.
  double east(const Eigen::Vector3d& p) const {
    return horizontal_m2_ > 0.0 ? point_m_.x() * p.y() - point_m_.y() * p.x() : p.y();
  }
  double north(const Eigen::Vector3d& p) const {
    if (horizontal_m2_ > 0.0) {
      return p.z() * horizontal_m2_ - point_m_.z() * (p.x() * point_m_.x() + p.y() * point_m_.y());
    }
    return point_m_.z() > 0.0 ? -p.x() : p.x();
  }

 private:
  Eigen::Vector3d point_m_;
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

  bool surrounded() const { return west && east && south && north; }
  Answer answer() const {
    if (!any) return Answer::unseen;
    if (!not_farther && surrounded()) return Answer::free;
    if (supported) return Answer::supported;
    return not_nearer ? Answer::ambiguous : Answer::occluded;
  }
};

/// Asks one prior, one question after the other. Holds no state between questions.
class Inquiry {
 public:
  Inquiry(const PriorIndex::Impl& prior, const Thresholds& thresholds)
      : prior_(prior),
        thresholds_(thresholds),
        cone_(thresholds.angle_rad),
        own_cell_is_inside_(cone_.encloses_cell_of_axis(prior.grid)) {}

  Answer operator()(const Eigen::Vector3d& point_m) const {
    const Question question(point_m, thresholds_);
    if (!(question.range_m() > 0.0) || prior_.source.empty()) return Answer::unseen;
    const Direction direction = direction_of(point_m.x(), point_m.y(), point_m.z());
    if (own_cell_is_inside_ && own_cell_supports(question, direction)) return Answer::supported;
    Evidence evidence;
    cone_.for_each_cell(prior_.grid, direction, [&](std::uint32_t cell, bool inside) {
      look_at_cell(question, cell, inside, evidence);
      return !evidence.supported;
    });
    return evidence.answer();
  }

 private:
  /// Most points of a world at rest are decided here, by the bounds of the cell that they lie in.
  bool own_cell_supports(const Question& question, const Direction& direction) const {
    const double row = prior_.grid.row_coordinate(direction.elevation_rad);
    if (row < 0.0 || row >= static_cast<double>(prior_.grid.rows())) return false;
    return bound_supports(question, prior_.range_m[prior_.grid.cell_of(direction)]);
  }

  /// A bound is the range of a return, but for its rounding outwards.
  bool bound_supports(const Question& question, const RangeInterval& cell) const {
    const double rounding_m = 2e-7 * question.range_m() + 1e-9;
    const double within_m = thresholds_.range_m - rounding_m;
    return std::abs(cell.least_m - question.range_m()) < within_m ||
           std::abs(cell.greatest_m - question.range_m()) < within_m;
  }

  /// Skips the cell's returns when its bounds already say all that they could add.
  void look_at_cell(const Question& question, std::uint32_t cell, bool inside, Evidence& evidence) const {
    const RangeInterval& bounds = prior_.range_m[cell];
    if (bounds.empty()) return;
    const double near_m = question.range_m() - thresholds_.range_m, far_m = question.range_m() + thresholds_.range_m;
    const bool all_nearer = bounds.greatest_m <= near_m, all_farther = bounds.least_m >= far_m;
    if (all_nearer && (inside || evidence.not_farther)) {
      evidence.any |= inside;
      evidence.not_farther = true;
      return;
    }
    if (all_farther && (evidence.not_farther || evidence.surrounded()) && (inside || evidence.not_nearer)) {
      evidence.any |= inside;
      evidence.not_nearer = true;
      return;
    }
    if (inside && bound_supports(question, bounds)) {
      evidence = {.any = true, .supported = true, .not_farther = true, .not_nearer = true};
      return;
    }
    for (std::uint32_t i = prior_.first[cell]; i < prior_.first[cell + 1] && !evidence.supported; ++i) {
      look_at_return(question, {prior_.x_m[i], prior_.y_m[i], prior_.z_m[i]}, evidence);
    }
  }

  static void look_at_return(const Question& question, const Eigen::Vector3d& p, Evidence& evidence) {
    const double squared_m2 = p.x() * p.x() + p.y() * p.y() + p.z() * p.z();
    if (!question.in_cone(p, squared_m2)) return;
    const bool farther = question.is_farther(squared_m2), nearer = question.is_nearer(squared_m2);
    evidence.any = true;
    evidence.not_farther |= !farther;
    evidence.not_nearer |= !nearer;
    evidence.supported |= !farther && !nearer;
    const double east = question.east(p), north = question.north(p);
    evidence.west |= east <= 0.0;
    evidence.east |= east >= 0.0;
    evidence.south |= north < 0.0;
    evidence.north |= north > 0.0;
  }

  const PriorIndex::Impl& prior_;
  Thresholds thresholds_;
  Cone cone_;
  bool own_cell_is_inside_;
};

/// Looks into the cone that a ball around the point fills, seen from the prior. Nothing is near a sensor itself.
bool has_near_return(const PriorIndex::Impl& prior, const Eigen::Vector3d& point_m, double distance_m) {
  const double range_m = point_m.norm();
  if (!(range_m > distance_m)) return false;
  bool found = false;
  const auto look_at_cell = [&](std::uint32_t cell, bool) {
    const RangeInterval& bounds = prior.range_m[cell];
    if (bounds.least_m > range_m + distance_m || bounds.greatest_m < range_m - distance_m) return true;
    for (std::uint32_t i = prior.first[cell]; i < prior.first[cell + 1] && !found; ++i) {
      const Eigen::Vector3d p(prior.x_m[i], prior.y_m[i], prior.z_m[i]);
      found = (p - point_m).squaredNorm() < distance_m * distance_m;
    }
    return !found;
  };
  const Direction direction = direction_of(point_m.x(), point_m.y(), point_m.z());
  Cone(std::asin(distance_m / range_m)).for_each_cell(prior.grid, direction, look_at_cell);
  return found;
}

void check(const Thresholds& thresholds) {
  if (!(thresholds.angle_rad > 0.0 && thresholds.angle_rad <= kPi / 2)) {
    throw InvalidInput("The angular threshold must be above 0 and at most 90 degrees.",
                       {{"angle_deg", "must be above 0 and at most 90"}});
  }
  if (!(thresholds.range_m >= 0.0 && std::isfinite(thresholds.range_m))) {
    throw InvalidInput("The range threshold must be 0 or more metres.", {{"range_m", "must be 0 or more"}});
  }
}

}  // namespace

void ask(const PriorIndex& prior, const PointCloud& points, std::span<const std::uint8_t> valid,
         const Pose& prior_from_points, const Thresholds& thresholds, std::span<Answer> answers) {
  check(thresholds);
  const Inquiry inquiry(prior.impl(), thresholds);
  for_each_point(points, prior_from_points, [&](std::size_t i, const Eigen::Vector3d& point_m) {
    answers[i] = valid[i] ? inquiry(point_m) : Answer::unseen;
  });
}

void find_near_returns(const PriorIndex& prior, const PointCloud& points, const Pose& prior_from_points,
                       double distance_m, std::span<std::uint8_t> near) {
  const PriorIndex::Impl& impl = prior.impl();
  for_each_point(points, prior_from_points, [&](std::size_t i, const Eigen::Vector3d& point_m) {
    near[i] = has_near_return(impl, point_m, distance_m);
  });
}

}  // namespace raywatch
