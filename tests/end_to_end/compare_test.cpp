#include <doctest/doctest.h>

#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <vector>

#include "storage/formats/side_car.hpp"
#include "tests/end_to_end/place.hpp"
#include "tests/end_to_end/process.hpp"
#include "tests/support/temp_dir.hpp"

using namespace raywatch::test;
using nlohmann::json;

namespace {

/// Two scans of the place, the box only in the later one.
struct Pair {
  raywatch::TempDir folder;
  PlaceScan before = scan_place({}, 0), after = scan_place({.box = true}, 1);
  std::string before_file = before.write(folder.path(), "before").string();
  std::string after_file = after.write(folder.path(), "after").string();

  std::string path(const char* name) const { return (folder.path() / name).string(); }
};

std::vector<std::string> read_lines(const std::string& file) {
  std::ifstream in(file);
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

std::string content_of(const std::string& file) {
  std::ostringstream content;
  content << std::ifstream(file, std::ios::binary).rdbuf();
  return content.str();
}

std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells(1);
  for (const char c : line) c == ',' ? cells.emplace_back() : cells.back() += c, void();
  return cells;
}

json compare(const std::vector<std::string>& arguments) {
  std::vector<std::string> all = {"compare"};
  all.insert(all.end(), arguments.begin(), arguments.end());
  const Ended ended = run_raywatch(all);
  REQUIRE_MESSAGE(ended.exit_code == 0, ended.err);
  CHECK(ended.err == "");
  return json::parse(ended.out);
}

}  // namespace

TEST_CASE("compare prints counts, changes and disjoint timings as one JSON object") {
  const Pair pair;
  const json result = compare({pair.after_file, "--against", pair.before_file});

  CHECK(result["counts"]["added"] == kBoxPoints);
  CHECK(result["counts"]["removed"] == 0);
  std::size_t of_scan = 0;
  for (const char* name : {"unchanged", "added", "discrepancy", "occluded", "unseen", "invalid"}) {
    of_scan += result["counts"][name].get<std::size_t>();
  }
  CHECK(of_scan == pair.after.points.size());

  REQUIRE(result["changes"].size() == 1);
  CHECK(result["changes"][0]["kind"] == "added");
  CHECK(result["changes"][0]["points"] == kBoxPoints);
  CHECK(result["changes"][0]["centroid_m"][0] == doctest::Approx(kBoxFaceCenter_m.x()).epsilon(0.002));

  double sum_ms = 0.0;
  for (const char* step : {"read", "index", "align", "detect", "cluster", "write"}) {
    REQUIRE(result["timings_ms"].contains(step));
    sum_ms += result["timings_ms"][step].get<double>();
  }
  CHECK(sum_ms <= result["timings_ms"]["total"].get<double>());
}

TEST_CASE("a prior that stands a little elsewhere is put right, unless poses are to be taken as given") {
  const Pair pair;
  PlaceScan shifted = scan_place({}, 2);
  shifted.world_from_sensor.position_m.x() += 0.05;
  const std::string shifted_file = shifted.write(pair.folder.path(), "shifted").string();
  const json aligned = compare({pair.before_file, "--against", shifted_file})["priors"][0]["registration"];
  CHECK(aligned["state"] == "good");
  CHECK(aligned["correction"]["position_m"][0] == doctest::Approx(-0.05).epsilon(0.02));
  CHECK(aligned["shift_m"] == doctest::Approx(0.05).epsilon(0.02));
  CHECK(aligned["residual_m"].get<double>() < 0.005);
  CHECK(aligned["uncertainty"]["position_m"].get<double>() > 0.0);
  CHECK(compare({pair.before_file, "--against", shifted_file, "--no-align"})["priors"][0]["registration"].is_null());
}

TEST_CASE("what went away is removed, with the index of each point in its file") {
  const Pair pair;
  const std::string removed_file = pair.path("removed.csv");
  const PlaceScan later = scan_place({}, 2);
  const std::string later_file = later.write(pair.folder.path(), "later").string();
  const json result = compare({later_file, "--against", pair.before_file, "--against", pair.after_file, "--no-align",
                               "--removed-output", removed_file});
  CHECK(result["counts"]["removed"] == kBoxPoints);

  const std::vector<std::string> lines = read_lines(removed_file);
  REQUIRE(lines.size() == 1 + kBoxPoints);
  CHECK(lines[0] == "prior,index,x,y,z,cluster");
  for (std::size_t i = 1; i < lines.size(); ++i) {
    const std::vector<std::string> cells = cells_of(lines[i]);
    REQUIRE(cells.size() == 6);
    CHECK(cells[0] == "1");
    const std::size_t index = std::stoul(cells[1]);
    CHECK(std::stof(cells[2]) == pair.after.points.x_m[index]);
    CHECK(std::stof(cells[2]) < 5.0F);
    CHECK(cells[5] == "0");
  }
}

