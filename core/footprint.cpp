#include "core/footprint.hpp"

#include "core/assumed_sensor.hpp"
#include "core/for_each_point.hpp"
#include "core/returns_near.hpp"

namespace raywatch {
namespace {

/// The shots in an ellipse of directions around a point: the cone of T_a is as wide as the coarser of the two spacings
/// demands.
class ShotsAround {
 public:
  ShotsAround(const PriorIndex::Impl& index, const Eigen::Vector3d& point_m, const Eigen::Vector2d& radii_rad)
      : index_(index),
        point_m_(point_m),
        widest_rad_(radii_rad.maxCoeff()),
        east_(Eigen::Vector3d::UnitZ().cross(point_m).normalized()),
        north_(point_m.cross(east_).normalized()) {
    east_ /= radii_rad.x();
    north_ /= radii_rad.y();
  }

  /// Whether there are some on every side.
  bool surround() const {
    Sides sides;
    for_each([&](double east, double north, double) {
      sides.add(east, north);
      return !sides.all();
    });
    return sides.all();
  }

  /// Whether there are some on every side, and all ended at `least_range_m` or beyond.
  bool surround_beyond(double least_range_m) const {
    Sides sides;
    bool beyond = true;
    for_each([&](double east, double north, double squared_m2) {
      sides.add(east, north);
      beyond = squared_m2 >= least_range_m * least_range_m;
      return beyond;
    });
    return beyond && sides.all();
  }

 private:
  struct Sides {
    bool is_west = false, is_east = false, is_south = false, is_north = false;
    void add(double east, double north) {
      is_west |= east <= 0.0;
      is_east |= east >= 0.0;
      is_south |= north < 0.0;
      is_north |= north > 0.0;
    }
    bool all() const { return is_west && is_east && is_south && is_north; }
  };

  /// Calls visit(offsets from the point to the east and north, scaled by positive factors, squared range) until it
  /// returns false.
  template <class Visit>
  void for_each(Visit visit) const {
    for_each_return_near(index_, point_m_, widest_rad_, [&](std::uint32_t i) {
      const Eigen::Vector3d end_m = point_of(index_.returns[i]);
      const double east = east_.dot(end_m), north = north_.dot(end_m), squared_m2 = end_m.squaredNorm();
      if (east * east + north * north > squared_m2 || end_m.dot(point_m_) < 0.0) return true;
      return visit(east, north, squared_m2);
    });
  }

  const PriorIndex::Impl& index_;
  Eigen::Vector3d point_m_;
  double widest_rad_;
  Eigen::Vector3d east_, north_;  ///< of the tangent plane, divided by the radii: the ellipse is the unit circle
};

}  // namespace

void ask_footprints(const ScanView& asked, const PointCloud& points, const Pose& asked_from_points, double range_m,
                    std::span<Answer> answers) {
  constexpr double kBeside = 1.1;  // in spacings: reaches the corners of a grid's cell from nearly anywhere in it
  const PriorIndex::Impl& index = asked.index.impl();
  const Eigen::Vector2d radii_rad = kBeside * spacing_of(asked);
  for_each_point(points, asked_from_points, [&](std::size_t i, const Eigen::Vector3d& point_m) {
    if (answers[i] != Answer::ambiguous) return;
    if (ShotsAround(index, point_m, radii_rad).surround_beyond(point_m.norm() + range_m)) answers[i] = Answer::free;
  });
}

void withhold_at_borders(const ScanView& asked, const PointCloud& points, const Pose& asked_from_points, double noise_m,
                         std::span<Answer> answers) {
  constexpr double kAround = 2.5;  // in spacings: on each side several shots, of which some may have been lost
  constexpr double kNoise = 2.5;   // in standard deviations
  const PriorIndex::Impl& index = asked.index.impl();
  const Eigen::Vector2d radii_rad = kAround * spacing_of(asked);
  for_each_point(points, asked_from_points, [&](std::size_t i, const Eigen::Vector3d& point_m) {
    if (answers[i] != Answer::free) return;
    const Eigen::Vector2d moved_rad = radii_rad + Eigen::Vector2d::Constant(kNoise * noise_m / point_m.norm());
    if (index.own.hide(point_m, moved_rad) || !ShotsAround(index, point_m, radii_rad).surround()) {
      answers[i] = Answer::unseen;
    }
  });
}

}  // namespace raywatch
