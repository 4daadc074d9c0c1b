#include "storage/formats/scan_file.hpp"

#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>

#include "core/error.hpp"
#include "tests/formats/sample_files.hpp"
#include "tests/support/temp_dir.hpp"

using namespace raywatch;
using namespace raywatch::test;

namespace {

const ScanHints kSensorFrame{.frame = Frame::sensor};

ScanFormat detected(std::string_view bytes, std::string_view name) {
  return detect_scan_format(std::as_bytes(std::span(bytes)), name);
}

/// LAS needs a frame that the others have anyway.
void read_quietly(const NamedFile& file, std::size_t size) {
  try {
    decode(std::string_view(file.bytes).substr(0, size), file.name, kSensorFrame);
  } catch (const Error&) {
  }
}

}  // namespace

TEST_CASE("one file of each format is read") {
  for (const NamedFile& file : one_file_of_each_format()) {
    CAPTURE(file.name);
    CHECK_FALSE(decode(file.bytes, file.name, kSensorFrame)[0].points.empty());
  }
}

TEST_CASE("a file that ends early, at any byte, is read or refused, and nothing else") {
  for (const NamedFile& file : one_file_of_each_format()) {
    CAPTURE(file.name);
    for (std::size_t size = 0; size < file.bytes.size(); ++size) CHECK_NOTHROW(read_quietly(file, size));
  }
}

TEST_CASE("a file with any byte changed is read or refused, and nothing else") {
  for (NamedFile file : one_file_of_each_format()) {
    CAPTURE(file.name);
    for (std::size_t i = 0; i < file.bytes.size(); ++i) {
      const char original = file.bytes[i];
      for (const char other : {'\0', '\xFF', '9', '-', '\n'}) {
        file.bytes[i] = other;
        CHECK_NOTHROW(read_quietly(file, file.bytes.size()));
      }
      file.bytes[i] = original;
    }
  }
}

TEST_CASE("the content shows the format, whatever the file is called") {
  for (const NamedFile& file : one_file_of_each_format()) {
    if (file.name == "velodyne.bin") continue;  // nothing but numbers
    CAPTURE(file.name);
    CHECK(detected(file.bytes, "upload-1.bin") == detected(file.bytes, file.name));
    CHECK_FALSE(decode(file.bytes, "", kSensorFrame).empty());
  }
}

TEST_CASE("numbers that are none show a table all the same, so that the reader says what is wrong") {
  CHECK(detected("nan nan nan\nnan nan nan\n", "upload-17") == ScanFormat::text);
  CHECK(detected("-inf,NaN,1.5\n", "upload-17") == ScanFormat::text);
  CHECK(contains(refusal<InvalidInput>("nan nan nan\nnan nan nan\nnan nan nan\n", "upload-17"), "no finite point"));
}

TEST_CASE("where the content does not tell, the name does") {
  CHECK(detected("????", "A.PCD") == ScanFormat::pcd);
  CHECK(detected("????", "a.ply") == ScanFormat::ply);
  CHECK(detected("????", "a.las") == ScanFormat::las);
  CHECK(detected("????", "a.ptx") == ScanFormat::ptx);
  CHECK(detected("????", "a.xyz") == ScanFormat::text);
  CHECK(detected("????", "a.asc") == ScanFormat::text);
  CHECK(detected("????", "000001.bin") == ScanFormat::kitti);
}

TEST_CASE("an unknown format is refused with the known ones") {
  for (const std::string bytes : {"GIF89a", "hello world", "{\"a\": 1}",
                                  "\x7F"
                                  "ELF"}) {
    CAPTURE(bytes);
    CHECK(contains(refusal<UnsupportedFormat>(bytes, "upload-17"), "known are pcd, ply, las"));
    CHECK(contains(refusal<UnsupportedFormat>(bytes, "upload-17"), "give format=kitti"));
  }
  CHECK(contains(refusal<UnsupportedFormat>("RWPB....", "points.bin"), "point table that raywatch wrote"));
}

TEST_CASE("names of formats and frames are parsed strictly") {
  for (const char* name : {"pcd", "ply", "las", "ptx", "text", "kitti"}) {
    CHECK(to_string(parse_scan_format(name)) == name);
  }
  CHECK(parse_scan_format("csv") == ScanFormat::text);
  CHECK(parse_scan_format("bin") == ScanFormat::kitti);
  CHECK_THROWS_WITH_AS(parse_scan_format("jpg"), doctest::Contains("'jpg' is no scan format; known are pcd"),
                       UnsupportedFormat);
  CHECK(parse_frame("world") == Frame::world);
  CHECK_THROWS_WITH_AS(parse_frame("World"), doctest::Contains("sensor or world"), InvalidInput);
}

TEST_CASE("an empty file is refused") { CHECK(contains(refusal<InvalidInput>("", "a.pcd"), "empty")); }

TEST_CASE("a scan without points is refused") {
  PcdText text{.width = "0", .points = "0"};
  for (const char* data : {"ascii", "binary", "binary_compressed"}) {
    text.data = data;
    CHECK(contains(refusal<InvalidInput>(text.header() + std::string(8, '\0')), "no points"));
  }
}

