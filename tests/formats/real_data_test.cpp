#include <doctest/doctest.h>

#include <cstdlib>
#include <filesystem>
#include <iostream>

#include "core/align.hpp"
#include "storage/formats/scan_file.hpp"
#include "storage/formats/side_car.hpp"

using namespace raywatch;

namespace {

/// The folder of real scans that stands beside a working copy of the project, unless the environment names another.
std::filesystem::path real_data() {
  const char* named = std::getenv("RAYWATCH_REAL_DATA");
  return named != nullptr ? std::filesystem::path(named)
                          : std::filesystem::path(RAYWATCH_SOURCE_DIR).parent_path() / "shared" / "data";
}

bool is_absent(const std::filesystem::path& file) {
  if (std::filesystem::exists(file)) return false;
  std::cout << "skipped: the real scan " << file << " is absent; RAYWATCH_REAL_DATA may name its folder\n";
  return true;
}

}  // namespace

TEST_CASE("the real indoor scans are read with the poses of their side-cars") {
  for (const char* name : {"indoor_0.pcd", "indoor_1.pcd", "indoor_2.pcd"}) {
    const auto file = real_data() / name;
    if (is_absent(file)) return;
    CAPTURE(name);
    const auto scans = read_scan_file(file, read_side_car(file));
    REQUIRE(scans.size() == 1);
    CHECK(scans[0].points.size() == 81'359);
    CHECK(scans[0].world_from_sensor);
    CHECK(scans[0].captured_at);
  }
}

TEST_CASE("the real room scans have no pose, because their VIEWPOINT is an identity") {
  const auto file = real_data() / "room_scan1.pcd";
  if (is_absent(file)) return;
  const auto scans = read_scan_file(file);
  CHECK(scans[0].points.size() == 112'586);
  CHECK_FALSE(scans[0].world_from_sensor);
}

TEST_CASE("the real room scans fit nowhere near their rough poses, and are refused instead of bent") {
  const auto first = real_data() / "room_scan1.pcd", second = real_data() / "room_scan2.pcd";
  if (is_absent(first) || is_absent(second)) return;
  const PointCloud reference = read_scan_file(first).at(0).points, scan = read_scan_file(second).at(0).points;
  const PriorIndex reference_index = PriorIndex::build(reference, {}), index = PriorIndex::build(scan, {});
  const ScanView onto{reference, reference_index, {}, {}, estimate_sensor(reference, reference_index)};
  const Pose rough{Eigen::Quaterniond(Eigen::AngleAxisd(0.6931, Eigen::Vector3d::UnitZ())), {1.79387, 0.720047, 0.0}};
  const ScanView view{scan, index, rough, {}, estimate_sensor(scan, index)};
  CHECK(align(view, {&onto, 1}, {}).state == RegistrationState::bad);
}
