#include "storage/formats/write.hpp"

#include <doctest/doctest.h>
#include <rapidcheck.h>

#include <bit>
#include <sstream>

#include "core/error.hpp"
#include "tests/formats/sample_files.hpp"

using namespace raywatch;
using namespace raywatch::test;

namespace {

const std::vector<float> kX = {1.0F, 0.1F};
const std::vector<float> kY = {-2.5F, 1e-7F};
const std::vector<float> kZ = {3.0F, kNan};
const std::vector<std::uint8_t> kClass = {0, 2};
const std::vector<std::int32_t> kCluster = {-1, 12};

PointTable table() {
  return {.x_m = kX, .y_m = kY, .z_m = kZ, .columns = {{"class", std::span(kClass)}, {"cluster", std::span(kCluster)}}};
}

std::string written(PointFormat format, const PointTable& points) {
  std::ostringstream out;
  write_points(out, format, points);
  return out.str();
}

std::string rows() {
  std::string bytes;
  for (std::size_t i = 0; i < 2; ++i)
    bytes += bits(kX[i]) + bits(kY[i]) + bits(kZ[i]) + bits(kClass[i]) + bits(kCluster[i]);
  return bytes;
}

/// Any 32 bits, so that NaN payloads, infinities and denormals come too.
float any_float() { return std::bit_cast<float>(*rc::gen::arbitrary<std::uint32_t>()); }

PointCloud any_cloud() {
  const auto rows = *rc::gen::inRange<std::uint32_t>(1, 5);
  const auto columns = *rc::gen::inRange<std::uint32_t>(1, 8);
  const bool has_intensity = *rc::gen::arbitrary<bool>();
  PointCloud cloud;
  for (std::uint32_t i = 0; i < rows * columns; ++i) {
    cloud.push_back(any_float(), any_float(), any_float());
    if (has_intensity) cloud.intensity.push_back(any_float());
  }
  if (rows > 1) cloud.grid = ShotGrid{.rows = rows, .columns = columns};
  // A scan needs one finite point.
  cloud.x_m[0] = cloud.y_m[0] = cloud.z_m[0] = 1.0F;
  return cloud;
}

}  // namespace

TEST_CASE("points as CSV have a header, shortest numbers, and an empty cell for no cluster") {
  CHECK(written(PointFormat::csv, table()) == "x,y,z,class,cluster\n1,-2.5,3,0,\n0.1,1e-07,nan,2,12\n");
}

TEST_CASE("labels stand in CSV instead of the values they name, and columns may lead") {
  constexpr std::array<std::string_view, 3> kLabels = {"unchanged", "added", "removed"};
  PointTable points = table();
  points.columns[0].labels = kLabels;
  points.leading_columns = 1;
  CHECK(written(PointFormat::csv, points) == "class,x,y,z,cluster\nunchanged,1,-2.5,3,\nremoved,0.1,1e-07,nan,12\n");
}

