#include "storage/survey_files/epoch_las.hpp"

#include <doctest/doctest.h>

#include <cstring>
#include <fstream>
#include <limits>
#include <sstream>

#include "storage/formats/scan_file.hpp"
#include "tests/support/temp_dir.hpp"

namespace raywatch {
namespace {

/// A scan of four points, one of which is no measurement, from 100 m above.
struct SmallEpoch {
  PointCloud points;
  PriorIndex index;
  EpochScans scans;
  std::vector<EpochPoints> about{
      {{PointClass::unchanged, PointClass::added, PointClass::invalid, PointClass::removed}, {-1, 0, -1, 1}}};

  SmallEpoch() : points(cloud()), index(PriorIndex::build(points, {})) {
    scans.add({points, index, Pose{.position_m = {5.0, 6.0, 100.0}}, parse_rfc3339("2026-03-28T22:30:00Z"), {}, {}}, 0);
  }
  static PointCloud cloud() {
    PointCloud cloud;
    cloud.push_back(1.0f, 2.0f, -99.5f);
    cloud.push_back(-3.25f, 4.5f, -100.125f);
    cloud.push_back(std::numeric_limits<float>::quiet_NaN(), 0.0f, 0.0f);
    cloud.push_back(0.0f, 0.0f, -101.0f);
    cloud.intensity = {7.0f, 70000.0f, 1.0f, 9.0f};
    return cloud;
  }
  std::string las(const OutputFrame& frame, const std::string& wkt = "") const {
    std::ostringstream out;
    write_las(out, {.scans = scans, .about = about, .frame = frame, .wkt = wkt, .program_version = "1.2.3"});
    return out.str();
  }
};

template <class T>
T at(const std::string& bytes, std::size_t place) {
  T value;
  std::memcpy(&value, bytes.data() + place, sizeof value);
  return value;
}

TEST_CASE("an epoch reads back as LAS 1.4 with the project's own reader") {
  const TempDir dir;
  const OutputFrame frame{.origin_m = {500000.0, 5540000.0, 300.0}};
  const std::filesystem::path path = dir / "after.las";
  std::ofstream(path, std::ios::binary) << SmallEpoch().las(frame);
  ScanHints hints;
  hints.pose = Pose{.position_m = {500005.0, 5540006.0, 400.0}};
  const std::vector<DecodedScan> scans = read_scan_file(path, hints);
  REQUIRE(scans.size() == 1);
  const PointCloud& points = scans[0].points;
  REQUIRE(points.size() == 3);
  CHECK((points[0] - Eigen::Vector3f(1.0f, 2.0f, -99.5f)).norm() < 2e-3f);
  CHECK((points[1] - Eigen::Vector3f(-3.25f, 4.5f, -100.125f)).norm() < 2e-3f);
  CHECK((points[2] - Eigen::Vector3f(0.0f, 0.0f, -101.0f)).norm() < 2e-3f);
}

TEST_CASE("header and records stand where LAS 1.4 has them") {
  const std::string wkt = "PROJCS[\"somewhere\"]";
  const std::string bytes = SmallEpoch().las({.origin_m = {500000.0, 0.0, 0.0}}, wkt);
  CHECK(bytes.starts_with("LASF"));
  CHECK(at<std::uint16_t>(bytes, 6) == 0x11);  // adjusted GPS time, WKT
  CHECK(at<std::uint8_t>(bytes, 24) == 1);
  CHECK(at<std::uint8_t>(bytes, 25) == 4);
  CHECK(at<std::uint16_t>(bytes, 94) == 375);
  const auto first = at<std::uint32_t>(bytes, 96);
  CHECK(at<std::uint32_t>(bytes, 100) == 2);
  CHECK(at<std::uint8_t>(bytes, 104) == 6);
  CHECK(at<std::uint16_t>(bytes, 105) == 30);
  CHECK(at<std::uint64_t>(bytes, 247) == 3);
  CHECK(at<std::uint64_t>(bytes, 255) == 3);
  CHECK(at<double>(bytes, 179) == 500006.0);                    // greatest x
  CHECK(at<double>(bytes, 187) == doctest::Approx(500001.75));  // least x
  REQUIRE(bytes.size() == first + 3 * 30);
  CHECK(bytes.substr(first - wkt.size() - 1, wkt.size()) == wkt);
  const auto lookup = 375 + 54;
  CHECK(std::string(bytes.data() + lookup + 16 * 65 + 1) == "added");
  CHECK(at<std::uint16_t>(bytes, first + 12) == 7);
  CHECK(at<std::uint16_t>(bytes, first + 30 + 12) == 65535);
  CHECK(at<std::uint8_t>(bytes, first + 14) == 0x11);
  CHECK(at<std::uint8_t>(bytes, first + 16) == 64);       // unchanged
  CHECK(at<std::uint8_t>(bytes, first + 30 + 16) == 65);  // added
  CHECK(at<std::uint8_t>(bytes, first + 60 + 16) == 66);  // removed
  CHECK(at<std::uint16_t>(bytes, first + 20) == 1);
  // 2026-03-28T22:30:00Z is 1774737000 s after 1970; GPS time is 18 s ahead of UTC.
  CHECK(at<double>(bytes, first + 22) == 1774737000.0 - 315964800.0 + 18.0 - 1e9);
}

TEST_CASE("an epoch without a point is a LAS file without a record") {
  const EpochScans none;
  std::ostringstream out;
  write_las(out, {.scans = none, .about = {}});
  CHECK(at<std::uint64_t>(out.str(), 247) == 0);
}

}  // namespace
}  // namespace raywatch
