#include "tests/simulator/height_field.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "tests/simulator/random.hpp"

using namespace raywatch::simulator;

namespace {

const FieldLayout kLayout{{-20.0, -20.0}, 0.5, 81, 81};

double hills_m(const Eigen::Vector2d& place_m) {
  return 1.5 * std::sin(0.7 * place_m.x()) * std::cos(0.5 * place_m.y()) + 0.05 * place_m.x();
}

/// The first crossing from above to below, by small steps and bisection.
std::optional<double> march(const HeightField& field, const Ray& ray, double far_m) {
  const auto above_m = [&](double t) { return ray.at(t).z() - field.height_m(ray.at(t).head<2>()); };
  constexpr double kStep_m = 2e-3;
  for (double t = 0.0; t < far_m; t += kStep_m) {
    if (above_m(t + kStep_m) > 0.0) continue;
    double low = t;
    double high = t + kStep_m;
    for (int i = 0; i < 60; ++i) (above_m(0.5 * (low + high)) > 0.0 ? low : high) = 0.5 * (low + high);
    return low;
  }
  return std::nullopt;
}

}  // namespace

TEST_CASE("a sloping field is a plane to every ray that meets it") {
  const HeightField field(kLayout, [](const Eigen::Vector2d& p) { return 0.25 * p.x() - 0.5 * p.y() + 3.0; });
  const Eigen::Vector3d normal = Eigen::Vector3d(-0.25, 0.5, 1.0).normalized();
  RandomSequence random(1);
  for (int i = 0; i < 300; ++i) {
    const double x = random.in({-19.0, 19.0});
    const double y = random.in({-19.0, 19.0});
    const Eigen::Vector3d target_m(x, y, 0.25 * x - 0.5 * y + 3.0);
    const Eigen::Vector3d origin_m = Eigen::Vector3d(1.0, 2.0, 2.25 + random.in({0.1, 30.0}));
    const Ray ray{origin_m, (target_m - origin_m).normalized()};
    const auto range_m = field.intersect(ray);
    REQUIRE(range_m.has_value());
    CHECK(*range_m == doctest::Approx((target_m - origin_m).norm()).epsilon(1e-9));
    CHECK((field.normal(target_m.head<2>()) - normal).norm() < 1e-9);
  }
}

TEST_CASE("rays meet hills where marching along them in small steps does") {
  const HeightField field(kLayout, hills_m);
  RandomSequence random(2);
  int hits = 0;
  for (int i = 0; i < 200; ++i) {
    const Eigen::Vector3d origin_m(random.in({-15.0, 15.0}), random.in({-15.0, 15.0}), random.in({2.5, 6.0}));
    const double azimuth_rad = random.in({0.0, 2.0 * std::numbers::pi});
    const double elevation_rad = random.in({-0.6, 0.0});
    const Ray ray{origin_m, Eigen::Vector3d(std::cos(azimuth_rad) * std::cos(elevation_rad),
                                            std::sin(azimuth_rad) * std::cos(elevation_rad), std::sin(elevation_rad))};
    // The marched field continues level beyond its border, the traced one ends there.
    const auto traced_m = field.intersect(ray);
    const auto marched_m = march(field, ray, 60.0);
    const bool inside = marched_m && ray.at(*marched_m).head<2>().cwiseAbs().maxCoeff() < 20.0;
    REQUIRE(traced_m.has_value() == inside);
    if (!inside) continue;
    ++hits;
    CHECK(*traced_m == doctest::Approx(*marched_m).epsilon(1e-6));
  }
  CHECK(hits > 100);
}

