#include "core/m3c2.hpp"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <map>
#include <optional>

#include "core/error.hpp"
#include "core/point_grid.hpp"

namespace raywatch {
namespace {

void check(const M3c2Parameters& parameters) {
  std::vector<FieldError> errors;
  const auto require = [&](bool holds, const char* field, const char* message) {
    if (!holds) errors.push_back({field, message});
  };
  require(parameters.normal_diameter_m > 0.0, "normal_diameter_m", "must be above 0");
  require(parameters.projection_diameter_m > 0.0, "projection_diameter_m", "must be above 0");
  require(parameters.max_distance_m > 0.0, "max_distance_m", "must be above 0");
  require(parameters.registration_m >= 0.0, "registration_m", "must be 0 or more");
  require(parameters.least_points >= 2, "least_points", "must be at least 2");
  if (!errors.empty()) throw InvalidInput("A parameter of M3C2 is out of its range.", std::move(errors));
}

/// The value at a share of the way through sorted values, between two of them linearly.
double quantile(const std::vector<double>& sorted, double share) {
  const double at = share * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(at);
  const std::size_t above = std::min(below + 1, sorted.size() - 1);
  return sorted[below] + (at - static_cast<double>(below)) * (sorted[above] - sorted[below]);
}

M3c2Side summarise(std::vector<double>& depths_m, M3c2Statistic statistic) {
  M3c2Side side{.points = static_cast<std::uint32_t>(depths_m.size())};
  if (depths_m.empty()) return side;
  if (statistic == M3c2Statistic::median) {
    std::sort(depths_m.begin(), depths_m.end());
    side.position_m = quantile(depths_m, 0.5);
    side.roughness_m = quantile(depths_m, 0.75) - quantile(depths_m, 0.25);
    return side;
  }
  const auto n = static_cast<double>(depths_m.size());
  double sum = 0.0, squares = 0.0;
  for (const double depth_m : depths_m) sum += depth_m;
  side.position_m = sum / n;
  for (const double depth_m : depths_m) squares += (depth_m - side.position_m) * (depth_m - side.position_m);
  if (depths_m.size() > 1) side.roughness_m = std::sqrt(squares / (n - 1.0));
  return side;
}

class Comparer {
 public:
  Comparer(const M3c2Clouds& clouds, const M3c2Parameters& parameters)
      : parameters_(parameters),
        sensors_m_(clouds.sensors_m),
        surface_(clouds.before, parameters.normal_diameter_m / 2.0),
        before_(clouds.before, parameters.projection_diameter_m / 2.0),
        after_(clouds.after, parameters.projection_diameter_m / 2.0) {}

  M3c2Distance operator()(const Eigen::Vector3d& core_m) const {
    M3c2Distance result;
    const std::optional<Eigen::Vector3d> normal = normal_at(core_m);
    if (!normal) return result;
    result.normal = *normal;
    result.before = side_of(before_, core_m, *normal);
    result.after = side_of(after_, core_m, *normal);
    if (result.before.points == 0 || result.after.points == 0) return result;
    result.distance_m = result.after.position_m - result.before.position_m;
    if (std::min(result.before.points, result.after.points) >= parameters_.least_points) {
      const double variance_m2 = result.before.roughness_m * result.before.roughness_m / result.before.points +
                                 result.after.roughness_m * result.after.roughness_m / result.after.points;
      result.lod95_m = 1.96 * (std::sqrt(variance_m2) + parameters_.registration_m);
    }
    return result;
  }

 private:
  std::optional<Eigen::Vector3d> normal_at(const Eigen::Vector3d& core_m) const {
    constexpr std::size_t kFewest = 4;
    std::size_t n = 0;
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    Eigen::Matrix3d products = Eigen::Matrix3d::Zero();
    surface_.for_each_near(core_m, parameters_.normal_diameter_m / 2.0, [&](const Eigen::Vector3d& p) {
      const Eigen::Vector3d offset_m = p - core_m;
      ++n;
      sum += offset_m;
      products += offset_m * offset_m.transpose();
    });
    if (n < kFewest) return std::nullopt;
    const Eigen::Matrix3d covariance = products - sum * sum.transpose() / static_cast<double>(n);
    const Eigen::Vector3d normal = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(covariance).eigenvectors().col(0);
    return normal.dot(towards_sensor(core_m)) < 0.0 ? Eigen::Vector3d(-normal) : normal;
  }

  Eigen::Vector3d towards_sensor(const Eigen::Vector3d& core_m) const {
    if (sensors_m_.empty()) return Eigen::Vector3d::UnitZ();
    const auto nearest = std::ranges::min_element(
        sensors_m_, {}, [&](const Eigen::Vector3d& sensor_m) { return (sensor_m - core_m).squaredNorm(); });
    return *nearest - core_m;
  }

  M3c2Side side_of(const PointGrid& grid, const Eigen::Vector3d& core_m, const Eigen::Vector3d& normal) const {
    std::vector<double> depths_m;
    grid.for_each_in({core_m, normal, parameters_.projection_diameter_m / 2.0, parameters_.max_distance_m},
                     [&](const Eigen::Vector3d&, double depth_m) { depths_m.push_back(depth_m); });
    return summarise(depths_m, parameters_.statistic);
  }

  const M3c2Parameters& parameters_;
  std::span<const Eigen::Vector3d> sensors_m_;
  PointGrid surface_, before_, after_;
};

}  // namespace

std::vector<M3c2Distance> m3c2(const M3c2Clouds& clouds, std::span<const Eigen::Vector3d> core_points_m,
                               const M3c2Parameters& parameters) {
  check(parameters);
  const Comparer compare(clouds, parameters);
  std::vector<M3c2Distance> distances(core_points_m.size());
  constexpr std::size_t kGrain = 64;
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, distances.size(), kGrain), [&](const auto& block) {
    for (std::size_t i = block.begin(); i < block.end(); ++i) distances[i] = compare(core_points_m[i]);
  });
  return distances;
}

std::vector<Eigen::Vector3d> core_points_of(const PointCloud& cloud, double spacing_m) {
  if (!(spacing_m > 0.0)) throw InvalidInput("Core points need a spacing.", {{"spacing_m", "must be above 0"}});
  struct Cube {
    Eigen::Vector3d sum_m = Eigen::Vector3d::Zero();
    double n = 0.0;
    Eigen::Vector3d nearest_m;
    double nearest_m2 = std::numeric_limits<double>::infinity();
  };
  std::map<std::array<double, 3>, Cube> cubes;
  const auto cube_at = [&](const Eigen::Vector3d& p) -> Cube& {
    const Eigen::Array3d at = (p.array() / spacing_m).floor();
    return cubes[{at.x(), at.y(), at.z()}];
  };
  const auto for_each_finite = [&](auto visit) {
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      if (const Eigen::Vector3d p = cloud[i].cast<double>(); p.allFinite()) visit(p, cube_at(p));
    }
  };
  for_each_finite([](const Eigen::Vector3d& p, Cube& cube) {
    cube.sum_m += p;
    cube.n += 1.0;
  });
  for_each_finite([](const Eigen::Vector3d& p, Cube& cube) {
    const double distance_m2 = (p - cube.sum_m / cube.n).squaredNorm();
    if (distance_m2 >= cube.nearest_m2) return;
    cube.nearest_m2 = distance_m2;
    cube.nearest_m = p;
  });
  std::vector<Eigen::Vector3d> result;
  for (const auto& [at, cube] : cubes) result.push_back(cube.nearest_m);
  return result;
}

}  // namespace raywatch
