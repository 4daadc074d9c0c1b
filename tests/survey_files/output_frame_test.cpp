#include "core/output_frame.hpp"

#include <doctest/doctest.h>

#include <rapidcheck.h>
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

TEST_CASE("a grid that two known places determine leads from the one to the other") {
  // From A to B are 500 m due east at the site, and (400, 300) times the scale in the grid: 3-4-5, so that the site's
  // axes are turned by atan2(3, 4).
  const OutputFrame frame{.origin_m = {4900.0, 8800.0, 250.0},
                          .grid = MineGrid{.site_origin_m = {5000.0, 9000.0, 310.0},
                                           .grid_origin_m = {10000.0, 20000.0, 1310.0},
                                           .rotation_rad = std::atan2(3.0, 4.0),
                                           .scale = 0.9996}};
  const Eigen::Vector3d a_local_m(100.0, 200.0, 60.0), b_local_m(600.0, 200.0, 75.0);
  CHECK((frame.output_from_local(a_local_m) - Eigen::Vector3d(10000.0, 20000.0, 1310.0)).norm() < 1e-9);
  CHECK((frame.output_from_local(b_local_m) - Eigen::Vector3d(10399.84, 20299.88, 1325.0)).norm() < 1e-9);
}

OutputFrame any_frame() {
  const auto metres = [](int most_km) { return 1e-3 * *rc::gen::inRange(-1'000'000 * most_km, 1'000'000 * most_km); };
  const auto place_m = [&] { return Eigen::Vector3d(metres(400), metres(400), metres(3)); };
  return {.origin_m = place_m(),
          .grid = MineGrid{.site_origin_m = place_m(),
                           .grid_origin_m = place_m(),
                           .rotation_rad = 1e-6 * *rc::gen::inRange(-6'283'185, 6'283'185),
                           .scale = 1.0 + 1e-6 * *rc::gen::inRange(-100'000, 100'000)}};
}

TEST_CASE("any grid leads there and back, keeps angles and heights, and stretches lengths by its scale") {
  CHECK(rc::check("there and back", [] {
    const OutputFrame frame = any_frame();
    const auto local_m = [] {
      const auto metres = [] { return 1e-3 * *rc::gen::inRange(-2'000'000, 2'000'000); };
      return Eigen::Vector3d(metres(), metres(), metres());
    };
    const Eigen::Vector3d a_m = local_m(), b_m = local_m();
    const Eigen::Vector3d out_a_m = frame.output_from_local(a_m), out_b_m = frame.output_from_local(b_m);
    RC_ASSERT((frame.local_from_output(out_a_m) - a_m).norm() < 1e-7);
    const Eigen::Vector3d between_m = b_m - a_m, out_between_m = out_b_m - out_a_m;
    RC_ASSERT(std::abs(out_between_m.head<2>().norm() - frame.grid->scale * between_m.head<2>().norm()) < 1e-7);
    RC_ASSERT(std::abs(out_between_m.z() - between_m.z()) < 1e-7);
  }));
  CHECK(rc::check("the corners of cells lie where their transform leads", [] {
    const OutputFrame frame = any_frame();
    const GridLayout layout{.origin_m = {*rc::gen::inRange(-500, 500), *rc::gen::inRange(-500, 500)},
                            .cell_m = 0.5,
                            .columns = *rc::gen::inRange(1u, 300u),
                            .rows = *rc::gen::inRange(1u, 300u)};
    const double column = *rc::gen::inRange(0u, layout.columns + 1), row = *rc::gen::inRange(0u, layout.rows + 1);
    const Eigen::Vector2d local_m = layout.origin_m + layout.cell_m * Eigen::Vector2d(column, row);
    const CellTransform cells = cell_transform(layout, frame);
    const Eigen::Vector2d out_m = cells.corner_m + column * cells.a_column_m + row * cells.a_row_m;
    RC_ASSERT((out_m - frame.output_from_local({local_m.x(), local_m.y(), 0.0}).head<2>()).norm() < 1e-7);
  }));
}

TEST_CASE("a mine grid that is none is refused with the member that is wrong") {
  try {
    check_grid({.grid_origin_m = {0.0, 1e99, 0.0}, .rotation_rad = std::nan(""), .scale = 1000.0});
    FAIL("should have been refused");
  } catch (const InvalidInput& error) {
    REQUIRE(error.fields().size() == 3);
    CHECK(error.fields()[0].field == "grid_origin_m");
    CHECK(error.fields()[1].field == "rotation_deg");
    CHECK(error.fields()[2].field == "scale");
  }
  CHECK_NOTHROW(check_grid({}));
}

}  // namespace
}  // namespace raywatch
