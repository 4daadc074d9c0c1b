#include "tests/simulator/pit.hpp"

#include <doctest/doctest.h>

#include <numeric>

using namespace raywatch::simulator;

namespace {

using Field = std::shared_ptr<const HeightField>;

const FieldLayout kLayout{{0.0, 0.0}, 1.0, 11, 11};

template <class Height>
Field field(const Height& height_m) {
  return std::make_shared<HeightField>(kLayout, height_m);
}

double flat(const Eigen::Vector2d&) { return 0.0; }
/// A block 2 m high over the cells 3..6 of both axes, with one cell of slope around it.
double block(const Eigen::Vector2d& p) { return (p.array() >= 3.0).all() && (p.array() <= 7.0).all() ? 2.0 : 0.0; }
/// A rise too small to be called a change.
double bump(const Eigen::Vector2d& p) { return 0.1 * block(p) / 2.0; }

std::size_t cell(std::size_t column, std::size_t row) { return row * 10 + column; }

}  // namespace

TEST_CASE("ground that is removed has a state where it was, and none where it is uncovered") {
  const GroundTruth truth = compare_nights({field(block), field(flat)}, 5);
  REQUIRE(truth.states.size() == 1);
  CHECK(truth.states[0].nights == 1);
  CHECK((*truth.cells[0])[cell(4, 4)] == 5);
  CHECK((*truth.cells[1])[cell(4, 4)] == kBackground);
  CHECK((*truth.cells[0])[cell(0, 0)] == kBackground);
  // The slope around the block touches the level of the other night: nothing clear can be said there.
  CHECK((*truth.cells[0])[cell(2, 4)] == kNoSurface);
  CHECK(truth.states[0].volume_m3 == doctest::Approx(4.0 * 4.0 * 2.0));
  CHECK(truth.states[0].box.min() == Eigen::Vector3d(3.0, 3.0, 0.0));
  CHECK(truth.states[0].box.max() == Eigen::Vector3d(7.0, 7.0, 2.0));
}

TEST_CASE("a pile has a state in the nights in which it lies, and what it buries stays what it was") {
  const GroundTruth truth = compare_nights({field(flat), field(block), field(block), field(flat)}, 1);
  REQUIRE(truth.states.size() == 1);
  CHECK(truth.states[0].nights == 0b0110);
  CHECK((*truth.cells[0])[cell(4, 4)] == kBackground);
  CHECK((*truth.cells[1])[cell(4, 4)] == 1);
  CHECK((*truth.cells[2])[cell(4, 4)] == 1);
  CHECK((*truth.cells[3])[cell(4, 4)] == kBackground);
  CHECK(truth.states[0].volume_m3 == doctest::Approx(32.0));
}

TEST_CASE("ground that moves a little is neither changed nor unchanged") {
  const GroundTruth truth = compare_nights({field(bump), field(flat)}, 1);
  CHECK(truth.states.empty());
  CHECK((*truth.cells[0])[cell(4, 4)] == kNoSurface);
  CHECK((*truth.cells[1])[cell(4, 4)] == kBackground);
}

TEST_CASE("a blast cuts its bench and throws a pile, which the next nights dig away") {
  const Pit pit(3);
  std::vector<Field> nights;
  for (std::uint32_t night = 0; night < 4; ++night) nights.push_back(std::make_shared<HeightField>(pit.ground(night)));
  const VolumeChange blast = volume_change(*nights[0], *nights[1]);
  CHECK(blast.cut_m3 > 500.0);
  CHECK(blast.cut_m3 < 26.0 * 8.0 * 13.0);
  CHECK(blast.filled_m3 > 800.0);
  // After the blast of the second night, the first section is lower than its pile was, and nowhere higher.
  const GroundTruth truth = compare_nights(nights, 1);
  CHECK(truth.cells.size() == 4);
  CHECK(truth.states.size() >= 4);
  for (const GroundState& state : truth.states) {
    CHECK(state.volume_m3 > 0.0);
    CHECK(state.nights != 0b1111);
    CHECK(state.nights != 0);
  }
}
