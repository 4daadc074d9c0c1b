#include "core/m3c2.hpp"

#include <doctest/doctest.h>
#include <oneapi/tbb/task_arena.h>

#include <Eigen/Geometry>
#include <Eigen/SVD>
#include <cstring>

#include "core/error.hpp"
#include "tests/simulator/random.hpp"

namespace raywatch {
namespace {

using simulator::RandomSequence;

using Points = std::vector<Eigen::Vector3d>;

PointCloud cloud_of(const Points& points_m) {
  PointCloud cloud;
  for (const Eigen::Vector3d& p : points_m) {
    cloud.push_back(static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z()));
  }
  return cloud;
}

/// Rough ground with a step, and some points anywhere, turned into any direction.
Points random_scene(RandomSequence& random, const Eigen::Quaterniond& turn, double step_m) {
  Points points;
  for (int i = 0; i < 4000; ++i) {
    const double x = random.in({-10.0, 10.0}), y = random.in({-10.0, 10.0});
    const double z = std::sin(0.5 * x) * std::cos(0.4 * y) + (x > 2.0 ? step_m : 0.0) + 0.05 * random.normal();
    points.push_back(turn * Eigen::Vector3d(x, y, z));
  }
  for (int i = 0; i < 200; ++i) points.push_back(6.0 * random.normal_vector());
  return points;
}

double quantile_by_definition(std::vector<double> values, double share) {
  std::sort(values.begin(), values.end());
  const double place = share * static_cast<double>(values.size() - 1);
  const double low = values[static_cast<std::size_t>(std::floor(place))];
  const double high = values[static_cast<std::size_t>(std::ceil(place))];
  return low + (place - std::floor(place)) * (high - low);
}

/// Place and roughness of a cloud's points in the cylinder, every point looked at.
struct Side {
  std::size_t n = 0;
  double place_m = std::nan(""), roughness_m = std::nan("");
};
Side side_by_definition(const PointCloud& cloud, const Eigen::Vector3d& core_m, const Eigen::Vector3d& normal,
                        const M3c2Parameters& parameters) {
  std::vector<double> depths_m;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const Eigen::Vector3d offset_m = cloud[i].cast<double>() - core_m;
    const bool inside = offset_m.cross(normal).norm() <= parameters.projection_diameter_m / 2.0;
    if (inside && std::abs(offset_m.dot(normal)) <= parameters.max_distance_m) depths_m.push_back(offset_m.dot(normal));
  }
  Side side{.n = depths_m.size()};
  if (depths_m.empty()) return side;
  if (parameters.statistic == M3c2Statistic::median) {
    side.place_m = quantile_by_definition(depths_m, 0.5);
    side.roughness_m = quantile_by_definition(depths_m, 0.75) - quantile_by_definition(depths_m, 0.25);
    return side;
  }
  const Eigen::Map<const Eigen::ArrayXd> depths(depths_m.data(), static_cast<Eigen::Index>(depths_m.size()));
  side.place_m = depths.mean();
  side.roughness_m = std::sqrt((depths - depths.mean()).square().sum() / (static_cast<double>(side.n) - 1.0));
  return side;
}

/// The normal by a singular value decomposition of all points within D / 2.
Eigen::Vector3d normal_by_definition(const PointCloud& cloud, const Eigen::Vector3d& core_m,
                                     const Eigen::Vector3d& sensor_m, double diameter_m) {
  Points near;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    if ((cloud[i].cast<double>() - core_m).norm() <= diameter_m / 2.0) near.push_back(cloud[i].cast<double>());
  }
  if (near.size() < 4) return Eigen::Vector3d::Constant(std::nan(""));
  Eigen::MatrixX3d rows(static_cast<Eigen::Index>(near.size()), 3);
  for (std::size_t i = 0; i < near.size(); ++i) rows.row(static_cast<Eigen::Index>(i)) = near[i].transpose();
  rows.rowwise() -= rows.colwise().mean().eval();
  const Eigen::Vector3d normal = Eigen::JacobiSVD<Eigen::MatrixXd>(rows, Eigen::ComputeFullV).matrixV().col(2);
  return normal.dot(sensor_m - core_m) < 0.0 ? Eigen::Vector3d(-normal) : normal;
}

