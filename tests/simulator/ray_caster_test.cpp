#include "tests/simulator/ray_caster.hpp"

#include <doctest/doctest.h>

#include "tests/simulator/ground.hpp"
#include "tests/simulator/random.hpp"
#include "tests/simulator/things.hpp"

using namespace raywatch;
using namespace raywatch::simulator;

namespace {

Scene crowded_scene(std::uint64_t seed) {
  RandomSequence random(seed);
  Scene scene;
  scene.add(Terrain{bumpy_ground({.half_size_m = 30.0, .bump_height_m = 0.5, .seed = seed}), nullptr});
  scene.add(Plane{{0.0, 25.0, 0.0}, -Eigen::Vector3d::UnitY()});
  StateId state = 0;
  const auto place = [&](const Shapes& thing) {
    const double x = random.in({-20.0, 20.0});
    const double y = random.in({-20.0, 20.0});
    scene.add(placed(thing, {{x, y, 0.0}, random.in({0.0, 6.0})}), ++state);
  };
  for (int i = 0; i < 8; ++i) {
    place(car(random));
    place(person(random));
    place(table({1.6, 0.8, 0.74}));
    place(fence({.length_m = 5.0}));
    place(leaves({.seed = random.seed()}, random.seed()));
  }
  return scene;
}

}  // namespace

TEST_CASE("casting through the hierarchy finds exactly what trying every solid finds") {
  const Scene scene = crowded_scene(5);
  const RayCaster world(scene);
  RandomSequence random(6);
  int hits = 0;
  for (int i = 0; i < 3000; ++i) {
    const double x = random.in({-25.0, 25.0});
    const Eigen::Vector3d origin_m(x, random.in({-25.0, 24.0}), random.in({1.0, 5.0}));
    const Ray ray{origin_m, random.normal_vector().normalized()};
    const auto fast = world.cast(ray);
    const auto slow = cast_by_brute_force(scene, ray);
    REQUIRE(fast.has_value() == slow.has_value());
    if (!fast) continue;
    ++hits;
    CHECK(fast->range_m == slow->range_m);
    CHECK(fast->solid == slow->solid);
    CHECK(fast->state == slow->state);
  }
  CHECK(hits > 1500);
}

TEST_CASE("rays along the axes find what lies on them") {
  Scene scene;
  for (int i = 1; i <= 20; ++i) {
    scene.add(Box{{Eigen::Quaterniond::Identity(), {3.0 * i, 0.0, 0.0}}, {0.5, 0.5, 0.5}}, static_cast<StateId>(i));
  }
  const RayCaster world(scene);
  const auto forwards = world.cast({{0, 0, 0}, {1, 0, 0}});
  REQUIRE(forwards.has_value());
  CHECK(forwards->range_m == 2.5);
  CHECK(forwards->state == 1);
  const auto backwards = world.cast({{100, 0.25, 0}, {-1, 0, 0}});
  REQUIRE(backwards.has_value());
  CHECK(backwards->state == 20);
  CHECK_FALSE(world.cast({{0, 0, 0}, {0, 1, 0}}).has_value());
}

TEST_CASE("an empty scene returns nothing") {
  const Scene scene;
  CHECK_FALSE(RayCaster(scene).cast({{0, 0, 0}, {1, 0, 0}}).has_value());
}

TEST_CASE("terrain gives each of its cells the state it was told") {
  const FieldLayout layout{{0.0, 0.0}, 1.0, 3, 3};
  const auto field = std::make_shared<HeightField>(layout, [](const Eigen::Vector2d&) { return 0.0; });
  Scene scene;
  scene.add(Terrain{field, std::make_shared<CellStates>(CellStates{0, 1, 2, 3})});
  const RayCaster world(scene);
  const auto state_at = [&](double x, double y) { return world.cast({{x, y, 5.0}, {0, 0, -1}})->state; };
  CHECK(state_at(0.5, 0.5) == 0);
  CHECK(state_at(1.5, 0.5) == 1);
  CHECK(state_at(0.5, 1.5) == 2);
  CHECK(state_at(1.5, 1.5) == 3);
}