TEST_CASE("CSV prints the sum of origin and coordinate in double") {
  PointTable points = table();
  points.columns.clear();
  points.origin_m = {500'000, 5'400'000, 0.5};
  CHECK(written(PointFormat::csv, points) == "x,y,z\n500001,5399997.5,3.5\n500000.1000000015,5400000.0000001,nan\n");
}

TEST_CASE("points as PCD have the golden bytes") {
  PointTable points = table();
  points.origin_m = {1, 2, 3.5};
  points.viewpoint.position_m = {7, 8, 9};
  CHECK(written(PointFormat::pcd, points) ==
        "# .PCD v0.7 - Point Cloud Data file format\n# origin_m 1 2 3.5\nVERSION 0.7\nFIELDS x y z class cluster\n"
        "SIZE 4 4 4 1 4\nTYPE F F F U I\nCOUNT 1 1 1 1 1\nWIDTH 2\nHEIGHT 1\nVIEWPOINT 7 8 9 1 0 0 0\nPOINTS 2\n"
        "DATA binary\n" +
            rows());
}

TEST_CASE("points as PLY have the golden bytes") {
  CHECK(written(PointFormat::ply, table()) ==
        "ply\nformat binary_little_endian 1.0\nelement vertex 2\nproperty float x\nproperty float y\nproperty float z\n"
        "property uchar class\nproperty int cluster\nend_header\n" +
            rows());
}

TEST_CASE("points as bin have the golden bytes") {
  PointTable points = table();
  points.origin_m = {1, 2, 3.5};
  const std::string expected = "RWPB" + bits(std::uint32_t{1}) + bits(std::uint64_t{2}) + bits(1.0) + bits(2.0) +
                               bits(3.5) + bits(std::uint32_t{2}) +
                               "\x01\x05"
                               "class" +
                               "\x02\x07"
                               "cluster" +
                               bits(kX[0]) + bits(kX[1]) + bits(kY[0]) + bits(kY[1]) + bits(kZ[0]) + bits(kZ[1]) +
                               bits(kClass[0]) + bits(kClass[1]) + bits(kCluster[0]) + bits(kCluster[1]);
  CHECK(written(PointFormat::bin, points) == expected);
}

TEST_CASE("a table without points is written as such") {
  CHECK(written(PointFormat::csv, {.x_m = {}, .y_m = {}, .z_m = {}}) == "x,y,z\n");
  CHECK(contains(written(PointFormat::pcd, {.x_m = {}, .y_m = {}, .z_m = {}}), "POINTS 0"));
}

TEST_CASE("a stream that fails is an error of the store") {
  std::ostringstream out;
  out.setstate(std::ios::badbit);
  CHECK_THROWS_AS(write_points(out, PointFormat::csv, table()), StorageError);
}

TEST_CASE("names of point formats are parsed strictly and have media types") {
  CHECK(parse_point_format("ply") == PointFormat::ply);
  CHECK(parse_point_format("bin") == PointFormat::bin);
  CHECK_THROWS_WITH_AS(parse_point_format("las"), doctest::Contains("known are pcd, ply, csv, bin and q16"),
                       InvalidInput);
  CHECK(media_type(PointFormat::csv) == "text/csv; charset=utf-8");
  CHECK(media_type(PointFormat::bin) == "application/octet-stream");
}

TEST_CASE("a scan written as PCD is read back bit for bit, whatever its floats are") {
  CHECK(rc::check([] {
    const PointCloud cloud = any_cloud();
    std::ostringstream out;
    write_scan_pcd(out, cloud, Pose{.position_m = {1, 2, 3}});
    const DecodedScan scan = decode(out.str())[0];
    RC_ASSERT(same_bits(scan.points, cloud));
    RC_ASSERT(scan.world_from_sensor->position_m == Eigen::Vector3d(1, 2, 3));
  }));
}

TEST_CASE("the pose of a scan written as PCD is read back to the last digits") {
  CHECK(rc::check([] {
    const auto number = [] { return *rc::gen::inRange(-1'000'000'000, 1'000'000'000) / 7e3; };
    const Eigen::Vector3d position_m(number(), number(), number());
    const Eigen::Vector4d direction(number(), number(), number(), number() + 1e-3);
    const Pose pose{.orientation = Eigen::Quaterniond(direction).normalized(), .position_m = position_m};
    PointCloud cloud;
    cloud.push_back(1, 2, 3);
    std::ostringstream out;
    write_scan_pcd(out, cloud, pose);
    const Pose read = decode(out.str())[0].world_from_sensor.value_or(Pose{});
    RC_ASSERT(read.position_m == position_m);
    RC_ASSERT((read.orientation.coeffs() - pose.orientation.coeffs()).norm() < 1e-15);
  }));
}

TEST_CASE("points written as CSV and PLY are read back as the same floats") {
  CHECK(rc::check([] {
    PointCloud cloud = any_cloud();
    cloud.grid.reset();
    const auto with_bits_of_nan_dropped = [](std::vector<float>& plane) {
      for (float& value : plane) value = std::isnan(value) ? kNan : value;
    };
    for (auto* plane : {&cloud.x_m, &cloud.y_m, &cloud.z_m, &cloud.intensity}) with_bits_of_nan_dropped(*plane);
    PointTable points{.x_m = cloud.x_m, .y_m = cloud.y_m, .z_m = cloud.z_m};
    if (!cloud.intensity.empty()) points.columns = {{"intensity", std::span<const float>(cloud.intensity)}};
    RC_ASSERT(same_bits(decode(written(PointFormat::csv, points))[0].points, cloud));
    RC_ASSERT(same_bits(decode(written(PointFormat::ply, points))[0].points, cloud));
  }));
}
