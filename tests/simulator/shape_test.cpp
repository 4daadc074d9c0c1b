#include "tests/simulator/shape.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "tests/simulator/random.hpp"

using namespace raywatch;
using namespace raywatch::simulator;

namespace {

constexpr double kExact = 1e-12;

Ray towards(const Eigen::Vector3d& origin_m, const Eigen::Vector3d& target_m) {
  return {origin_m, (target_m - origin_m).normalized()};
}

double range_m(const Ray& ray, const Shape& shape) { return intersect(ray, shape).value(); }

Pose turned(double angle_rad, const Eigen::Vector3d& axis, const Eigen::Vector3d& position_m) {
  return {Eigen::Quaterniond(Eigen::AngleAxisd(angle_rad, axis.normalized())), position_m};
}

}  // namespace

TEST_CASE("a slanted ray meets a plane at its height divided by the sine of its descent") {
  const Plane ground{{5.0, -3.0, 0.0}, Eigen::Vector3d::UnitZ()};
  const double descent_rad = 0.3;
  const Ray ray{{0.0, 0.0, 2.0}, {std::cos(descent_rad), 0.0, -std::sin(descent_rad)}};
  CHECK(range_m(ray, ground) == doctest::Approx(2.0 / std::sin(descent_rad)).epsilon(kExact));
  CHECK_FALSE(intersect({ray.origin_m, -ray.direction}, ground).has_value());
  CHECK_FALSE(intersect({ray.origin_m, Eigen::Vector3d::UnitX()}, ground).has_value());
}

TEST_CASE("a box turned by 45 degrees is met at its edge") {
  const Box box{turned(0.25 * std::numbers::pi, Eigen::Vector3d::UnitZ(), {10.0, 0.0, 0.0}), {1.0, 1.0, 1.0}};
  CHECK(range_m({{0, 0, 0}, {1, 0, 0}}, box) == doctest::Approx(10.0 - std::sqrt(2.0)).epsilon(kExact));
  CHECK(range_m({{10, 0, 5}, {0, 0, -1}}, box) == doctest::Approx(4.0).epsilon(kExact));
  CHECK(range_m({{10, 0, 0}, {0, 0, 1}}, box) == doctest::Approx(1.0).epsilon(kExact));
  CHECK_FALSE(intersect({{0, 0, 1.001}, {1, 0, 0}}, box).has_value());
  CHECK_FALSE(intersect({{0, 0, 0}, {-1, 0, 0}}, box).has_value());
}

TEST_CASE("a room is seen from inside only") {
  const Room room{{Eigen::Quaterniond::Identity(), {0.0, 0.0, 2.0}}, {5.0, 4.0, 2.0}};
  CHECK(range_m({{1, 0, 1}, {1, 0, 0}}, room) == doctest::Approx(4.0).epsilon(kExact));
  CHECK(range_m({{1, 0, 1}, {0, 0, -1}}, room) == doctest::Approx(1.0).epsilon(kExact));
  CHECK(range_m({{-20, 0, 1}, {1, 0, 0}}, room) == doctest::Approx(25.0).epsilon(kExact));
}

TEST_CASE("a cylinder is met on its side, on its caps, and not beyond them") {
  const Cylinder upright{{Eigen::Quaterniond::Identity(), {10.0, 0.0, 1.0}}, 0.5, 1.0};
  CHECK(range_m({{0, 0, 1}, {1, 0, 0}}, upright) == doctest::Approx(9.5).epsilon(kExact));
  CHECK(range_m({{0, 0.3, 1}, {1, 0, 0}}, upright) == doctest::Approx(9.6).epsilon(kExact));
  CHECK(range_m({{10.2, 0.1, 7}, {0, 0, -1}}, upright) == doctest::Approx(5.0).epsilon(kExact));
  CHECK_FALSE(intersect({{0, 0, 2.001}, {1, 0, 0}}, upright).has_value());
  CHECK_FALSE(intersect({{0, 0.501, 1}, {1, 0, 0}}, upright).has_value());

  const Cylinder lying{turned(0.5 * std::numbers::pi, Eigen::Vector3d::UnitY(), {10.0, 0.0, 0.0}), 0.5, 2.0};
  CHECK(range_m({{0, 0, 0}, {1, 0, 0}}, lying) == doctest::Approx(8.0).epsilon(kExact));
  CHECK(range_m({{9, 0, 3}, {0, 0, -1}}, lying) == doctest::Approx(2.5).epsilon(kExact));
}