TEST_CASE("a header that promises more points than follow is refused before memory is taken") {
  for (const char* data : {"ascii", "binary"}) {
    const PcdText text{.width = "1000000000000", .points = "1000000000000", .data = data};
    CHECK(contains(refusal<InvalidInput>(text.header() + "1 2 3\n"),
                   "promises 1000000000000 points, which need at least "));
  }
  CHECK(
      contains(refusal<InvalidInput>("ply\nformat ascii 1.0\nelement vertex 1000000000000\nproperty float x\nproperty "
                                     "float y\nproperty float z\nend_header\n1 2 3\n"),
               "which need at least 6000000000000 bytes, but only 7 follow"));
  CHECK(contains(refusal<InvalidInput>(ptx_header(1000000, 1000000) + "1 2 3 0\n"), "promises 1000000000000 points"));
}

TEST_CASE("a scan in which no point is finite is refused") {
  CHECK(contains(refusal<InvalidInput>(PcdText{}.header() + "nan nan nan\n1 2 inf\n"), "no finite point"));
  CHECK(contains(refusal<InvalidInput>("nan nan nan\n", "a.xyz"), "no finite point"));
  CHECK(contains(refusal<InvalidInput>(bits(kNan) + bits(1.0F) + bits(1.0F) + bits(1.0F), "a.bin"), "no finite point"));
}

TEST_CASE("world coordinates without the sensor's position are refused with the reason") {
  const ScanHints hints{.frame = Frame::world};
  for (const NamedFile& file : one_file_of_each_format()) {
    if (file.name == "two.ptx") continue;  // says where it was taken
    CAPTURE(file.name);
    CHECK(contains(refusal<InvalidInput>(file.bytes, file.name, hints),
                   "the sensor position is needed, because without it there are no rays"));
  }
}

TEST_CASE("points past the limit are too many") {
  CHECK(
      contains(refusal<TooLarge>(PcdText{}.header() + "1 2 3\n4 5 6\n", "", {}, {.max_points = 1}), "the limit is 1"));
}

TEST_CASE("a finite coordinate that is no finite float is refused with its point") {
  CHECK(contains(refusal<InvalidInput>("1 2 3\n4 -1e39 6\n", "a.xyz"), "point 1 (counted from 0): the value -1e+39"));
}

TEST_CASE("a given pose beats the file's, and the file's beats the sensor's fixed one") {
  const std::string with_pose = PcdText{.viewpoint = "2 2 2 1 0 0 0"}.header() + "1 2 3\n4 5 6\n";
  const std::string without = PcdText{}.header() + "1 2 3\n4 5 6\n";
  const Pose given{.position_m = {1, 1, 1}};
  const Pose fixed{.position_m = {3, 3, 3}};
  const auto x_of = [](const std::string& file, const ScanHints& hints) {
    return decode(file, "", hints)[0].world_from_sensor->position_m.x();
  };
  CHECK(x_of(with_pose, {.pose = given, .fixed_pose = fixed}) == 1.0);
  CHECK(x_of(with_pose, {.fixed_pose = fixed}) == 2.0);
  CHECK(x_of(without, {.fixed_pose = fixed}) == 3.0);
  CHECK_FALSE(decode(without)[0].world_from_sensor);
}

TEST_CASE("a given time and sensor stand in every scan of the file") {
  const Time time = parse_rfc3339("2026-03-01T02:10:00Z");
  const ScanHints hints{.captured_at = time, .sensor = "tower"};
  for (const DecodedScan& scan : decode(ptx_header(1, 1) + "1 2 3\n" + ptx_header(1, 1) + "1 2 3\n", "", hints)) {
    CHECK(scan.captured_at == time);
    CHECK(scan.sensor == "tower");
  }
}

TEST_CASE("a KITTI file that is no whole number of records is refused") {
  CHECK(contains(refusal<InvalidInput>("123456789012345678", "000000.bin"), "records of 16 bytes"));
  const PointCloud cloud = decode(bits(1.0F) + bits(2.0F) + bits(3.0F) + bits(0.5F), "000000.bin")[0].points;
  CHECK(cloud[0] == Eigen::Vector3f(1, 2, 3));
  CHECK(cloud.intensity == std::vector<float>{0.5F});
}

TEST_CASE("a file on the disk tells its format by its content, else by its ending") {
  const TempDir folder;
  for (const NamedFile& file : one_file_of_each_format()) {
    std::ofstream(folder.path() / file.name, std::ios::binary) << file.bytes;
    CHECK(scan_format_of(folder.path() / file.name) == detected(file.bytes, file.name));
  }
  CHECK_THROWS_AS(scan_format_of(folder.path() / "absent.pcd"), StorageError);
}

TEST_CASE("a file is read from the disk, and what is none is refused") {
  const TempDir folder;
  const auto path = folder.path() / "scan.xyz";
  std::ofstream(path) << "1 2 3\n";
  CHECK(read_scan_file(path)[0].points.size() == 1);
  CHECK_THROWS_AS(read_scan_file(path, {}, {.max_bytes = 5}), TooLarge);
  CHECK_THROWS_AS(read_scan_file(folder.path() / "absent.xyz"), StorageError);
  CHECK_THROWS_WITH_AS(read_scan_file(folder.path()), doctest::Contains("not a regular file"), StorageError);
  std::ofstream(folder.path() / "empty.pcd").flush();
  CHECK_THROWS_WITH_AS(read_scan_file(folder.path() / "empty.pcd"), doctest::Contains("empty"), InvalidInput);
}
