#include "tests/simulator/registration.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "tests/simulator/scanner.hpp"

using namespace raywatch;
using namespace raywatch::simulator;

TEST_CASE("without an error the pose stays as it is") {
  const Pose pose{Eigen::Quaterniond(0.5, 0.5, 0.5, 0.5), {1.0, 2.0, 3.0}};
  const Pose same = disturbed(pose, {}, 7);
  CHECK(same.position_m == pose.position_m);
  CHECK(same.orientation.coeffs() == pose.orientation.coeffs());
}

TEST_CASE("registration errors have the given standard deviations about each axis") {
  const Pose pose{Eigen::Quaterniond(0.5, 0.5, 0.5, 0.5), {1000.0, 2.0, 3.0}};
  const RegistrationError error{.position_sigma_m = 0.01, .angle_sigma_rad = radians(0.05)};
  double shift_squares = 0.0;
  double turn_squares = 0.0;
  constexpr int kCount = 4000;
  for (int i = 0; i < kCount; ++i) {
    const Pose wrong = disturbed(pose, error, static_cast<std::uint64_t>(i));
    const double turn_rad = wrong.orientation.angularDistance(pose.orientation);
    shift_squares += (wrong.position_m - pose.position_m).squaredNorm() / 3.0;
    turn_squares += turn_rad * turn_rad / 3.0;
  }
  CHECK(std::sqrt(shift_squares / kCount) == doctest::Approx(0.01).epsilon(0.03));
  CHECK(std::sqrt(turn_squares / kCount) == doctest::Approx(radians(0.05)).epsilon(0.03));
}
