#include <doctest/doctest.h>

#include "core/error.hpp"
#include "tests/formats/sample_files.hpp"

using namespace raywatch;
using namespace raywatch::test;

namespace {

ScanHints in_sensor_frame() { return {.frame = Frame::sensor}; }

}  // namespace

TEST_CASE("every point format of LAS 1.2 to 1.4 gives coordinates and intensity") {
  for (std::uint8_t minor = 2; minor <= 4; ++minor) {
    for (std::uint8_t format = 0; format <= 10; ++format) {
      CAPTURE(int{minor});
      CAPTURE(int{format});
      const LasFile file{.minor = minor, .point_format = format, .extra_bytes = 5};
      const PointCloud cloud = decode(file.bytes(), "", in_sensor_frame())[0].points;
      REQUIRE(cloud.size() == 2);
      CHECK(cloud[0] == Eigen::Vector3f(1, 2, 3));
      CHECK(cloud[1] == Eigen::Vector3f(-1, 0, 0.5F));
      CHECK(cloud.intensity == std::vector<float>{7, 65535});
    }
  }
}

TEST_CASE("LAS stands in the world, so it is refused without a pose") {
  CHECK(contains(refusal<InvalidInput>(LasFile{}.bytes()),
                 "the sensor position is needed, because without it there are no rays"));
}

TEST_CASE("LAS coordinates of a national grid keep their millimetres in the sensor frame") {
  const LasFile file{.origin_m = {500'000, 5'400'000, 300}, .points = {{1234, -4321, 777, 0}}};
  const Pose pose{.position_m = {500'001, 5'399'990, 301}};
  const DecodedScan scan = decode(file.bytes(), "", {.pose = pose})[0];
  CHECK(scan.points.x_m[0] == doctest::Approx(0.234).epsilon(1e-6));
  CHECK(scan.points.y_m[0] == doctest::Approx(5.679).epsilon(1e-6));
  CHECK(scan.points.z_m[0] == doctest::Approx(-0.223).epsilon(1e-6));
  CHECK(scan.world_from_sensor->position_m == pose.position_m);
  CHECK_FALSE(scan.captured_at);
}

TEST_CASE("points of a LAS file may be followed by other records") {
  CHECK(decode(LasFile{.minor = 4}.bytes() + "extended records", "", in_sensor_frame())[0].points.size() == 2);
}

TEST_CASE("compressed points are refused by name") {
  CHECK(contains(refusal<InvalidInput>(LasFile{.point_format = 0x80}.bytes()), "LAZ"));
  CHECK(contains(refusal<UnsupportedFormat>("whatever", "scan.laz"), "LAZ"));
}

TEST_CASE("a broken LAS header is refused with what is wrong") {
  const auto patched = [](std::size_t at, const std::string& value) {
    return LasFile{}.bytes().replace(at, value.size(), value);
  };
  const auto message = [](const std::string& file) { return refusal<InvalidInput>(file, "", in_sensor_frame()); };
  CHECK(contains(message(patched(25, bits(std::uint8_t{1}))), "version 1.1 is not read"));
  CHECK(contains(message(patched(94, bits(std::uint16_t{100}))), "contradict version 1.2"));
  CHECK(contains(message(patched(96, bits(std::uint32_t{100000}))), "begin at byte 100000"));
  CHECK(contains(message(patched(104, bits(std::uint8_t{11}))), "point format 11"));
  CHECK(contains(message(patched(105, bits(std::uint16_t{19}))), "too short for point format 0"));
  CHECK(contains(message(patched(107, bits(std::uint32_t{3}))), "promises 3 points, which need at least 60 bytes"));
  CHECK(contains(message(patched(131, bits(0.0))), "scale factor"));
  CHECK(contains(message(patched(155, bits(double{kNan}))), "offset is not finite"));
  CHECK(contains(message(LasFile{.points = {}}.bytes()), "no points"));
  CHECK(contains(message(LasFile{}.bytes().substr(0, 100)), "needs 227 bytes, but the file has only 100"));
}

TEST_CASE("two numbers of points that differ are refused") {
  const std::string file = LasFile{.minor = 4}.bytes().replace(107, 4, bits(std::uint32_t{1}));
  CHECK(contains(refusal<InvalidInput>(file, "", in_sensor_frame()), "two numbers of points, 2 and 1"));
}

TEST_CASE("a LAS coordinate beyond a float is refused with the point") {
  const LasFile file{.scale_m = {1, 1, 1e36}, .points = {{1, 1, 1, 0}, {1, 1, 1000, 0}}};
  CHECK(contains(refusal<InvalidInput>(file.bytes(), "", in_sensor_frame()), "point 1"));
}
