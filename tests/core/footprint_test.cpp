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

}  // namespace
}  // namespace raywatch
