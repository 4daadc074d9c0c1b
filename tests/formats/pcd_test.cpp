#include <doctest/doctest.h>

#include "core/error.hpp"
#include "tests/formats/sample_files.hpp"

using namespace raywatch;
using namespace raywatch::test;

TEST_CASE("a binary PCD gives its floats back and skips other fields by their size and count") {
  const PcdText text{.fields = "ring y x _ z",
                     .size = "2 4 4 1 4",
                     .type = "U F F U F",
                     .count = "1 1 1 3 1",
                     .width = "1",
                     .points = "1",
                     .data = "binary"};
  const std::string point = bits(std::uint16_t{9}) + bits(2.0F) + bits(1.0F) + "pad" + bits(3.0F);
  const PointCloud cloud = decode(text.header() + point)[0].points;
  CHECK(cloud[0] == Eigen::Vector3f(1, 2, 3));
  CHECK(cloud.intensity.empty());
  CHECK_FALSE(cloud.grid);
}

TEST_CASE("an ascii PCD reads nan and inf as such and counts the columns of wide fields") {
  const PcdText text{.fields = "normal x y z", .size = "4 4 4 4", .type = "F F F F", .count = "3 1 1 1"};
  const PointCloud cloud = decode(text.header() + "9 9 9 1.5 -inf 3\n\n8 8 8  4\t5 6")[0].points;
  CHECK(cloud.size() == 2);
  CHECK(cloud.x_m[0] == 1.5F);
  CHECK(cloud.y_m[0] == -std::numeric_limits<float>::infinity());
  CHECK(cloud[1] == Eigen::Vector3f(4, 5, 6));
}

TEST_CASE("an intensity of any type becomes a float") {
  const auto intensity = [](const std::string& type, const std::string& size, const std::string& value) {
    const PcdText text{.fields = "x y z intensity",
                       .size = "4 4 4 " + size,
                       .type = "F F F " + type,
                       .count = "1 1 1 1",
                       .width = "1",
                       .points = "1",
                       .data = "binary"};
    return decode(text.header() + bits(1.0F) + bits(1.0F) + bits(1.0F) + value)[0].points.intensity.at(0);
  };
  CHECK(intensity("U", "1", bits(std::uint8_t{200})) == 200.0F);
  CHECK(intensity("I", "1", bits(std::int8_t{-3})) == -3.0F);
  CHECK(intensity("U", "2", bits(std::uint16_t{40000})) == 40000.0F);
  CHECK(intensity("I", "2", bits(std::int16_t{-300})) == -300.0F);
  CHECK(intensity("U", "4", bits(std::uint32_t{3000000000})) == 3e9F);
  CHECK(intensity("I", "4", bits(std::int32_t{-5})) == -5.0F);
  CHECK(intensity("I", "8", bits(std::int64_t{-6})) == -6.0F);
  CHECK(intensity("U", "8", bits(std::uint64_t{1} << 63)) == 9223372036854775808.0F);
  CHECK(intensity("F", "4", bits(0.25F)) == 0.25F);
  CHECK(intensity("F", "8", bits(0.125)) == 0.125F);
}

TEST_CASE("the VIEWPOINT is read in double, with the scalar part of its quaternion first") {
  const PcdText text{.viewpoint = "500000.123456789 5400000.987654321 12.5 0 0 0 1"};
  const auto pose = decode(text.header() + "1 2 3\n4 5 6\n")[0].world_from_sensor;
  REQUIRE(pose);
  CHECK(pose->position_m == Eigen::Vector3d(500000.123456789, 5400000.987654321, 12.5));
  CHECK(pose->orientation.z() == 1.0);
}

TEST_CASE("an identity VIEWPOINT counts as absent, and so does none") {
  CHECK_FALSE(decode(PcdText{}.header() + "1 2 3\n4 5 6\n")[0].world_from_sensor);
  CHECK_FALSE(
      decode("VERSION .7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nWIDTH 1\nDATA ascii\n1 2 3")[0].world_from_sensor);
}

TEST_CASE("a VIEWPOINT whose quaternion is not of unit norm is refused") {
  const PcdText text{.viewpoint = "1 2 3 2 0 0 0"};
  CHECK(contains(refusal<InvalidInput>(text.header() + "1 2 3\n4 5 6\n"),
                 "line 9: VIEWPOINT: must be a unit quaternion"));
}

TEST_CASE("a PCD with a height is a grid of shots") {
  const PcdText text{.width = "3", .height = "2", .points = "6"};
  const PointCloud cloud = decode(text.header() + "1 0 0\n2 0 0\n3 0 0\n4 0 0\n5 0 0\n6 0 0\n")[0].points;
  REQUIRE(cloud.grid);
  CHECK(*cloud.grid == ShotGrid{.rows = 2, .columns = 3});
  CHECK(cloud.x_m[1 * 3 + 2] == 6.0F);
}

TEST_CASE("double world coordinates keep their millimetres on the way into the sensor frame") {
  const PcdText text{.size = "8 8 8",
                     .width = "1",
                     .viewpoint = "4500000 5400000 100 0.5 0.5 0.5 0.5",
                     .points = "1",
                     .data = "binary"};
  const std::string point = bits(4500000.001) + bits(5400000.002) + bits(100.003);
  const PointCloud cloud = decode(text.header() + point, "", {.frame = Frame::world})[0].points;
  // The quaternion turns x to y, y to z and z to x, so its inverse turns y to x.
  CHECK(cloud.x_m[0] == doctest::Approx(0.002).epsilon(1e-5));
  CHECK(cloud.y_m[0] == doctest::Approx(0.003).epsilon(1e-5));
  CHECK(cloud.z_m[0] == doctest::Approx(0.001).epsilon(1e-5));
}

