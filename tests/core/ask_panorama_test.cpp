// Whole panoramas, as sensors take them, against the definition evaluated by brute force: here most answers come from
// the bounds of cells, not from single returns.

#include <doctest/doctest.h>
#include <rapidcheck.h>

#include <array>
#include <cmath>
#include <numbers>
#include <random>

#include "core/prior_index.hpp"
#include "tests/support/brute_force.hpp"

namespace raywatch {
namespace {

using testing::brute_force_answer;
using testing::usable_returns;

constexpr double kPi = std::numbers::pi;

/// A world of which every direction shows something: a room with a step in its range every few degrees.
double range_of_world(double azimuth, double elevation, double scale_m) {
  const double wall =
      1.0 / std::max({std::abs(std::cos(azimuth) * std::cos(elevation)),
                      std::abs(std::sin(azimuth) * std::cos(elevation)), std::abs(std::sin(elevation))});
  const bool is_box = std::sin(7.0 * azimuth) > 0.7 && std::sin(9.0 * elevation) > 0.3;
  return scale_m * (is_box ? 0.6 * wall : wall);
}

struct Panorama {
  double azimuth_step, elevation_step, lowest, highest;  // radians
  double scale_m, noise_m;
};

PointCloud take(const Panorama& panorama, const Pose& world_from_sensor, std::mt19937& random, double shift) {
  std::normal_distribution<double> noise(0.0, 1.0);
  PointCloud cloud;
  for (double elevation = panorama.lowest; elevation <= panorama.highest; elevation += panorama.elevation_step) {
    for (double azimuth = -kPi; azimuth < kPi; azimuth += panorama.azimuth_step) {
      const double a = azimuth + shift;
      const double range = range_of_world(a, elevation, panorama.scale_m) +
                           panorama.noise_m * (noise(random) + 20.0 * (noise(random) > 2.2));
      const Eigen::Vector3d p = range * Eigen::Vector3d(std::cos(elevation) * std::cos(a),
                                                        std::cos(elevation) * std::sin(a), std::sin(elevation));
      const Eigen::Vector3d q = world_from_sensor.inverse() * p;
      cloud.push_back(static_cast<float>(q.x()), static_cast<float>(q.y()), static_cast<float>(q.z()));
    }
  }
  return cloud;
}

/// About 150 of the points of a panorama in the prior's frame, some of them moved towards the sensor, away from it, or
/// to any direction; as points of a frame that `prior_from_points` leads out of.
PointCloud questions(const PointCloud& panorama, const Pose& prior_from_points, std::mt19937& random) {
  constexpr std::array<double, 4> kFactors{1.0, 1.0, 0.85, 1.15};
  std::normal_distribution<double> normal(0.0, 1.0);
  PointCloud points;
  for (std::size_t i = random() % 37; i < panorama.size(); i += 1 + panorama.size() / 150) {
    Eigen::Vector3d y = kFactors[random() % kFactors.size()] * panorama[i].cast<double>();
    if (random() % 10 == 0) y = y.norm() * Eigen::Vector3d(normal(random), normal(random), normal(random)).normalized();
    const Eigen::Vector3d q = prior_from_points.inverse() * y;
    points.push_back(static_cast<float>(q.x()), static_cast<float>(q.y()), static_cast<float>(q.z()));
  }
  return points;
}

struct Tally {
  std::size_t total = 0, free = 0, differing = 0;
  std::array<std::size_t, 5> answers{};
};

void hold_against_definition(const Panorama& panorama, const Thresholds& thresholds, const Pose& prior_from_points,
                             std::uint32_t seed, Tally& tally) {
  std::mt19937 random(seed);
  const PointCloud prior = take(panorama, Pose{}, random, 0.0);
  const PointCloud points =
      questions(take(panorama, Pose{}, random, 0.3 * panorama.azimuth_step), prior_from_points, random);
  const PriorIndex index = PriorIndex::build(prior, {});
  const std::vector<std::uint8_t> valid(points.size(), 1);
  std::vector<Answer> answers(points.size());
  ask(index, points, valid, prior_from_points, thresholds, answers);
  RC_ASSERT(testing::free_points(index, points, valid, prior_from_points, thresholds) == testing::are_free(answers));
  const std::vector<Eigen::Vector3d> returns = usable_returns(prior, {});
  const Eigen::Matrix3d rotation = prior_from_points.orientation.toRotationMatrix();
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector3d y = rotation * points[i].cast<double>() + prior_from_points.position_m;
    const auto expected = brute_force_answer(returns, y, thresholds);
    ++tally.total;
    tally.free += expected.answer == Answer::free;
    ++tally.answers[static_cast<std::size_t>(expected.answer)];
    const bool differs = answers[i] != expected.answer;
    tally.differing += differs;
    if (differs && expected.margin > 1e-10) {
      RC_FAIL("point " + std::to_string(i) + " of seed " + std::to_string(seed) + ": " +
              std::to_string(static_cast<int>(answers[i])) + " instead of " +
              std::to_string(static_cast<int>(expected.answer)) + ", margin " + std::to_string(expected.margin));
    }
  }
}

}  // namespace