TEST_CASE("the CSV has a row for every input point, in the input's order") {
  const Pair pair;
  const std::string csv = pair.path("classes.csv");
  const json result = compare({pair.after_file, "--against", pair.before_file, "--output", csv});
  const std::vector<std::string> lines = read_lines(csv);
  REQUIRE(lines.size() == 1 + pair.after.points.size());
  CHECK(lines[0] == "x,y,z,class,free,supported,cluster");
  std::map<std::string, std::size_t> counts;
  for (std::size_t i = 0; i < pair.after.points.size(); ++i) {
    const std::vector<std::string> cells = cells_of(lines[i + 1]);
    REQUIRE(cells.size() == 7);
    CHECK(std::stof(cells[0]) == pair.after.points.x_m[i]);
    CHECK(std::stof(cells[1]) == pair.after.points.y_m[i]);
    ++counts[cells[3]];
    CHECK((cells[3] == "added") == (cells[6] == "0"));
    if (cells[3] == "added") CHECK(cells[4] == "1");
  }
  for (const auto& [name, count] : counts) CHECK(result["counts"][name] == count);
}

TEST_CASE("the result is the same, byte for byte, with one thread and with eight") {
  const Pair pair;
  json results[2];
  std::string files[2];
  for (const int i : {0, 1}) {
    const std::string csv = pair.path(i == 0 ? "one.csv" : "eight.csv");
    results[i] =
        compare({pair.after_file, "--against", pair.before_file, "--threads", i == 0 ? "1" : "8", "--output", csv});
    results[i].erase("timings_ms");
    files[i] = content_of(csv);
  }
  CHECK(results[0] == results[1]);
  CHECK(files[0] == files[1]);
}

TEST_CASE("without clusters every changed point counts") {
  const Pair pair;
  const json result = compare({pair.after_file, "--against", pair.before_file, "--grouping", "union", "--no-cluster"});
  CHECK(result["changes"].empty());
  CHECK(result["counts"]["added"].get<std::size_t>() >= kBoxPoints);
  CHECK(result["parameters"]["grouping"] == "union");
}

TEST_CASE("a cluster is kept only with more points than the least number") {
  const Pair pair;
  const auto added = [&](std::size_t least) {
    return compare({pair.after_file, "--against", pair.before_file, "--cluster-min-points",
                    std::to_string(least)})["counts"]["added"];
  };
  CHECK(added(kBoxPoints - 1) == kBoxPoints);
  CHECK(added(kBoxPoints) == 0);
}

TEST_CASE("map coordinates lose no precision") {
  const Pair pair;
  const Eigen::Vector3d far_m(32'500'000.25, 5'500'000.5, 400.125);
  std::string files[2];
  const PlaceScan* scans[2] = {&pair.before, &pair.after};
  for (const int i : {0, 1}) {
    PlaceScan moved = *scans[i];
    moved.world_from_sensor.position_m += far_m;
    files[i] = moved.write(pair.folder.path(), i == 0 ? "far_before" : "far_after").string();
  }
  const std::string csv = pair.path("far.csv");
  const json near = compare({pair.after_file, "--against", pair.before_file});
  const json far = compare({files[1], "--against", files[0], "--output", csv});
  CHECK(far["counts"] == near["counts"]);
  for (const int axis : {0, 1, 2}) {
    const double shift_m =
        far["changes"][0]["centroid_m"][axis].get<double>() - near["changes"][0]["centroid_m"][axis].get<double>();
    CHECK(std::abs(shift_m - far_m[axis]) < 1e-5);
  }
  const std::vector<std::string> first = cells_of(read_lines(csv)[1]);
  CHECK(std::abs(std::stod(first[0]) - far_m.x() - static_cast<double>(pair.after.points.x_m[0])) < 1e-5);
}

TEST_CASE("without times the compared scan is the later one") {
  const Pair pair;
  for (const PlaceScan* scan : {&pair.before, &pair.after}) {
    const std::string file = scan == &pair.before ? pair.before_file : pair.after_file;
    raywatch::write_side_car(file, {.pose = scan->world_from_sensor});
  }
  CHECK(compare({pair.after_file, "--against", pair.before_file})["counts"]["added"] == kBoxPoints);
}

TEST_CASE("scans of one moment disagree instead of changing") {
  const Pair pair;
  const json result = compare({pair.after_file, "--against", pair.before_file, "--contemporary-s", "60"});
  CHECK(result["counts"]["added"] == 0);
  CHECK(result["counts"]["discrepancy"].get<std::size_t>() >= kBoxPoints);
}

TEST_CASE("a file without a pose is refused, and it is said how to give one") {
  const Pair pair;
  std::filesystem::remove(pair.before_file + ".json");
  const Ended ended = run_raywatch({"compare", pair.after_file, "--against", pair.before_file});
  CHECK(ended.exit_code == 2);
  CHECK(ended.out == "");
  CHECK(ended.err.find("before.pcd.json") != std::string::npos);
  CHECK(ended.err.find("position_m") != std::string::npos);
}