TEST_CASE("a sphere is met where the chord through it begins, even from very far away") {
  const Sphere sphere{{1000.0, 0.0, 0.0}, 0.1};
  CHECK(range_m({{0, 0, 0}, {1, 0, 0}}, sphere) == doctest::Approx(999.9).epsilon(kExact));
  CHECK(range_m({{0, 0.06, 0}, {1, 0, 0}}, sphere) == doctest::Approx(999.92).epsilon(kExact));
  CHECK_FALSE(intersect({{0, 0.1001, 0}, {1, 0, 0}}, sphere).has_value());
}

TEST_CASE("a disc is met inside its radius and from both sides") {
  const Disc disc{{5.0, 0.0, 0.0}, Eigen::Vector3d(1.0, 0.0, 1.0).normalized(), 0.5};
  CHECK(range_m({{0, 0, 0}, {1, 0, 0}}, disc) == doctest::Approx(5.0).epsilon(kExact));
  CHECK(range_m({{0, 0, 0.2}, {1, 0, 0}}, disc) == doctest::Approx(4.8).epsilon(kExact));
  CHECK(range_m({{9, 0, 0}, {-1, 0, 0}}, disc) == doctest::Approx(4.0).epsilon(kExact));
  CHECK_FALSE(intersect({{0, 0.51, 0}, {1, 0, 0}}, disc).has_value());
}

TEST_CASE("every hit on a bounded shape lies in its bounds, and moves with it") {
  RandomSequence random(3);
  const std::vector<Shape> shapes{Box{turned(0.7, {1, 2, 3}, {4, 5, 6}), {1.0, 0.5, 2.0}},
                                  Cylinder{turned(1.1, {3, 1, -1}, {4, 5, 6}), 0.7, 1.5}, Sphere{{4, 5, 6}, 1.2},
                                  Disc{{4, 5, 6}, Eigen::Vector3d(1, 1, 2).normalized(), 1.5}};
  const Pose motion = turned(2.0, {1, -1, 0.5}, {100.0, -50.0, 20.0});
  for (const Shape& shape : shapes) {
    Eigen::AlignedBox3d generous = bounds(shape).value();
    generous.extend(generous.min() - Eigen::Vector3d::Constant(1e-9));
    generous.extend(generous.max() + Eigen::Vector3d::Constant(1e-9));
    int hits = 0;
    for (int i = 0; i < 500; ++i) {
      const Ray ray = towards(Eigen::Vector3d(4, 5, 6) + 9.0 * random.normal_vector().normalized(),
                              Eigen::Vector3d(4, 5, 6) + 0.7 * random.normal_vector());
      const auto range = intersect(ray, shape);
      const Ray moved_ray{motion * ray.origin_m, motion.orientation * ray.direction};
      const auto moved_range = intersect(moved_ray, moved(shape, motion));
      REQUIRE(range.has_value() == moved_range.has_value());
      if (!range) continue;
      ++hits;
      CHECK(generous.contains(ray.at(*range)));
      CHECK(*moved_range == doctest::Approx(*range).epsilon(1e-9));
    }
    CHECK(hits > 50);
  }
}

TEST_CASE("solid shapes know their volume and what they enclose") {
  const Box box{{}, {1.0, 2.0, 3.0}};
  CHECK(volume_m3(box) == doctest::Approx(48.0));
  CHECK(volume_m3(Cylinder{{}, 2.0, 1.5}) == doctest::Approx(12.0 * std::numbers::pi));
  CHECK(volume_m3(Sphere{Eigen::Vector3d::Zero(), 1.0}) == doctest::Approx(4.0 / 3.0 * std::numbers::pi));
  CHECK(volume_m3(Plane{Eigen::Vector3d::Zero(), Eigen::Vector3d::UnitZ()}) == 0.0);
  CHECK(encloses(box, {0.9, -1.9, 2.9}));
  CHECK_FALSE(encloses(box, {1.1, 0.0, 0.0}));
  CHECK_FALSE(encloses(Room{{}, {1.0, 1.0, 1.0}}, {0.0, 0.0, 0.0}));
}
