#include "core/smoothness.hpp"

#include <Eigen/Eigenvalues>
#include <vector>

#include "core/assumed_sensor.hpp"
#include "core/returns_near.hpp"

namespace raywatch {
namespace {

/// The shots around one return of a scan, in its own frame: on a grid of shots, the eight next to it.
class Neighbourhood {
 public:
  Neighbourhood(const ScanView& view, const Eigen::Vector3d& point_m)
      : noise_m_(kNoise * noise_of(view)), range_m_(point_m.norm()) {
    constexpr double kReach = 1.6;
    const Eigen::Vector2d spacing = spacing_of(view);
    const Eigen::Vector3d east = point_m.cross(Eigen::Vector3d::UnitZ()).normalized();
    const Eigen::Vector3d north = east.cross(point_m).normalized();
    const PriorIndex::Impl& index = view.index.impl();
    for_each_return_near(index, point_m, kReach * spacing.maxCoeff(), [&](std::uint32_t i) {
      const Eigen::Vector3d q = point_of(index.returns[i]);
      if (q == point_m || q.dot(point_m) < 0.0) return;
      const double rho = q.norm();
      const Eigen::Vector2d offset_rad(east.dot(q) / rho, north.dot(q) / rho);
      const Eigen::Vector2d shots = offset_rad.cwiseQuotient(spacing);
      if (shots.norm() <= kReach) shots_.push_back({shots, rho, offset_rad.norm() * range_m_});
    });
  }

  /// The share of the shots whose returns are as far as the point but for a gentle slope, or in line with it and the
  /// shot on its other side: ground at grazing incidence. 0 when there is no shot.
  double smoothness() const {
    if (shots_.empty()) return 0.0;
    const auto smooth = std::count_if(shots_.begin(), shots_.end(),
                                      [this](const Shot& shot) { return is_level(shot) || continues(shot); });
    return static_cast<double>(smooth) / static_cast<double>(shots_.size());
  }

 private:
  static constexpr double kNoise = 4.0;   // standard deviations
  static constexpr double kGentle = 1.5;  // slope of a surface against the sphere around the sensor
  static constexpr double kSteep = 20.0;  // the same, of ground at grazing incidence; steeper is an edge

  struct Shot {
    Eigen::Vector2d offset;  ///< in spacings
    double range_m;
    double aside_m;  ///< from the point, across the ray
  };

  bool is_level(const Shot& shot) const { return step_m(shot) <= noise_m_ + kGentle * shot.aside_m; }
  double step_m(const Shot& shot) const { return std::abs(shot.range_m - range_m_); }

  /// In a plane the inverse range is a linear function of the direction.
  bool continues(const Shot& shot) const {
    constexpr double kOpposite = 0.7;
    constexpr double kBend = 0.15;
    if (step_m(shot) > noise_m_ + kSteep * shot.aside_m) return false;
    return std::any_of(shots_.begin(), shots_.end(), [&](const Shot& other) {
      const double bend_m = std::abs(1.0 - 0.5 * range_m_ * (1.0 / shot.range_m + 1.0 / other.range_m)) * range_m_;
      return (shot.offset + other.offset).norm() < kOpposite && bend_m <= noise_m_ + kBend * shot.aside_m;
    });
  }

  double noise_m_;
  double range_m_;
  std::vector<Shot> shots_;
};

}  // namespace

Surroundings surroundings_of(const ScanView& view, const Eigen::Vector3d& center_m, double distance_m) {
  constexpr std::size_t kLeast = 3, kMost = 100;
  const PriorIndex::Impl& index = view.index.impl();
  std::vector<std::uint32_t> near;
  for_each_return_around(index, center_m, distance_m, [&](std::uint32_t i) { near.push_back(i); });
  if (near.size() < kLeast) return {.smoothness = 1.0, .returns = near.size()};
  const auto stride = static_cast<std::uint32_t>((near.size() - 1) / kMost + 1);
  double sum = 0.0;
  std::size_t count = 0;
  for (const std::uint32_t i : near) {
    if (!is_chosen(index.returns[i], stride)) continue;
    sum += Neighbourhood(view, point_of(index.returns[i])).smoothness();
    ++count;
  }
  return {.smoothness = count == 0 ? 1.0 : sum / static_cast<double>(count), .returns = near.size()};
}

double smoothness_of(const ScanView& view, std::span<const std::uint32_t> members) {
  double sum = 0.0;
  for (const std::uint32_t i : members) sum += Neighbourhood(view, view.points[i].cast<double>()).smoothness();
  return members.empty() ? 1.0 : sum / static_cast<double>(members.size());
}

double roughness_around_m(const ScanView& view, const Eigen::Vector3d& center_m, double radius_m) {
  constexpr std::size_t kLeast = 4;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();
  std::size_t count = 0;
  for_each_return_around(view.index.impl(), center_m, radius_m, [&](std::uint32_t i) {
    const Eigen::Vector3d offset_m = point_of(view.index.impl().returns[i]) - center_m;
    sum += offset_m;
    squares += offset_m * offset_m.transpose();
    ++count;
  });
  if (count < kLeast) return 0.0;
  const Eigen::Vector3d mean = sum / static_cast<double>(count);
  const Eigen::Matrix3d covariance = squares / static_cast<double>(count) - mean * mean.transpose();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(covariance, Eigen::EigenvaluesOnly);
  return std::max(0.0, std::sqrt(std::max(0.0, axes.eigenvalues()[0])) - noise_of(view));
}

}  // namespace raywatch
