// The directions that a scan's own rig hides.

#include "core/own_returns.hpp"

#include <doctest/doctest.h>
#include <rapidcheck.h>

#include <numbers>

namespace raywatch {
namespace {

constexpr double kDegree_rad = std::numbers::pi / 180.0;
constexpr UsableRange kUsable{.min_m = 0.75};

Eigen::Vector3d direction(double azimuth_deg, double elevation_deg) {
  const double a = kDegree_rad * azimuth_deg, e = kDegree_rad * elevation_deg;
  return {std::cos(e) * std::cos(a), std::cos(e) * std::sin(a), std::sin(e)};
}

PointCloud one_return(double azimuth_deg, double elevation_deg, double range_m) {
  const Eigen::Vector3f p = (range_m * direction(azimuth_deg, elevation_deg)).cast<float>();
  PointCloud cloud;
  cloud.push_back(p.x(), p.y(), p.z());
  return cloud;
}

Eigen::Vector2d around(double degrees) { return Eigen::Vector2d::Constant(kDegree_rad * degrees); }

TEST_CASE("only returns nearer than the least range are of the rig, and none at the sensor itself") {
  for (const double range_m : {0.1, 0.7}) {
    CHECK(OwnReturns(one_return(10.0, 5.0, range_m), kUsable).hide(direction(10.0, 5.0), around(0.1)));
  }
  for (const double range_m : {0.0, 0.8, 20.0}) {
    CHECK_FALSE(OwnReturns(one_return(10.0, 5.0, range_m), kUsable).hide(direction(10.0, 5.0), around(5.0)));
  }
  CHECK_FALSE(OwnReturns(one_return(10.0, 5.0, 0.4), {}).hide(direction(10.0, 5.0), around(5.0)));
}

TEST_CASE("the seam of the azimuth is no border") {
  const OwnReturns own(one_return(179.9, 0.0, 0.4), kUsable);
  CHECK(own.hide(direction(-179.0, 0.0), around(2.0)));
  CHECK_FALSE(own.hide(direction(-175.0, 0.0), around(2.0)));
}

TEST_CASE("all that is within the angle hides, and what is a cell farther away does not") {
  CHECK(rc::check([] {
    const double azimuth = 0.1 * *rc::gen::inRange(-1800, 1800), elevation = 0.1 * *rc::gen::inRange(-600, 600);
    const double wide = 0.1 * *rc::gen::inRange(1, 50);
    const double aside = 0.01 * *rc::gen::inRange(-1000, 1000);
    const OwnReturns own(one_return(azimuth, elevation, 0.5), kUsable);
    constexpr double kCell_deg = 0.25;
    const bool above = own.hide(direction(azimuth, elevation + aside), around(wide));
    if (std::abs(aside) < wide - 0.01) RC_ASSERT(above);
    if (std::abs(aside) > wide + kCell_deg + 0.01) RC_ASSERT(!above);
    const double flat = std::cos(kDegree_rad * elevation);
    const bool beside = own.hide(direction(azimuth + aside / flat, elevation), around(wide));
    if (std::abs(aside) < wide - 0.01) RC_ASSERT(beside);
    if (std::abs(aside) > wide + kCell_deg + 0.01) RC_ASSERT(!beside);
  }));
}

}  // namespace
}  // namespace raywatch
