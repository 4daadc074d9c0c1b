#include <doctest/doctest.h>

#include <numbers>

#include "core/error.hpp"
#include "tests/formats/sample_files.hpp"

using namespace raywatch;
using namespace raywatch::test;

TEST_CASE("each scan of a PTX file has its own pose and its points in the sensor frame") {
  const std::string file = ptx_header(1, 2, {10, 20, 30}) + "1 2 3 0.5\n4 5 6 0.25\n" + ptx_header(2, 1, {11, 20, 30}) +
                           "7 8 9 1 10 20 30\n1 1 1 0 0 0 0\n";
  const auto scans = decode(file);
  REQUIRE(scans.size() == 2);
  CHECK(scans[0].world_from_sensor->position_m == Eigen::Vector3d(10, 20, 30));
  CHECK(scans[1].world_from_sensor->position_m == Eigen::Vector3d(11, 20, 30));
  CHECK(scans[0].points[1] == Eigen::Vector3f(4, 5, 6));
  CHECK(scans[0].points.intensity == std::vector<float>{0.5F, 0.25F});
  CHECK(scans[1].points[0] == Eigen::Vector3f(7, 8, 9));
}

TEST_CASE("a column of the PTX scanner is a row of the grid, because the file goes column by column") {
  const std::string file = ptx_header(2, 3) + "1 0 0\n2 0 0\n3 0 0\n4 0 0\n5 0 0\n6 0 0\n";
  const PointCloud cloud = decode(file)[0].points;
  REQUIRE(cloud.grid);
  CHECK(*cloud.grid == ShotGrid{.rows = 2, .columns = 3});
  CHECK(cloud.x_m[1 * 3 + 0] == 4.0F);
}

TEST_CASE("PTX cells without a return keep their place, in the world frame too") {
  const std::string file = ptx_header(1, 3, {5, 5, 5}) + "0 0 0 0\n6 5 5 1\n0 0 0 0\n";
  const PointCloud sensor = decode(file)[0].points;
  CHECK(sensor[0] == Eigen::Vector3f(0, 0, 0));
  CHECK(sensor[1] == Eigen::Vector3f(6, 5, 5));
  const PointCloud world = decode(file, "", {.frame = Frame::world})[0].points;
  CHECK(world[0] == Eigen::Vector3f(0, 0, 0));
  CHECK(world[1] == Eigen::Vector3f(1, 0, 0));
}

TEST_CASE("the rows of a PTX matrix are the scanner's axes in the world") {
  // Turned by 90 degrees to the left: the scanner's x looks along the world's y.
  const std::string file = "1\n1\n1 2 3\n0 1 0\n-1 0 0\n0 0 1\n0 1 0 0\n-1 0 0 0\n0 0 1 0\n1 2 3 1\n1 0 0 0\n";
  const Pose pose = *decode(file)[0].world_from_sensor;
  CHECK((pose * Eigen::Vector3d(1, 0, 0) - Eigen::Vector3d(1, 3, 3)).norm() < 1e-12);
}

TEST_CASE("a PTX pose that contradicts itself or is no rotation is refused") {
  const auto with_pose = [](const std::string& axes, const std::string& matrix) {
    return refusal<InvalidInput>("1\n1\n" + axes + matrix + "1 1 1 0\n");
  };
  const std::string axes = "1 2 3\n1 0 0\n0 1 0\n0 0 1\n";
  CHECK(contains(with_pose(axes, "1 0 0 0\n0 1 0 0\n0 0 1 0\n1 2 4 1\n"), "line 10: the scanner's position and axes"));
  CHECK(contains(with_pose(axes, "0 1 0 0\n-1 0 0 0\n0 0 1 0\n1 2 3 1\n"), "contradict"));
  CHECK(contains(with_pose(axes, "1 0 0 0\n0 1 0 0\n0 0 1 0\n1 2 3 2\n"), "not 0 0 0 1"));
  CHECK(contains(with_pose("0 0 0\n2 0 0\n0 1 0\n0 0 1\n", "2 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n"), "no rotation"));
  CHECK(contains(with_pose("1e12 0 0\n1 0 0\n0 1 0\n0 0 1\n", "1 0 0 0\n0 1 0 0\n0 0 1 0\n1e12 0 0 1\n"),
                 "line 10: the pose above: must have a position within 1e8 m"));
  CHECK(contains(with_pose("0 0 0\n-1 0 0\n0 1 0\n0 0 1\n", "-1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n"), "no rotation"));
}

TEST_CASE("one pose cannot stand for several scans of a PTX file") {
  const std::string scan = ptx_header(1, 1) + "1 2 3 0\n";
  const ScanHints hints{.pose = Pose{.position_m = {1, 1, 1}}};
  CHECK(decode(scan, "", hints)[0].world_from_sensor->position_m == Eigen::Vector3d(1, 1, 1));
  CHECK(contains(refusal<InvalidInput>(scan + scan, "", hints), "2 scans"));
}

TEST_CASE("a broken PTX file is refused with the line") {
  const auto message = [](const std::string& file) { return refusal<InvalidInput>(file, "scan.ptx"); };
  CHECK(contains(message(ptx_header(1, 2) + "1 2 3 0\n4 5 6\n"), "line 12: a point has 3, 4 or 7 values"));
  CHECK(contains(message(ptx_header(1, 2) + "1 2 3 0\n4 5 x 0\n"), "line 12: 'x' is not a number"));
  CHECK(contains(message(ptx_header(1, 3) + "1 2 3 0\n4 5 6 0\n"), "promises 3 points"));
  CHECK(contains(message("1\n2\n0 0 0\n"), "the PTX file ends where position and axes"));
  CHECK(contains(message("1\n2 3\n"), "line 2: the number of rows needs 1 values"));
  CHECK(contains(message(ptx_header(1, 1) + "1 2 3 0\n4 5 6 0\n"), "line 12: the number of columns of the next scan"));
  CHECK(contains(message("\n\n"), "no scan"));
}
