#include "core/volume.hpp"

#include <doctest/doctest.h>

#include "core/error.hpp"

namespace raywatch {
namespace {

/// Ten by ten cells of 1 m, all seen at one height, from one station far above their middle.
ElevationModel flat(double height_m, double sigma_m = 0.0, PoseUncertainty uncertainty = {}) {
  ElevationModel model{.layout = {.cell_m = 1.0, .columns = 10, .rows = 10}};
  model.cells.assign(100, {.height_m = height_m, .sigma_m = sigma_m, .count = 10, .ceiling_m = height_m + 0.1});
  model.stations.push_back({{5.0, 5.0, 50.0}, uncertainty, std::vector<float>(100, 1.0f)});
  return model;
}

Prism box_zone(double from_m, double to_m) {
  return {{{from_m, from_m}, {to_m, from_m}, {to_m, to_m}, {from_m, to_m}}, -10.0, 10.0};
}

void hide(ElevationModel& model, std::size_t cell, double ceiling_m) {
  model.cells[cell] = {};
  model.cells[cell].ceiling_m = ceiling_m;
}

TEST_CASE("cut and fill are the prisms between the surfaces, and net is fill minus cut") {
  const ElevationModel before = flat(0.0);
  ElevationModel after = flat(0.0);
  for (std::size_t i = 0; i < 20; ++i) after.cells[i].height_m = 1.5;
  for (std::size_t i = 60; i < 70; ++i) after.cells[i].height_m = -2.0;
  const ZoneVolumes volumes = volumes_between(before, after, box_zone(0.0, 10.0));
  CHECK(volumes.fill.value_m3 == doctest::Approx(30.0));
  CHECK(volumes.cut.value_m3 == doctest::Approx(20.0));
  CHECK(volumes.net.value_m3 == doctest::Approx(10.0));
  CHECK(volumes.changed_net.value_m3 == doctest::Approx(10.0));
  CHECK(volumes.changed_area_m2 == doctest::Approx(30.0));
  CHECK(volumes.vertical.greatest_rise_m == 1.5);
  CHECK(volumes.vertical.greatest_fall_m == -2.0);
  CHECK(volumes.vertical.mean_m == doctest::Approx(10.0 / 30.0));
  CHECK(volumes.seen_share() == 1.0);
  CHECK(volumes.net.sigma_m3() == 0.0);
}

TEST_CASE("only what lies in the prism counts: parts of cells, and heights between its ends") {
  const ElevationModel before = flat(0.0), after = flat(4.0);
  CHECK(volumes_between(before, after, box_zone(2.5, 7.5)).net.value_m3 == doctest::Approx(100.0));
  Prism low = box_zone(0.0, 10.0);
  low.z_max_m = 1.0;
  CHECK(volumes_between(before, after, low).net.value_m3 == doctest::Approx(100.0));
  low.z_min_m = 0.5;
  CHECK(volumes_between(before, after, low).fill.value_m3 == doctest::Approx(50.0));
}

TEST_CASE("random errors add as squares, those of a pose by their sum over all cells") {
  const PoseUncertainty uncertainty{.position_m = 0.01, .angle_rad = 1e-3};
  const ElevationModel before = flat(0.0, 0.02, uncertainty), after = flat(1.0, 0.02);
  const VolumeFigure net = volumes_between(before, after, box_zone(0.0, 10.0)).net;
  CHECK(net.value_m3 == doctest::Approx(100.0));
  CHECK(net.random_sigma_m3 == doctest::Approx(std::sqrt(200.0) * 0.02));
  // Level ground under the station: a translation counts only upwards, a tilt cancels over the symmetrical area.
  CHECK(net.pose_sigma_m3 == doctest::Approx(100.0 * 0.01));
  CHECK(net.high_m3() - net.low_m3() == doctest::Approx(2.0 * 1.96 * std::hypot(1.0, std::sqrt(200.0) * 0.02)));
  // Of the right half (columns 5..9) the middle is 2.5 m from the station: a tilt about y counts with that arm.
  Prism right = box_zone(0.0, 10.0);
  right.polygon_m = {{5, 0}, {10, 0}, {10, 10}, {5, 10}};
  CHECK(volumes_between(before, after, right).net.pose_sigma_m3 ==
        doctest::Approx(50.0 * std::hypot(0.01, 2.5 * 1e-3)));
}

TEST_CASE("a change below the level of detection is no cut or fill, but counts for the net") {
  const ElevationModel before = flat(0.0, 0.02), after = flat(0.05, 0.02);
  const ZoneVolumes volumes = volumes_between(before, after, box_zone(0.0, 10.0));
  CHECK(volumes.fill.value_m3 == 0.0);
  CHECK(volumes.changed_area_m2 == 0.0);
  CHECK(volumes.net.value_m3 == doctest::Approx(5.0));
}

TEST_CASE("a cell beside a change counts by the sign of the change, not by that of its own noise") {
  const ElevationModel before = flat(0.0, 0.02);
  ElevationModel after = flat(0.0, 0.02);
  for (std::size_t row = 0; row < 10; ++row) {
    after.cells[10 * row].height_m = -1.0;      // fell
    after.cells[10 * row + 1].height_m = 0.02;  // beside it: noise upwards
    after.cells[10 * row + 9].height_m = 1.0;   // rose
  }
  const ZoneVolumes volumes = volumes_between(before, after, box_zone(0.0, 10.0));
  CHECK(volumes.cut.value_m3 == doctest::Approx(10.0 - 0.2));
  CHECK(volumes.fill.value_m3 == doctest::Approx(10.0));
}

TEST_CASE("what unchanged ground shows of the errors of the poses is taken out of cut and fill, and left in the net") {
  // The later pose is 2 cm too high and tilted: everything seems to have risen, and the ground beside a fall, too.
  const PoseUncertainty uncertainty{.position_m = 0.02, .angle_rad = 1e-3};
  const ElevationModel before = flat(0.0, 0.003, uncertainty);
  ElevationModel after = flat(0.0, 0.003, uncertainty);
  for (std::size_t cell = 0; cell < 100; ++cell) {
    after.cells[cell].height_m = 0.02 + 1e-3 * (after.layout.center_m(cell).x() - 5.0);
    if (cell % 10 == 4) after.cells[cell].height_m -= 3.0;
  }
  const ZoneVolumes volumes = volumes_between(before, after, box_zone(0.0, 10.0));
  CHECK(volumes.cut.value_m3 == doctest::Approx(30.0).epsilon(2e-3));
  CHECK(std::abs(volumes.fill.value_m3) < 0.02);
  CHECK(volumes.cut.pose_sigma_m3 < 0.05);
  CHECK(std::abs(volumes.cut.value_m3 - 30.0) < 1.96 * volumes.cut.sigma_m3());
  CHECK(volumes.net.value_m3 == doctest::Approx(2.0 - 30.0));
  CHECK(volumes.net.pose_sigma_m3 > 100.0 * 0.02);
}

TEST_CASE("poses that are taken as exact explain nothing") {
  const ElevationModel before = flat(0.0, 0.02);
  ElevationModel after = flat(0.01, 0.02);
  for (std::size_t i = 0; i < 10; ++i) after.cells[i].height_m = -2.0;
  const ZoneVolumes volumes = volumes_between(before, after, box_zone(0.0, 10.0));
  CHECK(volumes.cut.value_m3 == doctest::Approx(20.0 - 0.1));
  CHECK(volumes.cut.pose_sigma_m3 == 0.0);
}

TEST_CASE("a stated greatest slope of the ground bounds what was not seen by what was seen around it") {
  ElevationModel before = flat(1.0), after = flat(1.0);
  hide(after, 44, 9.0);  // beside seen cells at 1 m
  const ZoneVolumes volumes = volumes_between(before, after, box_zone(0.0, 10.0), {.greatest_slope = 2.0});
  CHECK(volumes.unseen.low_m3 == doctest::Approx(-2.0));
  CHECK(volumes.unseen.high_m3 == doctest::Approx(2.0));
  // Two cells away from anything seen: twice as much, but never beyond what the rays show.
  for (const std::size_t cell : {33, 34, 35, 43, 45, 53, 54, 55}) hide(after, cell, 2.5);
  const std::vector<HeightBounds> bounds = ground_bounds(after, box_zone(0.0, 10.0), {.greatest_slope = 2.0});
  CHECK(bounds[44].low_m == doctest::Approx(1.0 - 4.0));
  CHECK(bounds[44].high_m == doctest::Approx(2.5 + 2.0));
  CHECK(bounds[43].low_m == doctest::Approx(1.0 - 2.0));
  CHECK(bounds[43].high_m == doctest::Approx(2.5));
  CHECK_THROWS_AS(ground_bounds(after, box_zone(0.0, 10.0), {.greatest_slope = 0.0}), InvalidInput);
}

TEST_CASE("the bounds of a seen cell have the errors of the poses in them") {
  const ElevationModel model = flat(1.0, 0.03, {.position_m = 0.04, .angle_rad = 0.0});
  const HeightBounds bounds = ground_bounds(model, box_zone(0.0, 10.0), {})[0];
  CHECK(bounds.high_m - bounds.low_m == doctest::Approx(2.0 * 1.96 * 0.05));
}

TEST_CASE("what was not seen is bounded by the rays above and by the zone below, and never guessed") {
  ElevationModel before = flat(1.0), after = flat(1.0);
  hide(before, 0, 3.0);                                     // seen afterwards at 1 m
  hide(after, 1, 2.0);                                      // was at 1 m
  hide(after, 2, std::numeric_limits<double>::infinity());  // no ray at all: up to the zone's top
  const ZoneVolumes volumes = volumes_between(before, after, box_zone(0.0, 10.0));
  CHECK(volumes.net.value_m3 == 0.0);
  CHECK(volumes.seen_area_m2 == doctest::Approx(97.0));
  CHECK(volumes.unseen.low_m3 == doctest::Approx((1.0 - 3.0) + (-10.0 - 1.0) + (-10.0 - 1.0)));
  CHECK(volumes.unseen.high_m3 == doctest::Approx((1.0 + 10.0) + (2.0 - 1.0) + (10.0 - 1.0)));
  CHECK(volumes.whole().low_m3 == doctest::Approx(volumes.unseen.low_m3));
}

TEST_CASE("along the normal of a slope a change is shorter than along the vertical") {
  ElevationModel before = flat(0.0), after = flat(2.0);
  for (ElevationCell& cell : before.cells) cell.slope = {1.0, 0.0};
  const ZoneVolumes volumes = volumes_between(before, after, box_zone(0.0, 10.0));
  CHECK(volumes.vertical.greatest_rise_m == 2.0);
  CHECK(volumes.normal.greatest_rise_m == doctest::Approx(std::sqrt(2.0)));
}

TEST_CASE("the volume over a footprint is that of its seen cells, and says how many they are") {
  const ElevationModel before = flat(0.0, 0.01), after = [] {
    ElevationModel model = flat(0.5, 0.01);
    hide(model, 3, 9.0);
    return model;
  }();
  const std::vector<std::size_t> cells{1, 2, 3, 4};
  const FootprintVolume volume = volume_over(before, after, cells);
  CHECK(volume.net.value_m3 == doctest::Approx(1.5));
  CHECK(volume.area_m2 == doctest::Approx(4.0));
  CHECK(volume.seen_area_m2 == doctest::Approx(3.0));
  CHECK(volume.net.random_sigma_m3 == doctest::Approx(std::sqrt(6.0) * 0.01));
}

TEST_CASE("masses follow from a density, and nonsense is refused") {
  const MassFigure mass = mass_of({.value_m3 = 100.0, .random_sigma_m3 = 3.0, .pose_sigma_m3 = 4.0}, 1.8);
  CHECK(mass.value_t == doctest::Approx(180.0));
  CHECK(mass.low_t == doctest::Approx(1.8 * (100.0 - 1.96 * 5.0)));
  CHECK_THROWS_AS(mass_of({}, 0.0), InvalidInput);
  ElevationModel other = flat(0.0);
  other.layout.cell_m = 2.0;
  CHECK_THROWS_AS(volumes_between(flat(0.0), other, box_zone(0.0, 10.0)), InvalidInput);
}

}  // namespace
}  // namespace raywatch
