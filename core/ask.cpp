#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "core/error.hpp"
#include "core/prior_index_impl.hpp"

namespace raywatch {
namespace {

constexpr double kPi = std::numbers::pi;

/// Covers the errors of the directions of the question and of the returns, and of the arithmetic on them: a cell that
/// is taken for inside (outside) of the cone by this margin is so.
constexpr double kAngleMargin_rad = 8.0 * kDirectionError_rad;

double haversine(double angle_rad) {
  const double half = std::sin(0.5 * angle_rad);
  return half * half;
}

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
        grid_(prior.grid),
        thresholds_(thresholds),
        outer_rad_(thresholds.angle_rad + kAngleMargin_rad),
        inner_rad_(thresholds.angle_rad - kAngleMargin_rad),
        outer_haversine_(haversine(outer_rad_)),
        inner_haversine_(inner_rad_ > 0.0 ? haversine(inner_rad_) : -1.0),
        own_cell_is_inside_(std::numbers::sqrt2 * grid_.cell_rad() <= inner_rad_) {}

  Answer operator()(const Eigen::Vector3d& point_m) const {
    const Question question(point_m, thresholds_);
    if (!(question.range_m() > 0.0) || prior_.source.empty()) return Answer::unseen;
    const Direction direction = direction_of(point_m.x(), point_m.y(), point_m.z());
    if (own_cell_is_inside_ && own_cell_supports(question, direction)) return Answer::supported;

    Evidence evidence;
    const double elevation = direction.elevation_rad;
    const double low = grid_.row_coordinate(elevation - outer_rad_),
                 high = grid_.row_coordinate(elevation + outer_rad_);
    if (high < 0.0 || low >= static_cast<double>(grid_.rows())) return Answer::unseen;
    const auto first_row = static_cast<std::size_t>(std::max(low, 0.0));
    const auto last_row = static_cast<std::size_t>(std::min(high, static_cast<double>(grid_.rows() - 1)));
    for (std::size_t row = first_row; row <= last_row && !evidence.supported; ++row) {
      look_at_row(question, direction, row, evidence);
    }
    return evidence.answer();
  }

 private:
  /// Most points of a world at rest are decided here, by the bounds of the cell that they lie in.
  bool own_cell_supports(const Question& question, const Direction& direction) const {
    if (grid_.row_coordinate(direction.elevation_rad) < 0.0) return false;
    if (grid_.row_coordinate(direction.elevation_rad) >= static_cast<double>(grid_.rows())) return false;
    return bound_supports(question, prior_.range_m[grid_.cell_of(direction)]);
  }

  /// A bound is the range of a return, but for its rounding outwards.
  bool bound_supports(const Question& question, const RangeInterval& cell) const {
    const double rounding_m = 2e-7 * question.range_m() + 1e-9;
    const double within_m = thresholds_.range_m - rounding_m;
    return std::abs(cell.least_m - question.range_m()) < within_m ||
           std::abs(cell.greatest_m - question.range_m()) < within_m;
  }

  /// The half-widths in azimuth that contain, and that are contained in, the part of the cone in a row. From
  /// hav(angle) = hav(elevation difference) + cos(elevation) cos(elevation') hav(azimuth difference).
  struct Widths {
    double outer_rad = kPi;
    double inner_rad = -1.0;
  };
  Widths widths(double elevation, std::size_t row) const {
    const double bottom = grid_.row_bottom_rad(row), top = bottom + grid_.cell_rad();
    const double nearest = std::max({0.0, bottom - elevation, elevation - top});
    const double farthest = std::max(std::abs(elevation - bottom), std::abs(elevation - top));
    const double cosine = std::max(0.0, std::cos(elevation));
    Widths result;
    const double outer = outer_haversine_ - haversine(nearest);
    const double outer_scale = cosine * grid_.least_cosine(row);
    if (outer < 0.0) {
      result.outer_rad = -1.0;
    } else if (outer < outer_scale) {
      result.outer_rad = 2.0 * std::asin(std::sqrt(outer / outer_scale)) + kAngleMargin_rad;
    }
    const double inner = inner_haversine_ - haversine(farthest);
    const double inner_scale = cosine * grid_.greatest_cosine(row);
    if (inner >= 0.0) {
      result.inner_rad =
          inner < inner_scale ? 2.0 * std::asin(std::sqrt(inner / inner_scale)) - kAngleMargin_rad : 2.0 * kPi;
    }
    return result;
  }

  void look_at_row(const Question& question, const Direction& direction, std::size_t row, Evidence& evidence) const {
    const Widths half = widths(direction.elevation_rad, row);
    if (half.outer_rad < 0.0) return;
    const auto columns = static_cast<std::int64_t>(grid_.columns(row));
    const double per_rad = static_cast<double>(columns) / (2.0 * kPi);
    const double center = grid_.column_coordinate(row, direction.azimuth_rad);
    auto first = static_cast<std::int64_t>(std::floor(center - half.outer_rad * per_rad));
    auto last = static_cast<std::int64_t>(std::floor(center + half.outer_rad * per_rad));
    if (last - first >= columns) {
      first = 0;
      last = columns - 1;
    }
    const double inner_low = center - half.inner_rad * per_rad, inner_high = center + half.inner_rad * per_rad;
    for (std::int64_t column = first; column <= last && !evidence.supported; ++column) {
      const bool inside = half.inner_rad > 0.0 && static_cast<double>(column) >= inner_low &&
                          static_cast<double>(column + 1) <= inner_high;
      const std::int64_t wrapped = column < 0 ? column + columns : column >= columns ? column - columns : column;
      look_at_cell(question, grid_.first_cell(row) + static_cast<std::uint32_t>(wrapped),
                   inside || half.inner_rad >= kPi, evidence);
    }
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
  const DirectionGrid& grid_;
  Thresholds thresholds_;
  double outer_rad_, inner_rad_;
  double outer_haversine_, inner_haversine_;
  bool own_cell_is_inside_;
};

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
  const Eigen::Matrix3d rotation = prior_from_points.orientation.toRotationMatrix();
  const Eigen::Vector3d translation_m = prior_from_points.position_m;
  constexpr std::size_t kGrain = 4096;
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, points.size(), kGrain), [&](const auto& block) {
    for (std::size_t i = block.begin(); i < block.end(); ++i) {
      const Eigen::Vector3d point_m(points.x_m[i], points.y_m[i], points.z_m[i]);
      answers[i] = valid[i] ? inquiry(rotation * point_m + translation_m) : Answer::unseen;
    }
  });
}

}  // namespace raywatch
