#include "core/output_frame.hpp"

#include <doctest/doctest.h>

#include <numbers>

#include "core/error.hpp"

namespace raywatch {
namespace {

TEST_CASE("places go out in the site's coordinates, or in the mine's grid, and come back") {
  OutputFrame frame{.origin_m = {1000.0, 2000.0, 300.0}};
  const Eigen::Vector3d local_m(10.0, 0.0, 5.0);
  CHECK(frame.output_from_local(local_m).isApprox(Eigen::Vector3d(1010.0, 2000.0, 305.0)));
  // A quarter turn counter-clockwise: what lies east of the grid's origin lies north in the grid.
  frame.grid = MineGrid{.site_origin_m = {1000.0, 2000.0, 300.0},
                        .grid_origin_m = {50.0, 60.0, 0.0},
                        .rotation_rad = std::numbers::pi / 2.0,
                        .scale = 1.001};
  const Eigen::Vector3d out_m = frame.output_from_local(local_m);
  CHECK(out_m.isApprox(Eigen::Vector3d(50.0, 60.0 + 10.01, 5.0)));
  CHECK(frame.local_from_output(out_m).isApprox(local_m));
}

TEST_CASE("a mine grid that is none is refused with the member that is wrong") {
  try {
    check_grid({.rotation_rad = std::nan(""), .scale = 1000.0});
    FAIL("should have been refused");
  } catch (const InvalidInput& error) {
    REQUIRE(error.fields().size() == 2);
    CHECK(error.fields()[0].field == "rotation_deg");
    CHECK(error.fields()[1].field == "scale");
  }
  CHECK_NOTHROW(check_grid({}));
}

}  // namespace
}  // namespace raywatch
