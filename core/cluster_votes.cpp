#include "core/cluster_votes.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/cone.hpp"
#include "core/prior_index_impl.hpp"

namespace raywatch {
namespace {

constexpr double kFallbackSpacing_rad = 0.01;
constexpr double kFallbackNoise_m = 0.02;

Eigen::Vector2d spacing_of(const ScanView& view) {
  return view.sensor.angular_resolution_rad.value_or(Eigen::Vector2d::Constant(kFallbackSpacing_rad));
}

/// Calls visit(i) for the returns in the cells that a cone touches.
template <class Visit>
void for_each_return_near(const PriorIndex::Impl& index, const Eigen::Vector3d& direction, double angle_rad,
                          Visit visit) {
  const Direction axis = direction_of(direction.x(), direction.y(), direction.z());
  Cone(std::min(angle_rad, std::numbers::pi / 2)).for_each_cell(index.grid, axis, [&](std::uint32_t cell, bool) {
    for (std::uint32_t i = index.first[cell]; i < index.first[cell + 1]; ++i) visit(i);
    return true;
  });
}

Eigen::Vector3d place(const PriorIndex::Impl& index, std::uint32_t i) { return point_of(index.returns[i]); }

/// How much farther apart the shots of `asked` are where a point stands than those of `view`; at least 1, and bounded,
/// as the cost grows with its square.
double coarsening(const ScanView& view, const Eigen::Vector3d& point_m, const ScanView& asked,
                  const Eigen::Vector3d& asked_m) {
  constexpr double kMost = 5.0;
  const double ratio = spacing_of(asked).maxCoeff() * asked_m.norm() / (spacing_of(view).maxCoeff() * point_m.norm());
  return std::clamp(ratio, 1.0, kMost);
}

/// The shots around one return of a scan, in its own frame.
class Neighbourhood {
 public:
  /// @param scale of the spacing of the shots: at 1, on a grid of shots, the eight next to it.
  Neighbourhood(const ScanView& view, const Eigen::Vector3d& point_m, double scale)
      : noise_m_(kNoise * view.sensor.range_noise_m.value_or(kFallbackNoise_m)), range_m_(point_m.norm()) {
    constexpr double kReach = 1.6;
    const Eigen::Vector2d spacing = scale * spacing_of(view);
    const Eigen::Vector3d east = point_m.cross(Eigen::Vector3d::UnitZ()).normalized();
    const Eigen::Vector3d north = east.cross(point_m).normalized();
    const PriorIndex::Impl& index = view.index.impl();
    for_each_return_near(index, point_m, kReach * spacing.maxCoeff(), [&](std::uint32_t i) {
      const Eigen::Vector3d q = place(index, i);
      if (q == point_m || q.dot(point_m) < 0.0) return;
      const double rho = q.norm();
      const Eigen::Vector2d offset_rad(east.dot(q) / rho, north.dot(q) / rho);
      const Eigen::Vector2d shots = offset_rad.cwiseQuotient(spacing);
      if (shots.norm() <= kReach) shots_.push_back({shots, rho, offset_rad.norm() * range_m_});
    });
  }

  /// The share of the shots whose returns are as far as the point, but for a gentle slope. 0 when there is no shot.
  double coherence() const {
    return share([this](const Shot& shot) { return is_level(shot); });
  }

