#include "tests/evaluate/place.hpp"

#include <doctest/doctest.h>

#include <fstream>

#include "core/error.hpp"
#include "tests/evaluate/table.hpp"
#include "tests/simulator/scene_folder.hpp"
#include "tests/support/temp_dir.hpp"

using namespace raywatch;
using namespace raywatch::evaluation;
using simulator::Family;

namespace {

const simulator::FamilyOptions kTiny{.seed = 8, .density = 0.02, .scans = 6};

void write_folder(const std::filesystem::path& path) {
  const simulator::Timeline timeline = make_timeline(Family::lab, kTiny);
  simulator::SceneFolder folder(path);
  for (std::size_t i = 0; i < timeline.moments.size(); ++i) {
    folder.add("scan_" + std::to_string(i), take_scan(timeline, timeline.moments[i]));
  }
  folder.write_manifest(Family::lab, kTiny, timeline);
}

std::string refusal_of(const std::filesystem::path& folder) {
  try {
    read_place(folder);
  } catch (const InvalidInput& error) {
    return error.what();
  }
  return "";
}

/// Everything that is printed but the timings.
std::vector<Counts> points_of(const std::vector<TableRow>& rows) {
  std::vector<Counts> points;
  for (const TableRow& row : rows) points.push_back(row.points);
  return points;
}

std::vector<TableRow> evaluated(const Place& place) {
  Evaluation evaluation({.profile = Profile::indoor, .grid = {{1.5}, {0.1, 0.3}}, .most_pairs = 3});
  evaluation.add(IndexedPlace(place, Profile::indoor));
  return table_rows(evaluation);
}

}  // namespace

TEST_CASE("a folder holds the same place as the memory, and the same table comes of both") {
  const TempDir scratch;
  write_folder(scratch / "lab");
  const Place read = read_place(scratch / "lab");
  const Place made = simulate_place(Family::lab, kTiny);
  REQUIRE(read.scans.size() == made.scans.size());
  CHECK(read.name == "lab");
  CHECK(read.scans[4].labels == made.scans[4].labels);
  CHECK(read.scans[4].present == made.scans[4].present);
  CHECK(read.states.size() == made.states.size());
  const std::vector<TableRow> rows = evaluated(made);
  CHECK(points_of(evaluated(read)) == points_of(rows));
  REQUIRE(rows.size() == 24);
  CHECK(rows[0].data == "single pairs");
  CHECK(rows[0].method == "union best");
  CHECK(rows[23].data == "several priors");
  CHECK(rows[23].method == "consensus");
}

TEST_CASE("a place in map coordinates gives the same table as at the origin") {
  const TempDir scratch;
  simulator::SceneFolder folder(scratch / "far");
  const simulator::Timeline timeline = make_timeline(Family::lab, kTiny);
  Place near = simulate_place(Family::lab, kTiny);
  for (std::size_t i = 0; i < near.scans.size(); ++i) {
    SimulatedScan far = near.scans[i];
    far.reported_world_from_sensor.position_m += Eigen::Vector3d(400'000.0, 5'600'000.0, 300.0);
    folder.add("scan_" + std::to_string(i), far);
  }
  folder.write_manifest(Family::lab, kTiny, timeline);
  const std::vector<TableRow> far_rows = evaluated(read_place(scratch / "far"));
  const std::vector<TableRow> near_rows = evaluated(near);
  REQUIRE(far_rows.size() == near_rows.size());
  for (std::size_t i = 0; i < far_rows.size(); ++i) {
    CHECK(far_rows[i].points.both().f_score() == doctest::Approx(near_rows[i].points.both().f_score()).epsilon(0.02));
  }
}

TEST_CASE("the best thresholds are at least as good as any other of the grid") {
  const Place place = simulate_place(Family::sim, {.seed = 3, .density = 0.05, .scans = 5});
  const auto best_of = [&](const Grid& grid) {
    Evaluation evaluation({.profile = Profile::outdoor, .grid = grid, .most_pairs = 4});
    evaluation.add(IndexedPlace(place, Profile::indoor));
    return table_rows(evaluation).front().points.both().f_score();
  };
  const double best = best_of({{1.0, 2.0}, {0.05, 1.0}});
  for (const double angle : {1.0, 2.0}) {
    for (const double range_m : {0.05, 1.0}) CHECK(best >= best_of({{angle}, {range_m}}));
  }
}

TEST_CASE("a folder without a manifest, without labels or with too few of them is refused by name") {
  const TempDir scratch;
  CHECK(refusal_of(scratch.path()).find("no readable manifest.json") != std::string::npos);
  const std::filesystem::path folder = scratch / "lab";
  write_folder(folder);
  std::filesystem::resize_file(folder / "scan_2.pcd.labels", 18);
  CHECK(refusal_of(folder).find("scan_2.pcd.labels: the label file ends too early") != std::string::npos);
  std::ofstream(folder / "scan_2.pcd.labels", std::ios::binary) << std::string("RWLB\1\0\0\0\1\0\0\0\0\0\0\0\0\0", 18);
  CHECK(refusal_of(folder).find("scan_2.pcd.labels: has 1 labels for ") != std::string::npos);
  std::filesystem::remove(folder / "scan_2.pcd.labels");
  CHECK(refusal_of(folder).find("scan_2.pcd.labels: missing") != std::string::npos);
}
