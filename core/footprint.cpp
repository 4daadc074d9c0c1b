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
        radii_rad_(radii_rad),
        east_(Eigen::Vector3d::UnitZ().cross(point_m).normalized()),
        north_(point_m.cross(east_) / point_m.norm()) {}

  /// Whether there are some on every side.
  bool surround() const {
    Sides sides;
    for_each([&](const Eigen::Vector2d& offset_rad, double) {
      sides.add(offset_rad);
      return !sides.all();
    });
    return sides.all();
  }

  /// Whether there are some on every side, and all ended at `least_range_m` or beyond.
  bool surround_beyond(double least_range_m) const {
    Sides sides;
    bool beyond = true;
    for_each([&](const Eigen::Vector2d& offset_rad, double end_range_m) {
      sides.add(offset_rad);
      beyond = end_range_m >= least_range_m;
      return beyond;
    });
    return beyond && sides.all();
  }

 private:
  struct Sides {
    bool west = false, east = false, south = false, north = false;
    void add(const Eigen::Vector2d& offset_rad) {
      west |= offset_rad.x() <= 0.0;
      east |= offset_rad.x() >= 0.0;
      south |= offset_rad.y() < 0.0;
      north |= offset_rad.y() > 0.0;
    }
    bool all() const { return west && east && south && north; }
  };

  /// Calls visit(offset from the point, range) until it returns false.
  template <class Visit>
  void for_each(Visit visit) const {
    for_each_return_near(index_, point_m_, radii_rad_.maxCoeff(), [&](std::uint32_t i) {
      const Eigen::Vector3d end_m = point_of(index_.returns[i]);
      const double end_range_m = end_m.norm();
      const Eigen::Vector2d offset_rad = Eigen::Vector2d(east_.dot(end_m), north_.dot(end_m)) / end_range_m;
      const bool is_around = end_m.dot(point_m_) >= 0.0 && !(offset_rad.cwiseQuotient(radii_rad_).squaredNorm() > 1.0);
      return !is_around || visit(offset_rad, end_range_m);
    });
  }

  const PriorIndex::Impl& index_;
  Eigen::Vector3d point_m_;
  Eigen::Vector2d radii_rad_;
  Eigen::Vector3d east_, north_;
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
