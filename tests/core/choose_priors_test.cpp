// Which earlier scans become priors, and why.

#include "core/choose_priors.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

namespace raywatch {
namespace {

using namespace std::chrono_literals;

constexpr Time kNow{std::chrono::sys_days{std::chrono::year{2026} / 3 / 1}};

/// A cylinder of radius 10 m around the z axis, seen from `position_m` between two azimuths.
PointCloud arc(const Eigen::Vector3d& position_m, double from_deg, double to_deg) {
  PointCloud cloud;
  for (double azimuth = from_deg; azimuth < to_deg; azimuth += 0.5) {
    for (double z = -2.0; z <= 2.0; z += 0.2) {
      const double a = azimuth * std::numbers::pi / 180.0;
      const Eigen::Vector3d p = Eigen::Vector3d(10 * std::cos(a), 10 * std::sin(a), z) - position_m;
      cloud.push_back(static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z()));
    }
  }
  return cloud;
}

PriorCandidate candidate(const Eigen::Vector3d& position_m, double from_deg, double to_deg, Duration age) {
  return {.world_from_sensor = {Eigen::Quaterniond::Identity(), position_m},
          .captured_at = kNow - age,
          .coverage = std::make_shared<const Panorama>(make_panorama(arc(position_m, from_deg, to_deg), {}))};
}

std::vector<CandidateAssessment> choose(const std::vector<PriorCandidate>& candidates, std::size_t limit = 4) {
  const auto sample = sample_world_points(arc(Eigen::Vector3d::Zero(), -90, 90), Pose{}, {}, 500);
  return choose_priors(sample, Pose{}, kNow, candidates, {.max_priors = limit});
}

TEST_CASE("the scan that overlaps most is taken first, and one that sees elsewhere not at all") {
  const auto assessed =
      choose({candidate({1, 0, 0}, -90, 0, 1h), candidate({0, 1, 0}, -90, 90, 2h), candidate({0, 0, 0}, 100, 170, 1h)});
  CHECK(assessed[0].overlap == doctest::Approx(0.5).epsilon(0.1));
  CHECK(assessed[1].overlap > 0.95);
  CHECK(assessed[1].chosen);
  CHECK(assessed[1].gain > 0.95);
  CHECK(assessed[2].overlap < 0.02);
  CHECK_FALSE(assessed[2].chosen);
  CHECK(assessed[2].reason.find("too little overlap") == 0);
  CHECK(assessed[0].distance_m == doctest::Approx(1.0));
  CHECK(assessed[0].age == 1h);
}

TEST_CASE("two halves are preferred over the same half twice") {
  const auto assessed = choose(
      {candidate({0, 0, 0}, -90, 5, 1h), candidate({0.1, 0, 0}, -90, 4, 1h), candidate({0, 0.1, 0}, 10, 90, 1h)}, 2);
  CHECK(assessed[0].chosen);
  CHECK_FALSE(assessed[1].chosen);
  CHECK(assessed[2].chosen);
  CHECK(assessed[1].reason.find("the limit of 2 priors") == 0);
  CHECK(assessed[2].gain > 0.4);
  CHECK(assessed[1].gain < 0.05);
}

TEST_CASE("of two that see the same the newer is taken") {
  const auto assessed = choose({candidate({0, 0, 0}, -90, 90, 3h), candidate({0, 0, 0}, -90, 90, 1h)}, 1);
  CHECK_FALSE(assessed[0].chosen);
  CHECK(assessed[1].chosen);
}

TEST_CASE("scans that were asked for are chosen beyond the limit, unless they see nothing of the scan") {
  std::vector<PriorCandidate> candidates{candidate({0, 0, 0}, -90, 90, 3h), candidate({0, 0, 0}, -90, 90, 1h),
                                         candidate({0, 0, 0}, 100, 170, 1h)};
  for (auto& c : candidates) c.required = true;
  const auto assessed = choose(candidates, 1);
  CHECK(assessed[0].chosen);
  CHECK(assessed[1].chosen);
  CHECK_FALSE(assessed[2].chosen);
  CHECK(assessed[0].reason == "asked for");
}

TEST_CASE("without candidates and without a sample nothing is chosen and nothing breaks") {
  CHECK(choose({}).empty());
  const std::vector<PriorCandidate> candidates{candidate({0, 0, 0}, -90, 90, 1h)};
  const auto assessed = choose_priors({}, Pose{}, kNow, candidates, {});
  CHECK(assessed.front().overlap == 0.0);
  CHECK_FALSE(assessed.front().chosen);
}

TEST_CASE("a sample is spread over the scan, holds usable points only, and is no larger than the scan") {
  PointCloud cloud = arc(Eigen::Vector3d::Zero(), -90, 90);
  cloud.push_back(0, 0, 0);
  CHECK(sample_world_points(cloud, Pose{}, {}, 100).size() == 100);
  CHECK(sample_world_points(cloud, Pose{}, {}, 1'000'000).size() == cloud.size() - 1);
  CHECK(sample_world_points(cloud, Pose{}, {.max_m = 1.0}, 100).empty());
}

}  // namespace
}  // namespace raywatch