bool close(double a, double b) { return (std::isnan(a) && std::isnan(b)) || std::abs(a - b) <= 1e-9; }

bool agrees(const M3c2Distance& found, const PointCloud& before, const PointCloud& after, const Eigen::Vector3d& core_m,
            const Eigen::Vector3d& sensor_m, const M3c2Parameters& parameters) {
  const Eigen::Vector3d normal = normal_by_definition(before, core_m, sensor_m, parameters.normal_diameter_m);
  if (!normal.allFinite()) return !found.normal.allFinite() && std::isnan(found.distance_m);
  const Side a = side_by_definition(before, core_m, normal, parameters);
  const Side b = side_by_definition(after, core_m, normal, parameters);
  const bool detectable = std::min(a.n, b.n) >= parameters.least_points;
  const double error_m = std::sqrt(a.roughness_m * a.roughness_m / static_cast<double>(a.n) +
                                   b.roughness_m * b.roughness_m / static_cast<double>(b.n));
  return (found.normal - normal).norm() < 1e-9 && found.before.points == a.n && found.after.points == b.n &&
         close(found.distance_m, b.place_m - a.place_m) &&
         close(found.lod95_m, detectable ? 1.96 * (error_m + parameters.registration_m) : std::nan(""));
}

TEST_CASE("at 99.9 % of the core points, the result is that of the definition, evaluated point by point") {
  std::size_t checked = 0, agreeing = 0, significant = 0;
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    RandomSequence random(seed);
    const Eigen::Quaterniond turn =
        Eigen::Quaterniond(random.normal(), random.normal(), random.normal(), random.normal()).normalized();
    const PointCloud before = cloud_of(random_scene(random, turn, 0.0));
    const PointCloud after = cloud_of(random_scene(random, turn, random.in({-1.0, 1.0})));
    const M3c2Parameters parameters{.normal_diameter_m = random.in({1.5, 4.0}),
                                    .projection_diameter_m = random.in({0.5, 2.0}),
                                    .max_distance_m = random.in({0.5, 5.0}),
                                    .registration_m = 0.01,
                                    .statistic = seed % 2 == 0 ? M3c2Statistic::mean : M3c2Statistic::median};
    const Points sensors{turn * Eigen::Vector3d(0.0, -12.0, 8.0)};
    Points cores = core_points_of(before, 1.2);
    cores.resize(std::min<std::size_t>(cores.size(), 250));
    const std::vector<M3c2Distance> found = m3c2({before, after, sensors}, cores, parameters);
    for (std::size_t i = 0; i < cores.size(); ++i) {
      ++checked;
      agreeing += agrees(found[i], before, after, cores[i], sensors.front(), parameters) ? 1 : 0;
      significant += found[i].significant() ? 1 : 0;
    }
  }
  CHECK(checked >= 1500);
  CHECK(significant >= 100);
  CHECK(static_cast<double>(agreeing) >= 0.999 * static_cast<double>(checked));
}

Points plane(double height_m, double noise_m, std::uint64_t seed) {
  RandomSequence random(seed);
  Points points;
  for (int i = 0; i < 20000; ++i) {
    points.push_back({random.in({-5.0, 5.0}), random.in({-5.0, 5.0}), height_m + noise_m * random.normal()});
  }
  return points;
}