TEST_CASE("the answers about whole panoramas are those of the definition, for fine and coarse sensors and thresholds") {
  Tally tally;
  CHECK(rc::check([&] {
    const auto seed = *rc::gen::arbitrary<std::uint32_t>();
    std::mt19937 random(seed);
    const auto uniform = [&](double low, double high) {
      return std::uniform_real_distribution<double>(low, high)(random);
    };
    const double step = 0.015 * std::pow(4.0, uniform(0.0, 1.0));
    Panorama panorama{.azimuth_step = step,
                      .elevation_step = step * uniform(0.7, 3.0),
                      .lowest = uniform(-1.5707, -0.3),
                      .highest = uniform(0.1, 1.5707),
                      .scale_m = 0.5 * std::pow(1000.0, uniform(0.0, 1.0))};
    panorama.noise_m = 0.004 * panorama.scale_m * uniform(0.0, 1.0);
    const Thresholds thresholds{.angle_rad = step * 0.7 * std::pow(12.0, uniform(0.0, 1.0)),
                                .range_m = panorama.scale_m * 0.02 * uniform(0.2, 2.0)};
    const Eigen::Vector3d axis(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1));
    const Pose prior_from_points{Eigen::Quaterniond(Eigen::AngleAxisd(uniform(-3.0, 3.0), axis.normalized())),
                                 0.2 * panorama.scale_m * uniform(0.0, 1.0) * axis};
    hold_against_definition(panorama, thresholds, prior_from_points, seed, tally);
  }));
  MESSAGE(tally.total << " questions, " << tally.free << " free, " << tally.differing << " answered otherwise");
  CHECK(tally.differing <= tally.total / 10000);
  for (const std::size_t count : tally.answers) CHECK(count > tally.total / 500);
}

TEST_CASE("a scan asked about itself supports every point, whatever the thresholds") {
  std::mt19937 random(7);
  const Panorama panorama{
      .azimuth_step = 0.02, .elevation_step = 0.03, .lowest = -1.2, .highest = 1.5, .scale_m = 20.0, .noise_m = 0.02};
  const PointCloud cloud = take(panorama, Pose{}, random, 0.0);
  const PriorIndex index = PriorIndex::build(cloud, {});
  for (const double angle_rad : {0.0005, 0.01, 0.05, 0.5}) {
    std::vector<Answer> answers(cloud.size());
    ask(index, cloud, std::vector<std::uint8_t>(cloud.size(), 1), Pose{}, {.angle_rad = angle_rad, .range_m = 0.01},
        answers);
    CHECK(std::count(answers.begin(), answers.end(), Answer::supported) == static_cast<std::ptrdiff_t>(cloud.size()));
  }
}

}  // namespace raywatch
