#include <doctest/doctest.h>

#include "core/error.hpp"
#include "tests/formats/sample_files.hpp"

using namespace raywatch;
using namespace raywatch::test;

TEST_CASE("text is separated by blanks, tabs, commas or semicolons") {
  for (const std::string file : {"1 2 3\n4 5 6\n", "1\t2\t3\r\n4\t5\t6\r\n", "1,2,3\n4,5,6", " 1 ; 2 ; 3\n4;5;6\n\n",
                                 "# comment\n// comment\n\n  1   2 3\n+4 5e0 6.0"}) {
    CAPTURE(file);
    const PointCloud cloud = decode(file, "scan.xyz")[0].points;
    REQUIRE(cloud.size() == 2);
    CHECK(cloud[0] == Eigen::Vector3f(1, 2, 3));
    CHECK(cloud[1] == Eigen::Vector3f(4, 5, 6));
    CHECK(cloud.intensity.empty());
  }
}

TEST_CASE("a header line names the columns, in any order and case, and others are skipped") {
  const PointCloud cloud = decode(
                               "\xEF\xBB\xBF"
                               "class,Z,INTENSITY,y,X,cluster\nadded,3,0.5,2,1,\nfree,6,0.25,5,4,7\n",
                               "scan.csv")[0]
                               .points;
  REQUIRE(cloud.size() == 2);
  CHECK(cloud[0] == Eigen::Vector3f(1, 2, 3));
  CHECK(cloud.intensity == std::vector<float>{0.5F, 0.25F});
}

TEST_CASE("without a header a fourth and last column is the intensity") {
  CHECK(decode("1 2 3 9\n", "scan.txt")[0].points.intensity == std::vector<float>{9});
  CHECK(decode("1 2 3 255 0 0\n", "scan.txt")[0].points.intensity.empty());
}

TEST_CASE("text coordinates are read in double before they are moved") {
  const ScanHints hints{.frame = Frame::world, .pose = Pose{.position_m = {4'500'000, 5'400'000, 0}}};
  const PointCloud cloud = decode("4500000.001 5400000.002 0.003\n", "scan.xyz", hints)[0].points;
  CHECK(cloud.x_m[0] == doctest::Approx(0.001).epsilon(1e-5));
  CHECK(cloud.y_m[0] == doctest::Approx(0.002).epsilon(1e-5));
}

TEST_CASE("a bad line of text is refused with its number") {
  const auto message = [](const std::string& file) { return refusal<InvalidInput>(file, "scan.csv"); };
  CHECK(contains(message("1,2,3\n4,5\n"), "line 2: 2 columns instead of 3"));
  CHECK(contains(message("# c\n1,2,3\n4,5,six\n"), "line 3: 'six' is not a number"));
  CHECK(contains(message("1,2,3\n4,,6\n"), "line 2: '' is not a number"));
  CHECK(contains(message("1 2\n"), "line 1: 2 columns instead of at least 3"));
  CHECK(contains(message("a,b,c\n1,2,3\n"), "line 1: 'a' is not a number"));
  CHECK(contains(message("x,y,z\n"), "no points"));
  CHECK(contains(message("1 2 1e999\n"), "'1e999' is out of range"));
  CHECK(contains(message("1 2 1e39\n"), "point 0"));
}

TEST_CASE("a decimal comma is an error and not a separator") {
  CHECK(contains(refusal<InvalidInput>("1,5;2,5;3,5\n", "scan.csv"), "'1,5' is not a number"));
}

TEST_CASE("text with more points than the limit is too large") {
  CHECK(contains(refusal<TooLarge>("1 2 3\n4 5 6\n", "scan.xyz", {}, {.max_points = 1}), "more than 1 points"));
}