TEST_CASE("a plane that rises towards the sensor has a positive distance, its height; from below a negative one") {
  const PointCloud before = cloud_of(plane(0.0, 0.01, 1)), after = cloud_of(plane(0.3, 0.01, 2));
  const Points cores{{0, 0, 0}, {1, 1, 0}};
  for (const double side : {1.0, -1.0}) {
    const Points sensors{{0.0, 0.0, side * 10.0}};
    for (const M3c2Distance& at : m3c2({before, after, sensors}, cores, {})) {
      CHECK(at.distance_m == doctest::Approx(side * 0.3).epsilon(0.02));
      CHECK(at.normal.z() == doctest::Approx(side).epsilon(1e-3));
      CHECK(at.significant());
    }
  }
}

TEST_CASE("of a plane that did not move about 5 % is called significant, when only noise parts the two") {
  const PointCloud before = cloud_of(plane(0.0, 0.02, 3)), after = cloud_of(plane(0.0, 0.02, 4));
  const Points cores = core_points_of(before, 0.6);
  std::size_t significant = 0, all = 0;
  for (const M3c2Distance& at : m3c2({before, after, {}}, cores, {.projection_diameter_m = 0.5})) {
    if (std::isnan(at.lod95_m)) continue;
    ++all;
    significant += at.significant() ? 1 : 0;
  }
  CHECK(all > 200);
  CHECK(static_cast<double>(significant) / static_cast<double>(all) == doctest::Approx(0.05).epsilon(1.0));
}

TEST_CASE("where a cloud has no points, there is no distance, and where it has few, no level of detection") {
  const PointCloud before = cloud_of(plane(0.0, 0.01, 5)), nothing;
  const PointCloud one = cloud_of({{0.0, 0.0, 0.5}});
  const Points cores{{0, 0, 0}, {100, 0, 0}};
  const std::vector<M3c2Distance> gone = m3c2({before, nothing, {}}, cores, {});
  CHECK(std::isnan(gone[0].distance_m));
  CHECK(gone[0].before.points > 0);
  CHECK_FALSE(gone[1].normal.allFinite());
  const M3c2Distance single = m3c2({before, one, {}}, cores, {}).front();
  CHECK(single.distance_m == doctest::Approx(0.5).epsilon(0.05));
  CHECK(std::isnan(single.lod95_m));
  CHECK_FALSE(single.significant());
}

TEST_CASE("one thread and eight give the same bytes") {
  RandomSequence random(9);
  const PointCloud before = cloud_of(random_scene(random, Eigen::Quaterniond::Identity(), 0.0));
  const PointCloud after = cloud_of(random_scene(random, Eigen::Quaterniond::Identity(), 0.4));
  const Points cores = core_points_of(before, 1.0);
  const auto run = [&](int threads) {
    tbb::task_arena arena(threads);
    return arena.execute([&] { return m3c2({before, after, {}}, cores, {}); });
  };
  const std::vector<M3c2Distance> one = run(1), eight = run(8);
  for (std::size_t i = 0; i < cores.size(); ++i) {
    CHECK(std::memcmp(&one[i].distance_m, &eight[i].distance_m, sizeof(double)) == 0);
    CHECK(std::memcmp(&one[i].lod95_m, &eight[i].lod95_m, sizeof(double)) == 0);
  }
}

TEST_CASE("core points are points of the cloud, one a cube") {
  const PointCloud cloud = cloud_of(plane(0.05, 0.0, 6));
  const Points cores = core_points_of(cloud, 1.0);
  CHECK(cores.size() == 100);
  for (const Eigen::Vector3d& core : cores) CHECK(core.z() == doctest::Approx(0.05).epsilon(1e-6));
}

TEST_CASE("parameters out of their range are refused by name") {
  const PointCloud cloud = cloud_of(plane(0.0, 0.0, 7));
  CHECK_THROWS_AS(m3c2({cloud, cloud, {}}, {}, {.normal_diameter_m = 0.0}), InvalidInput);
  CHECK_THROWS_AS(m3c2({cloud, cloud, {}}, {}, {.registration_m = -1.0}), InvalidInput);
  CHECK_THROWS_AS(core_points_of(cloud, 0.0), InvalidInput);
}

}  // namespace
}  // namespace raywatch