  /// The same, counting also returns in line with the point and the shot on its other side: ground at grazing
  /// incidence.
  double smoothness() const {
    return share([this](const Shot& shot) { return is_level(shot) || continues(shot); });
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

  template <class Predicate>
  double share(Predicate predicate) const {
    if (shots_.empty()) return 0.0;
    return static_cast<double>(std::count_if(shots_.begin(), shots_.end(), predicate)) /
           static_cast<double>(shots_.size());
  }

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

/// The mean smoothness of the returns of a scan within a distance of a place; 1 when it has hardly any there.
double smoothness_around(const ScanView& view, const Eigen::Vector3d& center_m, double distance_m) {
  constexpr std::size_t kLeast = 3, kMost = 100;
  const double range_m = center_m.norm();
  if (!(range_m > distance_m)) return 1.0;
  const PriorIndex::Impl& index = view.index.impl();
  std::vector<Eigen::Vector3d> near_m;
  for_each_return_near(index, center_m, std::asin(distance_m / range_m), [&](std::uint32_t i) {
    if ((place(index, i) - center_m).squaredNorm() < distance_m * distance_m) near_m.push_back(place(index, i));
  });
  if (near_m.size() < kLeast) return 1.0;
  const std::size_t step = (near_m.size() - 1) / kMost + 1;
  double sum = 0.0;
  std::size_t count = 0;
  for (std::size_t k = 0; k < near_m.size(); k += step, ++count)
    sum += Neighbourhood(view, near_m[k], 1.0).smoothness();
  return sum / static_cast<double>(count);
}

/// The thickness of the returns within `radius_m` of a place: the standard deviation across their plane.
double thickness_m(const PriorIndex::Impl& index, const Eigen::Vector3d& center_m, double radius_m) {
  constexpr std::size_t kLeast = 4;
  if (!(center_m.norm() > radius_m)) return 0.0;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();
  std::size_t count = 0;
  for_each_return_near(index, center_m, std::asin(radius_m / center_m.norm()), [&](std::uint32_t i) {
    const Eigen::Vector3d offset_m = place(index, i) - center_m;
    if (offset_m.squaredNorm() >= radius_m * radius_m) return;
    sum += offset_m;
    squares += offset_m * offset_m.transpose();
    ++count;
  });
  if (count < kLeast) return 0.0;
  const Eigen::Vector3d mean = sum / static_cast<double>(count);
  const Eigen::Matrix3d covariance = squares / static_cast<double>(count) - mean * mean.transpose();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(covariance, Eigen::EigenvaluesOnly);
  return std::sqrt(std::max(0.0, axes.eigenvalues()[0]));
}

std::size_t rays_through(const ScanView& view, std::span<const std::uint32_t> members, const ScanView& asked,
                         const CompareParameters& parameters) {
  constexpr double kReach = 1.5;
  const Pose asked_from_view = asked.world_from_sensor.inverse() * view.world_from_sensor;
  PointCloud cluster;
  double ratio = 0.0;
  for (const std::uint32_t i : members) {
    const Eigen::Vector3d p = view.points[i].cast<double>();
    const Eigen::Vector3d q = asked_from_view * p;
    cluster.push_back(static_cast<float>(q.x()), static_cast<float>(q.y()), static_cast<float>(q.z()));
    ratio += p.norm() / std::max(q.norm(), 0.1) / static_cast<double>(members.size());
  }
  const double angle_rad =
      std::min(0.3, kReach * std::max(spacing_of(asked).maxCoeff(), ratio * spacing_of(view).maxCoeff()));
  const PriorIndex cluster_index = PriorIndex::build(cluster, {});
  const PriorIndex::Impl& inner = cluster_index.impl();
  const PriorIndex::Impl& outer = asked.index.impl();
  const double cosine = std::cos(angle_rad);
  std::vector<std::uint32_t> rays;
  for (std::size_t k = 0; k < cluster.size(); ++k) {
    const Eigen::Vector3d m = cluster[k].cast<double>();
    for_each_return_near(outer, m, angle_rad, [&](std::uint32_t i) {
      const Eigen::Vector3d q = place(outer, i);
      if (q.dot(m) >= cosine * q.norm() * m.norm()) rays.push_back(i);
    });
  }
  std::sort(rays.begin(), rays.end());
  rays.erase(std::unique(rays.begin(), rays.end()), rays.end());
  return static_cast<std::size_t>(std::count_if(rays.begin(), rays.end(), [&](std::uint32_t ray) {
    const Eigen::Vector3d q = place(outer, ray);
    const double rho = q.norm();
    const Eigen::Vector3d e = q.cross(Eigen::Vector3d::UnitZ()), n = e.cross(q);
    bool west = false, east = false, south = false, north = false, behind = true;
    for_each_return_near(inner, q, angle_rad, [&](std::uint32_t i) {
      const Eigen::Vector3d m = place(inner, i);
      const double range_m = m.norm();
      if (q.dot(m) < cosine * rho * range_m) return;
      behind &= rho >= range_m + parameters.range_m;
      const double a = e.dot(m), b = n.dot(m);
      west |= a <= 0.0;
      east |= a >= 0.0;
      south |= b <= 0.0;
      north |= b >= 0.0;
    });
    return behind && west && east && south && north;
  }));
}

}  // namespace

ClusterVotes votes_of(const ScanView& view, std::span<const std::uint32_t> members, const ScanView& asked,
                      const CompareParameters& parameters) {
  constexpr std::size_t kMost = 200;  // points of a cluster that are looked at, for its mean
  ClusterVotes votes{.rays_through = rays_through(view, members, asked, parameters)};
  const Pose asked_from_view = asked.world_from_sensor.inverse() * view.world_from_sensor;
  const std::size_t step = (members.size() - 1) / kMost + 1;
  const auto count = static_cast<double>((members.size() - 1) / step + 1);
  Eigen::Vector3d center_m = Eigen::Vector3d::Zero();
  for (std::size_t k = 0; k < members.size(); k += step) {
    const Eigen::Vector3d p = view.points[members[k]].cast<double>(), q = asked_from_view * p;
    votes.coherence += Neighbourhood(view, p, coarsening(view, p, asked, q)).coherence() / count;
    votes.roughness_m += thickness_m(asked.index.impl(), q, parameters.growth_distance_m) / count;
    center_m += q / count;
  }
  votes.surroundings = smoothness_around(asked, center_m, parameters.foliage_distance_m);
  return votes;
}

}  // namespace raywatch