TEST_CASE("straight down and along lines of the grid the height is found exactly") {
  const HeightField field(kLayout, hills_m);
  for (const double x : {-20.0, -3.0, 0.0, 7.25, 20.0}) {
    const Eigen::Vector2d place_m(x, 4.5);
    const auto range_m = field.intersect({{x, 4.5, 50.0}, {0.0, 0.0, -1.0}});
    REQUIRE(range_m.has_value());
    CHECK(50.0 - *range_m == doctest::Approx(field.height_m(place_m)).epsilon(1e-12));
  }
  CHECK_FALSE(field.intersect({{0.0, 0.0, 50.0}, {0.0, 0.0, 1.0}}).has_value());
  CHECK_FALSE(field.intersect({{25.0, 0.0, 50.0}, {0.0, 0.0, -1.0}}).has_value());
}

TEST_CASE("filling a pyramid changes the volume by a third of base times height") {
  // Flat, and a pyramid over a base of 16 m x 16 m, which bilinear cells follow exactly but along its diagonals.
  const HeightField flat(kLayout, [](const Eigen::Vector2d&) { return 1.0; });
  const HeightField piled(kLayout, [](const Eigen::Vector2d& p) {
    return 1.0 + std::max(0.0, 4.0 * (1.0 - p.cwiseAbs().maxCoeff() / 8.0));
  });
  const double volume_m3 = 16.0 * 16.0 * 4.0 / 3.0;
  CHECK(volume_change(flat, piled).filled_m3 == doctest::Approx(volume_m3).epsilon(2e-3));
  CHECK(volume_change(flat, piled).cut_m3 == 0.0);
  CHECK(volume_change(piled, flat).cut_m3 == doctest::Approx(volume_m3).epsilon(2e-3));
}

TEST_CASE("a trench and a ridge of bilinear shape have exactly known volumes") {
  // Along x: a ramp from 0 down to -1 m and up again over 2 cells each way; along y constant over 40 m.
  const HeightField flat(kLayout, [](const Eigen::Vector2d&) { return 0.0; });
  const HeightField trench(kLayout, [](const Eigen::Vector2d& p) { return -std::max(0.0, 1.0 - std::abs(p.x())); });
  CHECK(volume_change(flat, trench).cut_m3 == doctest::Approx(40.0).epsilon(1e-12));
  CHECK(volume_change(flat, trench).filled_m3 == 0.0);
  // A field that is tilted about the y axis fills as much as it cuts: 40 m x 20 m x 1 m / 2.
  const HeightField tilted(kLayout, [](const Eigen::Vector2d& p) { return p.x() / 20.0; });
  CHECK(volume_change(flat, tilted).filled_m3 == doctest::Approx(400.0).epsilon(1e-12));
  CHECK(volume_change(flat, tilted).cut_m3 == doctest::Approx(400.0).epsilon(1e-12));
}

// Rays that start on a border between cells and hardly leave it never got on: each step was as short as rounding
// allows.
TEST_CASE("rays that start exactly on the nodes end, however they run along the borders of cells") {
  const HeightField field(kLayout, hills_m);
  const FieldLayout& layout = field.layout();
  int ends = 0, hits = 0;
  for (std::uint32_t node = 1; node + 1 < layout.columns; node += 3) {
    const Eigen::Vector2d place_m = layout.node_m(node, layout.rows - 1 - node);
    for (const double above_m : {0.0, 3.0}) {
      const Eigen::Vector3d from_m(place_m.x(), place_m.y(), field.height_m(place_m) + above_m);
      for (const double lean : {0.0, 1e-17, -1e-17, 1e-12, -1e-12}) {
        for (const double down : {-1.0, -0.2, 0.0, 1.0}) {
          const double level = std::sqrt(1.0 - down * down);
          for (const Eigen::Vector3d& direction :
               {Eigen::Vector3d(lean, level, down), Eigen::Vector3d(-level, lean, down)}) {
            const auto range_m = field.intersect({from_m, direction});
            ++ends;
            hits += range_m ? 1 : 0;
            if (down == -1.0 && above_m > 0.0) CHECK(range_m.value_or(0.0) == doctest::Approx(above_m));
          }
        }
      }
    }
  }
  CHECK(ends == 27 * 2 * 5 * 4 * 2);
  CHECK(hits > ends / 4);
}