TEST_CASE("coordinates that a comment gives an origin for are relative to it") {
  const std::string file =
      "# .PCD v0.7\n# origin_m 1000 2000 3000\nVERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\n"
      "WIDTH 1\nDATA ascii\n1 2 3\n";
  const ScanHints hints{.frame = Frame::world, .pose = Pose{.position_m = {1000, 2000, 3000}}};
  CHECK(decode(file, "", hints)[0].points[0] == Eigen::Vector3f(1, 2, 3));
}

TEST_CASE("a broken PCD header is refused with the line and the entry") {
  const auto message = [](const PcdText& text) { return refusal<InvalidInput>(text.header() + "1 2 3\n4 5 6\n"); };
  CHECK(contains(message({.fields = "x y"}), "line 4: PCD header: SIZE has 3 values for 2 fields"));
  CHECK(contains(message({.fields = "x y w"}), "FIELDS has no z"));
  CHECK(contains(message({.fields = "x y z z", .size = "4 4 4 4", .type = "F F F F", .count = "1 1 1 1"}), "twice"));
  CHECK(contains(message({.size = "4 4 3"}), "F3"));
  CHECK(contains(message({.type = "F F U"}), "z must be of TYPE F"));
  CHECK(contains(message({.count = "1 1 2"}), "COUNT of z is not 1"));
  CHECK(contains(message({.width = "-2"}), "line 7"));
  CHECK(contains(message({.width = "two"}), "'two' is not a whole number"));
  CHECK(contains(message({.viewpoint = "0 0 0"}), "VIEWPOINT needs seven values"));
  CHECK(contains(message({.points = "3"}), "POINTS is not WIDTH times HEIGHT, which is 2"));
  CHECK(contains(message({.data = "zipped"}), "line 11: PCD header: DATA"));
  CHECK(contains(message({.height = "1\nHEIGHT 1"}), "HEIGHT stands there twice"));
  CHECK(contains(message({.height = "1\nCOLOUR red"}), "'COLOUR' is no entry"));
  CHECK(contains(refusal<InvalidInput>("# .PCD v0.7\nVERSION 0.7\nWIDTH 2\n"), "ends within the PCD header"));
}

TEST_CASE("WIDTH times HEIGHT that overflows is refused") {
  const PcdText text{.width = "6000000000", .height = "6000000000", .points = "0", .data = "binary"};
  CHECK(contains(refusal<InvalidInput>(text.header()), "WIDTH times HEIGHT is more than 2^64"));
}

TEST_CASE("a COUNT that makes a point larger than memory is refused") {
  const PcdText text{.fields = "x y z w", .size = "4 4 4 8", .type = "F F F F", .count = "1 1 1 4611686018427387904"};
  CHECK(contains(refusal<InvalidInput>(text.header() + "1 2 3"), "COUNT of 'w'"));
}

TEST_CASE("an ascii PCD is refused at the line that is wrong") {
  const std::string header = PcdText{}.header();
  CHECK(contains(refusal<InvalidInput>(header + "1 2 3\n4 55555\n"), "line 13: 2 values instead of 3"));
  CHECK(contains(refusal<InvalidInput>(header + "1 2 3\n4 5 six\n"), "line 13: 'six' is not a number"));
  CHECK(contains(refusal<InvalidInput>(header + "1 2 3\n4 5 6\n7 8 9\n"), "line 14: more points"));
  CHECK(contains(refusal<InvalidInput>(header + "1 2 3333333\n"), "promises 2 points, but the file ends after 1"));
}

TEST_CASE("a binary PCD may be followed by zeros but not by anything else") {
  const PcdText text{.width = "1", .points = "1", .data = "binary"};
  const std::string file = text.header() + bits(1.0F) + bits(2.0F) + bits(3.0F);
  CHECK(decode(file + std::string(100, '\0'))[0].points.size() == 1);
  CHECK(contains(refusal<InvalidInput>(file + "more"), "4 bytes follow the points"));
}

TEST_CASE("compressed data that contradicts its sizes is refused") {
  const PcdText text{.data = "binary_compressed"};
  const auto message = [&](std::uint32_t packed, std::uint32_t unpacked, const std::string& stream) {
    return refusal<InvalidInput>(text.header() + bits(packed) + bits(unpacked) + stream);
  };
  CHECK(contains(message(100, 24, "short"), "should have 100 bytes, but only 5 follow"));
  CHECK(contains(message(5, 25, "short"), "claims 25 bytes for points of 24 bytes"));
  CHECK(contains(message(5, 12, "short"), "promises 2 points"));
  CHECK(contains(message(5, 24, "\xFF\xFF\xFF\xFF\xFF"), "broken"));
  CHECK(contains(refusal<InvalidInput>(text.header() + "ab"), "before the sizes"));
}

TEST_CASE("compressed data cannot promise more than its length can hold") {
  const PcdText text{.width = "100000000", .points = "100000000", .data = "binary_compressed"};
  const std::string file = text.header() + bits(std::uint32_t{5}) + bits(std::uint32_t{1200000000}) + "short";
  CHECK(contains(refusal<InvalidInput>(file, "", {}, {.max_points = 1'000'000'000}), "cannot hold 1200000000 bytes"));
}