TEST_CASE("an output that is one of the scans, or is given twice, is refused, and nothing is written") {
  const Pair pair;
  const std::string before = content_of(pair.before_file), after = content_of(pair.after_file);
  std::filesystem::create_symlink(pair.before_file, pair.path("link.pcd"));
  std::filesystem::create_hard_link(pair.after_file, pair.path("hard.pcd"));
  const std::string in_detour = pair.path("./before.pcd"), csv = pair.path("same.csv");
  for (const std::string& output :
       {pair.before_file, pair.after_file, in_detour, pair.path("link.pcd"), pair.path("hard.pcd")}) {
    CAPTURE(output);
    for (const char* option : {"--output", "--removed-output"}) {
      const Ended ended = run_raywatch({"compare", pair.after_file, "--against", pair.before_file, option, output});
      CHECK(ended.exit_code == 2);
      CHECK(ended.err.find(output + ": is one of the scans") != std::string::npos);
    }
  }
  const Ended twice = run_raywatch({"compare", pair.after_file, "--against", pair.before_file, "--output", csv,
                                    "--removed-output", pair.path("./same.csv")});
  CHECK(twice.exit_code == 2);
  CHECK(twice.err.find("is given twice") != std::string::npos);
  CHECK_FALSE(std::filesystem::exists(csv));
  CHECK(content_of(pair.before_file) == before);
  CHECK(content_of(pair.after_file) == after);
}

TEST_CASE("a number out of its bounds, or none, is refused with its option and what is allowed") {
  const Pair pair;
  const auto refused = [&](const char* option, const char* value) {
    const Ended ended = run_raywatch({"compare", pair.after_file, "--against", pair.before_file, option, value});
    CHECK(ended.exit_code == 2);
    CHECK(ended.out == "");
    return ended.err;
  };
  for (const char* option :
       {"--angle-deg", "--range-m", "--support-distance-m", "--growth-distance-m", "--foliage-distance-m",
        "--cluster-distance-m", "--min-range-m", "--max-range-m", "--contemporary-s"}) {
    CAPTURE(option);
    for (const char* value : {"nan", "inf", "-1", "1e30", "one", ""}) {
      CHECK(refused(option, value).find(option) != std::string::npos);
    }
  }
  for (const char* option : {"--cluster-min-points", "--threads"}) {
    CAPTURE(option);
    for (const char* value : {"-1", "1.5", "nan", "010", "18446744073709551615"}) {
      CHECK(refused(option, value).find(option) != std::string::npos);
    }
  }
  CHECK(refused("--cluster-min-points", "-1").find("must be at least 0") != std::string::npos);
  const Ended crossed = run_raywatch(
      {"compare", pair.after_file, "--against", pair.before_file, "--min-range-m", "10", "--max-range-m", "1"});
  CHECK(crossed.exit_code == 2);
  CHECK(crossed.err.find("max_range_m must be above min_range_m") != std::string::npos);
}

TEST_CASE("what is wrong with a file is said with its name, and is wrong input") {
  const Pair pair;
  const auto refused = [&](const std::string& name, const std::string& content) {
    const std::string file = pair.path(name.c_str());
    std::ofstream(file, std::ios::binary) << content;
    const Ended ended = run_raywatch({"compare", pair.after_file, "--against", file});
    CHECK(ended.exit_code == 2);
    CHECK(ended.err.find(file + ": ") != std::string::npos);
    return ended.err;
  };
  CHECK(refused("empty.pcd", "").find("the file is empty") != std::string::npos);
  CHECK(refused("prose.doc", "It was a dark and stormy night.").find("format") != std::string::npos);
  CHECK(refused("broken.pcd", pair.before.pcd().substr(0, 400)).find("broken.pcd: ") != std::string::npos);
  for (const std::string& file : {pair.path("absent.pcd"), pair.folder.path().string()}) {
    const Ended ended = run_raywatch({"compare", pair.after_file, "--against", file});
    CHECK(ended.exit_code == 2);
    CHECK(ended.err.find(file) != std::string::npos);
  }
  std::ofstream(pair.before_file + ".json") << R"({"captured_at": 7})";
  const Ended ended = run_raywatch({"compare", pair.after_file, "--against", pair.before_file});
  CHECK(ended.err == "raywatch: " + pair.before_file + ".json: captured_at: must be a string\n");
}

TEST_CASE("wrong arguments and files are refused before anything is written") {
  const Pair pair;
  const std::string txt = pair.path("out.txt");
  CHECK(run_raywatch({"compare", pair.after_file}).exit_code == 2);
  CHECK(run_raywatch({"compare", pair.after_file, "--against", pair.before_file, "--grouping", "best"}).exit_code == 2);
  CHECK(run_raywatch({"compare", pair.after_file, "--against", pair.before_file, "--output", txt}).exit_code == 2);
  CHECK_FALSE(std::filesystem::exists(txt));
}

TEST_CASE("PCD and PLY outputs hold every point with its class") {
  const Pair pair;
  for (const char* name : {"classes.pcd", "classes.ply"}) {
    compare({pair.after_file, "--against", pair.before_file, "--output", pair.path(name)});
    // x, y, z as float, two counts and a class of a byte each, a cluster of four bytes.
    CHECK(std::filesystem::file_size(pair.path(name)) > pair.after.points.size() * (12 + 3 + 4));
  }
}
