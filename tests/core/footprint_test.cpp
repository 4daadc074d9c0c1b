// What the shots right beside a point say of it where its whole cone is ambiguous.

#include "core/footprint.hpp"

#include <doctest/doctest.h>

#include "core/prior_index_impl.hpp"
#include "tests/core/shots.hpp"

namespace raywatch {
namespace {

Answer answer_at(const Taken& asked, double column, double row, double range_m) {
  PointCloud points;
  push_shot(points, column, row, range_m);
  std::vector<Answer> answers{Answer::ambiguous};
  ask_footprints(asked.view(), points, Pose{}, 0.1, answers);
  return answers.front();
}

/// A wall at 10 m with a post at 4 m in the third column from the middle.
Taken wall_behind_post() {
  return Taken(shoot([](int column, int) { return column == 3 ? 4.0 : 10.0; }));
}

TEST_CASE("a point before a far wall is free although a post stands within its cone") {
  CHECK(answer_at(wall_behind_post(), 0.5, 0.5, 6.0) == Answer::free);
  CHECK(answer_at(wall_behind_post(), 1.4, 0.3, 6.0) == Answer::free);
}

TEST_CASE("a point beside a nearer return, or at the range of those beside it, stays ambiguous") {
  CHECK(answer_at(wall_behind_post(), 2.5, 0.5, 6.0) == Answer::ambiguous);
  CHECK(answer_at(wall_behind_post(), 0.5, 0.5, 9.95) == Answer::ambiguous);
}

TEST_CASE("a point on a slanted surface stays ambiguous, as some of the shots beside it are nearer") {
  const Taken slanted(shoot([](int, int row) { return 10.0 + 0.5 * row; }));
  for (double row = -2.0; row < 2.0; row += 0.25) {
    CHECK(answer_at(slanted, 0.5, row, 10.0 + 0.5 * row) == Answer::ambiguous);
  }
}

TEST_CASE("outside of what a scan saw nothing is decided") {
  CHECK(answer_at(wall_behind_post(), 25.0, 0.0, 6.0) == Answer::ambiguous);
  CHECK(answer_at(wall_behind_post(), 20.5, 0.0, 6.0) == Answer::ambiguous);
}

TEST_CASE("only what is ambiguous is decided") {
  PointCloud points;
  push_shot(points, 0.5, 0.5, 6.0);
  for (const Answer before : {Answer::unseen, Answer::free, Answer::supported, Answer::occluded}) {
    std::vector<Answer> answers{before};
    ask_footprints(wall_behind_post().view(), points, Pose{}, 0.1, answers);
    CHECK(answers.front() == before);
  }
}

/// What is left of "free" at a place of a scan whose own rig, if any, stands in the given columns.
Answer kept_at(double column, double row, double noise_m, int rig_from = 99, int rig_to = -99) {
  const PointCloud cloud = shoot([=](int c, int) { return c >= rig_from && c <= rig_to ? 0.4 : 10.0; });
  Taken asked(cloud);
  asked.index = PriorIndex::build(cloud, {.min_m = 0.75});
  PointCloud points;
  push_shot(points, column, row, 2.0);
  std::vector<Answer> answers{Answer::free};
  withhold_at_borders(asked.view(), points, Pose{}, noise_m, answers);
  return answers.front();
}

TEST_CASE("below the lowest and beside the last shots of a scan nothing is free, and well inside it stays free") {
  CHECK(kept_at(0.3, -19.7, 0.0) == Answer::free);
  CHECK(kept_at(0.3, -20.2, 0.0) == Answer::unseen);
  CHECK(kept_at(20.2, 0.3, 0.0) == Answer::unseen);
  CHECK(kept_at(19.6, 0.3, 0.0) == Answer::free);
}

TEST_CASE("beside what the rig hides nothing is free, as far as noise may have moved a point") {
  CHECK(kept_at(6.0, 0.0, 0.0, -1, 1) == Answer::free);
  CHECK(kept_at(2.5, 0.0, 0.0, -1, 1) == Answer::unseen);
  CHECK(kept_at(6.0, 0.0, 0.05, -1, 1) == Answer::unseen);  // 5 cm at 2 m: 2.5 of them are 3.6 degrees
  CHECK(kept_at(12.0, 0.0, 0.05, -1, 1) == Answer::free);
}

TEST_CASE("only what is free is withheld") {
  for (const Answer before : {Answer::supported, Answer::occluded, Answer::ambiguous}) {
    PointCloud points;
    push_shot(points, 30.0, 0.0, 2.0);
    std::vector<Answer> answers{before};
    withhold_at_borders(wall_behind_post().view(), points, Pose{}, 0.0, answers);
    CHECK(answers.front() == before);
  }
}

}  // namespace
}  // namespace raywatch
