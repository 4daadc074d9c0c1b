#include "tests/evaluate/volume_case.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "tests/simulator/height_field.hpp"

namespace raywatch::evaluation {
namespace {

TEST_CASE("on simulated pits the intervals hold the true volumes, and the bounds that of the whole zone") {
  // A sample of what VOLUMES.md reports of 1,000 pits.
  constexpr std::uint64_t kPits = 5;
  int held = 0;
  double score2 = 0.0;
  for (std::uint64_t seed = 1; seed <= kPits; ++seed) {
    const VolumeCase pit = make_volume_case(seed, {.azimuth_steps = 240, .elevation_steps = 220});
    const VolumeFigure& net = pit.volumes.net;
    const double error_m3 = std::abs(net.value_m3 - pit.net_m3), interval_m3 = 1.96 * net.sigma_m3();
    CHECK(error_m3 <= std::max(0.02 * (pit.cut_m3 + pit.fill_m3), 1.5 * interval_m3));
    CHECK(pit.volumes.whole().low_m3 <= pit.whole_net_m3);
    CHECK(pit.volumes.whole().high_m3 >= pit.whole_net_m3);
    CHECK(pit.cut_m3 + pit.fill_m3 > 500.0);
    held += error_m3 <= interval_m3 ? 1 : 0;
    score2 += std::pow(error_m3 / net.sigma_m3(), 2.0);
  }
  CHECK(held >= 4);
  CHECK(score2 / kPits > 0.05);  // nor is it far too wide
}

TEST_CASE("the mean height over a rectangle is exact, also across cells") {
  const simulator::FieldLayout layout{{0.0, 0.0}, 1.0, 4, 4};
  const simulator::HeightField field(layout, [](const Eigen::Vector2d& p) { return p.x() * p.y(); });
  // The mean of x y over [0.5, 2.5] x [1, 2.5] is the product of the means.
  CHECK(simulator::mean_height_m(field, {Eigen::Vector2d(0.5, 1.0), Eigen::Vector2d(2.5, 2.5)}) ==
        doctest::Approx(1.5 * 1.75));
}

}  // namespace
}  // namespace raywatch::evaluation
