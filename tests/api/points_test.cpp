#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <fstream>
#include <limits>
#include <set>
#include <sstream>

#include "storage/formats/scan_file.hpp"
#include "tests/api/api_fixture.hpp"

namespace raywatch::testing {
namespace {

using nlohmann::json;

std::string points_target(const json& scan) { return "/api/v1/scans/" + scan["id"].dump() + "/points"; }

DecodedScan decode(const std::string& bytes, const std::string& name) {
  const TempDir folder;
  std::ofstream(folder / name, std::ios::binary) << bytes;
  return read_scan_file(folder / name).at(0);
}

/// "bin" as the contract describes it, without columns.
struct BinPoints {
  std::uint64_t count = 0;
  std::array<double, 3> origin_m{};
  std::vector<std::string> columns;
  std::vector<float> x_m, y_m, z_m;
};

template <class T>
T take(const std::string& bytes, std::size_t& at) {
  T value{};
  REQUIRE_LE(at + sizeof(T), bytes.size());
  std::memcpy(&value, bytes.data() + at, sizeof(T));
  at += sizeof(T);
  return value;
}

BinPoints decode_bin(const std::string& bytes) {
  REQUIRE(bytes.starts_with("RWPB"));
  std::size_t at = 4;
  CHECK_EQ(take<std::uint32_t>(bytes, at), 1);
  BinPoints points;
  points.count = take<std::uint64_t>(bytes, at);
  for (double& coordinate : points.origin_m) coordinate = take<double>(bytes, at);
  const auto columns = take<std::uint32_t>(bytes, at);
  for (std::uint32_t i = 0; i < columns; ++i) {
    take<std::uint8_t>(bytes, at);
    const auto length = take<std::uint8_t>(bytes, at);
    points.columns.push_back(bytes.substr(at, length));
    at += length;
  }
  for (auto* plane : {&points.x_m, &points.y_m, &points.z_m})
    for (std::uint64_t i = 0; i < points.count; ++i) plane->push_back(take<float>(bytes, at));
  return points;
}

/// "q16" as the contract describes it.
struct QuantisedPoints {
  std::uint64_t count = 0, total = 0, first = 0;
  std::array<double, 3> origin_m{}, step_m{};
  std::string records;  ///< eight bytes a point
};

QuantisedPoints decode_q16(const std::string& bytes) {
  REQUIRE(bytes.starts_with("RWPQ"));
  std::size_t at = 4;
  CHECK_EQ(take<std::uint32_t>(bytes, at), 1);
  QuantisedPoints points;
  for (auto* number : {&points.count, &points.total, &points.first}) *number = take<std::uint64_t>(bytes, at);
  for (double& value : points.origin_m) value = take<double>(bytes, at);
  for (double& value : points.step_m) value = take<double>(bytes, at);
  points.records = bytes.substr(at + 16);
  CHECK_EQ(points.records.size(), points.count * 8);
  return points;
}

std::vector<std::vector<std::string>> rows_of(const std::string& csv) {
  std::vector<std::vector<std::string>> rows;
  std::istringstream lines(csv);
  for (std::string line; std::getline(lines, line);) {
    std::vector<std::string> cells;
    std::istringstream text(line);
    for (std::string cell; std::getline(text, cell, ',');) cells.push_back(cell);
    rows.push_back(cells);
  }
  return rows;
}

TEST_CASE("the points of a scan come back bit-exact as a PCD that can be uploaded again") {
  ApiFixture api;
  api.make_site_and_sensor();
  const WallScene scene{.box = true, .intensity = true};
  const std::string target = points_target(api.upload(0, scene));
  const Reply reply = api.get(target);
  REQUIRE_EQ(reply.status, 200);
  const DecodedScan decoded = decode(reply.body, "scan.pcd");
  const PointCloud sent = wall_points(scene);
  CHECK_EQ(decoded.points.x_m, sent.x_m);
  CHECK_EQ(decoded.points.y_m, sent.y_m);
  CHECK_EQ(decoded.points.z_m, sent.z_m);
  CHECK_EQ(decoded.points.intensity, sent.intensity);
  REQUIRE(decoded.world_from_sensor);
  CHECK_EQ(decoded.world_from_sensor->position_m, wall_pose().position_m);
  CHECK_EQ(api.upload_bytes(reply.body, "sensor=gate&captured_at=2026-03-01T09:00:00Z").status, 201);
}

TEST_CASE("all formats hold the same points") {
  ApiFixture api;
  api.make_site_and_sensor();
  const std::string target = points_target(api.upload(0, {.intensity = true}));
  const PointCloud sent = wall_points({});
  const DecodedScan ply = decode(api.get(target + "?format=ply").body, "scan.ply");
  CHECK_EQ(ply.points.x_m, sent.x_m);
  CHECK_EQ(ply.points.z_m, sent.z_m);
  const BinPoints bin = decode_bin(api.get(target + "?format=bin").body);
  CHECK_EQ(bin.columns, std::vector<std::string>{"intensity"});
  CHECK_EQ(bin.x_m, sent.x_m);
  CHECK_EQ(bin.y_m, sent.y_m);
  CHECK_EQ(bin.z_m, sent.z_m);
  const auto csv = rows_of(api.get(target + "?format=csv").body);
  REQUIRE_EQ(csv.size(), sent.size() + 1);
  CHECK_EQ(csv[0], std::vector<std::string>{"x", "y", "z", "intensity"});
  for (std::size_t i = 0; i < sent.size(); i += 97) CHECK_EQ(std::stof(csv[i + 1][1]), sent.y_m[i]);
}

TEST_CASE("in the world frame the points stand where they are, with the site's origin added in double") {
  ApiFixture api;
  api.post("/api/v1/sites", {{"name", "yard"}, {"origin_m", {423000.0, 5462000.0, 200.0}}});
  api.post("/api/v1/sensors", {{"name", "gate"}, {"site", "yard"}});
  // A quarter turn to the left: the sensor's x is the world's y.
  const Reply reply =
      api.upload_bytes("1 0 0\n0 2 0\n0 0 3\n",
                       "format=xyz&sensor=gate&captured_at=2026-03-01T08:00:00Z&pose=423010.25,5462020.5,201,"
                       "0,0,0.7071067811865476,0.7071067811865476");
  REQUIRE_EQ(reply.status, 201);
  const std::string target = points_target(reply.json());
  const auto csv = rows_of(api.get(target + "?frame=world&format=csv").body);
  REQUIRE_EQ(csv.size(), 4);
  const double expected[3][3] = {
      {423010.25, 5462021.5, 201.0}, {423008.25, 5462020.5, 201.0}, {423010.25, 5462020.5, 204.0}};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t k = 0; k < 3; ++k)
      CHECK(std::stod(csv[i + 1][k]) == doctest::Approx(expected[i][k]).epsilon(1e-12));
  const BinPoints bin = decode_bin(api.get(target + "?frame=world&format=bin").body);
  CHECK_EQ(bin.origin_m, std::array<double, 3>{423000.0, 5462000.0, 200.0});
  CHECK_EQ(bin.x_m[0], doctest::Approx(10.25));
}

TEST_CASE("thinning keeps one measured point a voxel") {
  ApiFixture api;
  api.make_site_and_sensor();
  const std::string target = points_target(api.upload(0));
  const BinPoints all = decode_bin(api.get(target + "?format=bin").body);
  const BinPoints thin = decode_bin(api.get(target + "?format=bin&voxel_m=1").body);
  CHECK_GT(thin.count, 0);
  CHECK_LT(thin.count, all.count / 10);
  std::set<std::array<double, 3>> voxels;
  for (std::size_t i = 0; i < thin.count; ++i) {
    voxels.insert({std::floor(thin.x_m[i]), std::floor(thin.y_m[i]), std::floor(thin.z_m[i])});
    const auto found = std::find(all.y_m.begin(), all.y_m.end(), thin.y_m[i]);
    CHECK(found != all.y_m.end());
  }
  CHECK_EQ(voxels.size(), thin.count);
  CHECK_EQ(api.get(target + "?format=bin&voxel_m=1").body, api.get(target + "?format=bin&voxel_m=1").body);
  for (const char* wrong : {"0", "-1", "nan", "inf", "1e9", "wide"}) {
    CHECK_EQ(api.get(target + "?voxel_m=" + wrong).status, 422);
  }
}

TEST_CASE("a budget thins evenly, and what is asked for later adds to it") {
  ApiFixture api;
  api.make_site_and_sensor();
  const std::string target = points_target(api.upload(0)) + "?format=q16";
  const QuantisedPoints all = decode_q16(api.get(target).body);
  CHECK_EQ(all.count, wall_points({}).size());
  const QuantisedPoints some = decode_q16(api.get(target + "&budget=100").body);
  const QuantisedPoints more = decode_q16(api.get(target + "&budget=150&skip=100").body);
  CHECK_EQ(some.count, 100);
  CHECK_EQ(more.count, 150);
  CHECK_EQ(more.first, 100);
  CHECK_EQ(more.total, all.count);
  CHECK_EQ(some.origin_m, all.origin_m);
  CHECK_EQ(more.step_m, all.step_m);
  CHECK_EQ(some.records + more.records, all.records.substr(0, 250 * 8));
  CHECK_EQ(decode_q16(api.get(target + "&skip=1000000000").body).count, 0);
  // Other formats keep their exact coordinates.
  const BinPoints exact = decode_bin(api.get(points_target(api.upload(1)) + "?format=bin&budget=100").body);
  CHECK_EQ(exact.count, 100);
  CHECK_LE(std::abs(exact.y_m[0] - static_cast<float>(some.origin_m[1])), some.step_m[1] * 65535.0);
}

TEST_CASE("a budget that is none is refused by name") {
  ApiFixture api;
  api.make_site_and_sensor();
  const std::string target = points_target(api.upload(0)) + "?format=q16";
  for (const char* wrong : {"0", "-1", "many", "10000001", "1e3", "99999999999999999999"}) {
    CHECK_NE(api.get(target + "&budget=" + wrong).complaint_about("budget"), "");
  }
  for (const char* wrong : {"-1", "4294967296", ""}) {
    CHECK_NE(api.get(target + "&skip=" + wrong).complaint_about("skip"), "");
  }
  CHECK_NE(api.get(points_target(api.upload(1)) + "?format=csv&skip=5").complaint_about("skip"), "");
}

TEST_CASE("points that are not finite keep their places in the raw observation") {
  ApiFixture api;
  api.make_site_and_sensor();
  PointCloud points = wall_points({});
  points.x_m[7] = points.y_m[7] = points.z_m[7] = std::numeric_limits<float>::quiet_NaN();
  const json scan =
      api.upload_bytes(pcd_of(points, wall_pose()), "sensor=gate&captured_at=2026-03-01T08:00:00Z").json();
  for (const std::string query : {"?format=bin", "?format=bin&frame=world"}) {
    const BinPoints bin = decode_bin(api.get(points_target(scan) + query).body);
    REQUIRE_EQ(bin.count, points.size());
    CHECK(std::isnan(bin.x_m[7]));
    CHECK(std::isfinite(bin.x_m[8]));
  }
}

TEST_CASE("points are tagged by what they are and how they were asked for") {
  ApiFixture api;
  api.make_site_and_sensor();
  const std::string target = points_target(api.upload(0));
  std::set<std::string> tags;
  const std::vector<std::string> queries = {"?format=pcd",           "?format=csv",           "?format=csv&frame=world",
                                            "?format=csv&voxel_m=1", "?format=csv&voxel_m=2", "?format=q16",
                                            "?format=q16&budget=9",  "?format=q16&skip=9"};
  for (const std::string& query : queries) {
    const Reply reply = api.get(target + query);
    tags.insert(reply.header("ETag"));
    const Reply cached = api.get(target + query, {{"If-None-Match", "\"x\", " + reply.header("ETag")}});
    CHECK_EQ(cached.status, 304);
    CHECK_EQ(cached.body, "");
  }
  CHECK_EQ(tags.size(), queries.size());
}

TEST_CASE("a frame or format that is none is refused by name") {
  ApiFixture api;
  api.make_site_and_sensor();
  const std::string target = points_target(api.upload(0));
  CHECK_NE(api.get(target + "?frame=moon").complaint_about("frame"), "");
  CHECK_NE(api.get(target + "?format=las").complaint_about("format"), "");
}

}  // namespace
}  // namespace raywatch::testing
