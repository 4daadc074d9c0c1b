#include "tests/simulator/scene_folder.hpp"

#include <doctest/doctest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "core/error.hpp"
#include "storage/formats/side_car.hpp"
#include "tests/support/temp_dir.hpp"

using namespace raywatch;
using namespace raywatch::simulator;

TEST_CASE("scans, side-cars, labels and manifest can be read back") {
  const FamilyOptions options{.seed = 8, .hard = true, .density = 0.02, .scans = 2};
  const Timeline timeline = make_timeline(Family::lab, options);
  const SimulatedScan scan = take_scan(timeline, timeline.moments[1]);
  const TempDir scratch;
  SceneFolder folder(scratch / "new" / "place");
  REQUIRE(folder.add("lab_0001", scan) == "lab_0001.pcd");
  folder.write_manifest(Family::lab, options, timeline);

  const std::filesystem::path file = scratch / "new" / "place" / "lab_0001.pcd";
  const ScanHints side_car = read_side_car(file);
  CHECK(side_car.sensor == scan.sensor);
  CHECK(side_car.captured_at == scan.captured_at);
  CHECK(side_car.frame == Frame::sensor);
  REQUIRE(side_car.pose.has_value());
  CHECK(side_car.pose->position_m == scan.reported_world_from_sensor.position_m);

  const std::vector<DecodedScan> read = read_scan_file(file, side_car);
  REQUIRE(read.size() == 1);
  CHECK(read[0].points.x_m == scan.points.x_m);
  CHECK(read[0].points.z_m == scan.points.z_m);

  std::ifstream labels(file.string() + ".labels", std::ios::binary);
  CHECK(read_labels(labels) == scan.labels);

  std::ifstream manifest_file(file.parent_path() / "manifest.json");
  const nlohmann::json manifest = nlohmann::json::parse(manifest_file);
  CHECK(manifest.at("family") == "lab");
  CHECK(manifest.at("seed") == 8);
  REQUIRE(manifest.at("scans").size() == 1);
  CHECK(manifest["scans"][0].at("file") == "lab_0001.pcd");
  CHECK(manifest["scans"][0].at("present") == scan.present);
  CHECK(manifest["scans"][0].at("true_pose") != manifest["scans"][0].at("reported_pose"));
  REQUIRE(manifest.at("objects").size() == 4);
  CHECK(manifest["objects"][0].at("volume_m3").get<double>() == doctest::Approx(0.14 * 0.17 * 0.40));
}

TEST_CASE("labels are a header and little-endian numbers") {
  std::ostringstream out;
  write_labels(out, {0, 258, kNoSurface});
  CHECK(out.str() == std::string("RWLB\1\0\0\0\3\0\0\0\0\0\0\0\0\0\2\1\377\377", 22));
}

TEST_CASE("a label file that is cut short or something else is refused") {
  std::istringstream cut(std::string("RWLB\1\0\0\0\3\0\0\0\0\0\0\0\0\0", 18));
  CHECK_THROWS_AS(read_labels(cut), InvalidInput);
  std::istringstream other("# .PCD v0.7 - Point Cloud Data");
  CHECK_THROWS_AS(read_labels(other), InvalidInput);
}
