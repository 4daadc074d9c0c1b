#include "core/zone.hpp"

#include <doctest/doctest.h>
#include <rapidcheck.h>

#include <numbers>

#include "core/error.hpp"
#include "core/look.hpp"
#include "tests/core/watch_scene.hpp"

namespace raywatch {
namespace {

using Polygon = std::vector<Eigen::Vector2d>;

Prism prism(Polygon polygon_m) { return {std::move(polygon_m), 0.0, 2.0}; }

/// Three quarters of a square of 4 m: the quarter at (3, 3) is missing.
const Polygon kCorner{{0, 0}, {4, 0}, {4, 2}, {2, 2}, {2, 4}, {0, 4}};

TEST_CASE("a place lies in a prism when it lies between its sides and its heights") {
  const Prism zone = prism(kCorner);
  CHECK(contains(zone, {1.0, 3.0, 1.0}));
  CHECK(contains(zone, {3.0, 1.0, 0.0}));
  CHECK(contains(zone, {3.0, 1.0, 2.0}));
  CHECK_FALSE(contains(zone, {3.0, 3.0, 1.0}));
  CHECK_FALSE(contains(zone, {1.0, 1.0, 2.01}));
  CHECK_FALSE(contains(zone, {-0.01, 1.0, 1.0}));
}

TEST_CASE("the direction in which the corners are given, and the one that comes first, do not matter") {
  CHECK(rc::check([] {
    const Eigen::Vector3d place_m(*rc::gen::inRange(-500, 500) / 100.0, *rc::gen::inRange(-500, 500) / 100.0, 1.0);
    Polygon turned = kCorner;
    std::rotate(turned.begin(), turned.begin() + *rc::gen::inRange(0, 6), turned.end());
    const bool inside = contains(prism(kCorner), place_m);
    RC_ASSERT(contains(prism(turned), place_m) == inside);
    std::reverse(turned.begin(), turned.end());
    RC_ASSERT(contains(prism(turned), place_m) == inside);
  }));
}

TEST_CASE("of two prisms that share a side, each place belongs to exactly one") {
  const Prism left = prism({{0, 0}, {1, 0}, {1.3, 1}, {0, 1}}), right = prism({{1, 0}, {2, 0}, {2, 1}, {1.3, 1}});
  CHECK(rc::check([&] {
    const double along = *rc::gen::inRange(1, 1000) / 1000.0;
    const Eigen::Vector3d on_the_side_m(1.0 + 0.3 * along, along, 1.0);
    RC_ASSERT(contains(left, on_the_side_m) != contains(right, on_the_side_m));
  }));
}

TEST_CASE("what is no shape is refused, with what is wrong") {
  const auto complaint = [](const Prism& zone) {
    try {
      check_prism(zone);
    } catch (const InvalidInput& error) {
      return error.fields().front().field;
    }
    return std::string("none");
  };
  CHECK(complaint(prism(kCorner)) == "none");
  CHECK(complaint(prism({{0, 0}, {1, 0}})) == "polygon_m");
  CHECK(complaint(prism({{0, 0}, {1, 0}, {2, 0}})) == "polygon_m");
  CHECK(complaint(prism({{0, 0}, {2, 2}, {2, 0}, {0, 2}})) == "polygon_m");
  CHECK(complaint(prism({{0, 0}, {1, 0}, {std::nan(""), 1}})) == "polygon_m");
  CHECK(complaint({kCorner, 2.0, 2.0}) == "z_max_m");
}

TEST_CASE("a shape that crosses itself, or is closed twice, is told how corners are given") {
  const auto complaint = [](Polygon polygon_m) {
    try {
      check_prism(prism(std::move(polygon_m)));
    } catch (const InvalidInput& error) {
      return error.fields().front().message;
    }
    return std::string("none");
  };
  // Both triangles of this one are equally large, and turn against each other.
  CHECK(complaint({{0, 0}, {6, 4}, {6, 0}, {0, 4}}).find("must not cross or touch itself") == 0);
  CHECK(complaint({{0, 0}, {6, 0}, {6, 4}, {0, 4}, {0, 0}}).find("must not repeat the first corner") == 0);
  CHECK(complaint({{0, 0}, {1, 0}, {2, 0}}) == "must enclose an area");
  CHECK(complaint({{0, 0}, {6, 0}, {6, 4}, {0, 4}}) == "none");
}

TEST_CASE("the share of a box in a prism is that of its volume") {
  const Prism half = prism({{0, -5}, {5, -5}, {5, 5}, {0, 5}});
  const OrientedBox box{{0.0, 0.0, 1.0}, {2.0, 1.0, 1.0}, Eigen::Quaterniond::Identity()};
  // The middle one of five slices lies on the border; it counts as inside or not, as a whole.
  CHECK(share_inside(half, box) == doctest::Approx(0.5).epsilon(0.21));
  OrientedBox turned = box;
  turned.world_from_box = Eigen::AngleAxisd(std::numbers::pi / 2, Eigen::Vector3d::UnitZ());
  turned.center_m.x() = 0.7;
  CHECK(share_inside(half, turned) == 1.0);
}

TEST_CASE("the places of a lattice lie in the prism, are as many as asked for, and fill it") {
  for (const std::size_t count : {30u, 500u}) {
    const auto places = lattice_places(prism(kCorner), count);
    CHECK(static_cast<double>(places.size()) == doctest::Approx(static_cast<double>(count)).epsilon(0.5));
    for (const Eigen::Vector3d& place_m : places) CHECK(contains(prism(kCorner), place_m));
  }
}

TEST_CASE("also a long and narrow prism has places, and one that is all but flat costs no more than others") {
  const Prism corridor = prism({{0, 0}, {300, 300}, {299, 301}, {-1, 1}});
  CHECK(lattice_places(corridor, 500).size() > 50);
  CHECK_FALSE(lattice_places(prism(kCorner), 1).empty());
  CHECK(lattice_places(prism({{0, 0}, {1000, 1000}, {1000, 1000.00001}}), 500).size() < 500);
}

TEST_CASE("of a zone before the wall all is judged, of one behind it nothing, and of one across it the half") {
  const WatchedScan scan = look_at_wall(false);
  const CompareParameters parameters = watch_parameters();
  const auto share = [&](double from_x_m, double to_x_m) {
    const Prism zone{{{from_x_m, -1}, {to_x_m, -1}, {to_x_m, 1}, {from_x_m, 1}}, -1.0, 1.0};
    return judged_share(scan.view(), lattice_places(zone, 500), parameters);
  };
  CHECK(share(4.0, 8.0) == 1.0);
  CHECK(share(12.0, 16.0) == 0.0);
  CHECK(share(8.0, 12.0) == doctest::Approx(0.5).epsilon(0.15));
  CHECK(judged_share(scan.view(), {}, parameters) == 0.0);
}

TEST_CASE("behind a thing nothing is judged, and before it all") {
  const WatchedScan scan = look_at_wall(true);
  const std::vector<Eigen::Vector3d> places{{4.0, 0, 0}, {4.5, 0, 0}, {7.0, 0, 0}, {7.0, 2.0, 0}};
  CHECK(look_at(scan.view(), places, watch_parameters()) ==
        std::vector{Answer::free, Answer::supported, Answer::occluded, Answer::free});
}

}  // namespace
}  // namespace raywatch
