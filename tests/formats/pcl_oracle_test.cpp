#include <doctest/doctest.h>
#include <pcl/io/pcd_io.h>
#include <pcl/io/ply_io.h>
#include <pcl/point_types.h>

#include <filesystem>
#include <fstream>

#include "storage/formats/write.hpp"
#include "tests/formats/sample_files.hpp"
#include "tests/support/temp_dir.hpp"

using namespace raywatch;
using namespace raywatch::test;

namespace {

pcl::PointCloud<pcl::PointXYZI> pcl_cloud(std::uint32_t width, std::uint32_t height) {
  pcl::PointCloud<pcl::PointXYZI> cloud(width, height);
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const auto v = static_cast<float>(i);
    cloud[i].x = 0.1F * v;
    cloud[i].y = -1.0F / (v + 1.0F);
    cloud[i].z = 1e-3F * v * v;
    cloud[i].intensity = 100.0F - v;
  }
  cloud.sensor_origin_ = {1.5F, -2.0F, 0.25F, 0.0F};
  cloud.sensor_orientation_ = Eigen::Quaternionf(0.0F, 0.0F, 0.0F, 1.0F);
  return cloud;
}

void check_same(const PointCloud& ours, const pcl::PointCloud<pcl::PointXYZI>& theirs) {
  REQUIRE(ours.size() == theirs.size());
  REQUIRE(ours.intensity.size() == theirs.size());
  for (std::size_t i = 0; i < theirs.size(); ++i) {
    CHECK(ours.x_m[i] == theirs[i].x);
    CHECK(ours.y_m[i] == theirs[i].y);
    CHECK(ours.z_m[i] == theirs[i].z);
    CHECK(ours.intensity[i] == theirs[i].intensity);
  }
}

PointCloud our_cloud() {
  PointCloud cloud;
  for (int i = 0; i < 12; ++i) {
    const auto v = static_cast<float>(i);
    cloud.push_back(v / 3.0F, -v, 0.7F * v);
    cloud.intensity.push_back(v * 0.01F);
  }
  cloud.grid = ShotGrid{.rows = 3, .columns = 4};
  return cloud;
}

}  // namespace

TEST_CASE("what PCL writes as PCD, in each of its three encodings, reads as the same scan") {
  const TempDir folder;
  const auto cloud = pcl_cloud(25, 4);
  pcl::PCDWriter writer;
  writer.writeASCII((folder.path() / "ascii.pcd").string(), cloud, 9);
  writer.writeBinary((folder.path() / "binary.pcd").string(), cloud);
  writer.writeBinaryCompressed((folder.path() / "compressed.pcd").string(), cloud);
  for (const char* name : {"ascii.pcd", "binary.pcd", "compressed.pcd"}) {
    CAPTURE(name);
    const DecodedScan scan = read_scan_file(folder.path() / name)[0];
    check_same(scan.points, cloud);
    CHECK(scan.points.grid == ShotGrid{.rows = 4, .columns = 25});
    REQUIRE(scan.world_from_sensor);
    CHECK(scan.world_from_sensor->position_m == Eigen::Vector3d(1.5, -2.0, 0.25));
    CHECK(scan.world_from_sensor->orientation.z() == 1.0);
  }
}

TEST_CASE("what PCL writes as PLY, ascii and binary, reads as the same points") {
  const TempDir folder;
  const auto cloud = pcl_cloud(25, 4);
  pcl::PLYWriter writer;
  writer.write((folder.path() / "ascii.ply").string(), cloud, false, true);
  writer.write((folder.path() / "binary.ply").string(), cloud, true, true);
  for (const char* name : {"ascii.ply", "binary.ply"}) {
    CAPTURE(name);
    const PointCloud ours = read_scan_file(folder.path() / name)[0].points;
    REQUIRE(ours.size() == cloud.size());
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      CHECK(ours.x_m[i] == doctest::Approx(cloud[i].x));  // its ascii form has 8 digits
      CHECK(ours.intensity[i] == doctest::Approx(cloud[i].intensity));
    }
  }
}

TEST_CASE("PCL reads the scan that we write as PCD") {
  const TempDir folder;
  const PointCloud ours = our_cloud();
  const Pose pose{.orientation = Eigen::Quaterniond(0, 1, 0, 0), .position_m = {10, 20, 30}};
  std::ofstream out(folder.path() / "ours.pcd", std::ios::binary);
  write_scan_pcd(out, ours, pose);
  out.close();
  pcl::PointCloud<pcl::PointXYZI> theirs;
  REQUIRE(pcl::io::loadPCDFile((folder.path() / "ours.pcd").string(), theirs) == 0);
  check_same(ours, theirs);
  CHECK(theirs.width == 4);
  CHECK(theirs.height == 3);
  CHECK(theirs.sensor_origin_.head<3>() == Eigen::Vector3f(10, 20, 30));
  CHECK(theirs.sensor_orientation_.x() == 1.0F);
}

TEST_CASE("PCL reads the points that we write as PCD and PLY") {
  const TempDir folder;
  const PointCloud ours = our_cloud();
  const PointTable table{.x_m = ours.x_m,
                         .y_m = ours.y_m,
                         .z_m = ours.z_m,
                         .columns = {{"intensity", std::span<const float>(ours.intensity)}}};
  std::ofstream pcd(folder.path() / "ours.pcd", std::ios::binary);
  write_points(pcd, PointFormat::pcd, table);
  pcd.close();
  std::ofstream ply(folder.path() / "ours.ply", std::ios::binary);
  write_points(ply, PointFormat::ply, table);
  ply.close();
  pcl::PointCloud<pcl::PointXYZI> theirs;
  REQUIRE(pcl::io::loadPCDFile((folder.path() / "ours.pcd").string(), theirs) == 0);
  check_same(ours, theirs);
  REQUIRE(pcl::io::loadPLYFile((folder.path() / "ours.ply").string(), theirs) == 0);
  check_same(ours, theirs);
}
