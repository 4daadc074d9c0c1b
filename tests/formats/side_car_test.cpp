#include "storage/formats/side_car.hpp"

#include <doctest/doctest.h>

#include <fstream>
#include <string>

#include "core/error.hpp"
#include "tests/formats/sample_files.hpp"
#include "tests/support/temp_dir.hpp"

using namespace raywatch;
using namespace raywatch::test;

namespace {

std::string message_for(std::string_view json) {
  try {
    parse_side_car(json, "scan.pcd.json");
  } catch (const InvalidInput& error) {
    return error.what();
  }
  return "not refused";
}

}  // namespace

TEST_CASE("a side-car gives time, sensor, frame and pose") {
  const ScanHints hints = parse_side_car(
      R"({"captured_at": "2026-03-01T02:10:00+01:00", "sensor": "tower", "frame": "world",
          "pose": {"position_m": [1, 2.5, -3], "orientation_xyzw": [0, 0, 1, 0]}})",
      "scan.pcd.json");
  CHECK(hints.captured_at == parse_rfc3339("2026-03-01T01:10:00Z"));
  CHECK(hints.sensor == "tower");
  CHECK(hints.frame == Frame::world);
  REQUIRE(hints.pose);
  CHECK(hints.pose->position_m == Eigen::Vector3d(1, 2.5, -3));
  CHECK(hints.pose->orientation.z() == 1.0);
}

TEST_CASE("every member of a side-car may be absent") {
  const ScanHints hints = parse_side_car("{}", "scan.pcd.json");
  CHECK_FALSE((hints.captured_at || hints.sensor || hints.frame || hints.pose || hints.format || hints.fixed_pose));
}

TEST_CASE("a side-car with a mistake is refused with the file and the member") {
  CHECK(contains(message_for("{\"captured_at\": "), "scan.pcd.json: malformed JSON: parse error at line 1, column 17"));
  CHECK(contains(message_for("[]"), "must be a JSON object"));
  CHECK(contains(message_for(R"({"captured_ad": "x"})"), "captured_ad: unknown member; did you mean 'captured_at'?"));
  CHECK(contains(message_for(R"({"pose": {"positon_m": [1,2,3]}})"),
                 "pose.positon_m: unknown member; did you mean 'position_m'?"));
  CHECK(contains(message_for(R"({"captured_at": 5})"), "captured_at: must be a string"));
  CHECK(contains(message_for(R"({"captured_at": "yesterday"})"), "captured_at"));
  CHECK(contains(message_for(R"({"frame": "moon"})"), "frame"));
  CHECK(contains(message_for(R"({"pose": [1,2,3]})"), "pose: must be an object"));
  CHECK(contains(message_for(R"({"pose": {"position_m": [1,2,3]}})"), "pose.orientation_xyzw: is missing"));
  CHECK(contains(message_for(R"({"pose": {"position_m": [1,2], "orientation_xyzw": [0,0,0,1]}})"),
                 "pose.position_m: must be an array of 3 numbers"));
  CHECK(contains(message_for(R"({"pose": {"position_m": [1,2,null], "orientation_xyzw": [0,0,0,1]}})"),
                 "pose.position_m: must be an array of 3 numbers"));
  CHECK(contains(message_for(R"({"pose": {"position_m": [1,2,3], "orientation_xyzw": [0,0,0,2]}})"),
                 "scan.pcd.json: pose: must be a unit quaternion"));
  CHECK(contains(message_for(R"({"pose": {"position_m": [1e12,2,3], "orientation_xyzw": [0,0,0,1]}})"),
                 "scan.pcd.json: pose: must have a position within 1e8 m"));
  CHECK(contains(message_for(R"({"by": "anna"})"), "by: unknown member; known are captured_at, sensor, frame, pose"));
  CHECK(contains(message_for(R"({"sensor": "a", "sensor": "b"})"), "sensor: stands there twice"));
}

TEST_CASE("a mistake is told once, with the member at its place") {
  CHECK(message_for(R"({"captured_at": 7})") == "scan.pcd.json: captured_at: must be a string");
  CHECK(message_for(R"({"frame": "world "})") == "scan.pcd.json: frame: 'world ' is no frame; it is sensor or world");
}

TEST_CASE("a scan file without a side-car has no hints") {
  const TempDir folder;
  CHECK_FALSE(read_side_car(folder.path() / "scan.pcd").pose);
}

TEST_CASE("what is written as a side-car is read back exactly") {
  const TempDir folder;
  const auto scan_file = folder.path() / "scan.pcd";
  const Pose pose{.orientation = Eigen::Quaterniond(0.5, -0.5, 0.5, 0.5), .position_m = {0.1, 1.0 / 3.0, -5400000.123}};
  const ScanHints written{.frame = Frame::sensor,
                          .pose = pose,
                          .captured_at = parse_rfc3339("2026-03-01T01:10:00.123456789Z"),
                          .sensor = "Türm \"1\""};
  write_side_car(scan_file, written);
  const ScanHints read = read_side_car(scan_file);
  CHECK(read.captured_at == written.captured_at);
  CHECK(read.sensor == written.sensor);
  CHECK(read.frame == written.frame);
  REQUIRE(read.pose);
  CHECK(read.pose->position_m == pose.position_m);
  CHECK(read.pose->orientation.coeffs() == pose.orientation.coeffs());
}

TEST_CASE("a side-car that cannot be written or is no side-car is refused") {
  const TempDir folder;
  CHECK_THROWS_AS(write_side_car(folder.path() / "absent" / "scan.pcd", {}), StorageError);
  CHECK_THROWS_AS(write_side_car(folder.path() / "scan.pcd", {.sensor = "\xFF"}), InvalidInput);
  std::ofstream(folder.path() / "huge.pcd.json") << std::string(2 << 20, ' ');
  CHECK_THROWS_AS(read_side_car(folder.path() / "huge.pcd"), TooLarge);
}

TEST_CASE("a pose as text is seven numbers") {
  const Pose pose = parse_pose_text("1, 2.5,-3,0,0,0,1", "pose");
  CHECK(pose.position_m == Eigen::Vector3d(1, 2.5, -3));
  CHECK(pose.orientation.w() == 1.0);
  CHECK_THROWS_WITH_AS(parse_pose_text("1,2,3", "pose"), "must be seven numbers, x,y,z,qx,qy,qz,qw, but there are 3",
                       InvalidInput);
  CHECK_THROWS_WITH_AS(parse_pose_text("1,2,3,0,0,0,one", "pose"), doctest::Contains("'one' is not a number"),
                       InvalidInput);
  CHECK_THROWS_AS(parse_pose_text("1,2,3,0,0,0,2", "pose"), InvalidInput);
  CHECK_THROWS_AS(parse_pose_text("1,2,nan,0,0,0,1", "pose"), InvalidInput);
  CHECK_THROWS_AS(parse_pose_text("", "pose"), InvalidInput);
}
