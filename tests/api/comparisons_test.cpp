#include <doctest/doctest.h>

#include <map>
#include <sstream>

#include "tests/api/api_fixture.hpp"

namespace raywatch::testing {
namespace {

using nlohmann::json;

json wait_until_done(ApiFixture& api, const json& comparison) {
  const std::string target = "/api/v1/comparisons/" + comparison["id"].dump();
  for (;;) {
    const json now = api.get(target).json();
    if (now["state"] == "done" || now["state"] == "failed") return now;
  }
}

/// The rows of a CSV by the value of one of its columns.
std::map<std::string, int> count_by(const std::string& csv, const std::string& column) {
  std::istringstream lines(csv);
  std::string line, cell;
  std::getline(lines, line);
  std::istringstream header(line);
  std::size_t place = 0;
  while (std::getline(header, cell, ',') && cell != column) ++place;
  std::map<std::string, int> counts;
  while (std::getline(lines, line)) {
    std::istringstream cells(line);
    for (std::size_t i = 0; i <= place; ++i) {
      cell.clear();
      std::getline(cells, cell, ',');
    }
    ++counts[cell];
  }
  return counts;
}

TEST_CASE("what appears before the wall is added, what goes away is removed") {
  ApiFixture api;
  api.make_site_and_sensor();
  const json empty = api.upload(0);
  const json with_box = api.upload(1, {.box = true});
  const auto n = static_cast<int>(box_points());

  const json appeared = api.get("/api/v1/comparisons/" + with_box["comparison"].dump()).json();
  CHECK_EQ(appeared["state"], "done");
  CHECK_EQ(appeared["progress"], 1.0);
  CHECK_EQ(appeared["scan"], with_box["id"]);
  CHECK_EQ(appeared["reference"], "previous");
  REQUIRE_EQ(appeared["priors"].size(), 1);
  CHECK_EQ(appeared["priors"][0]["scan"], empty["id"]);
  CHECK_EQ(appeared["counts"]["added"], n);
  CHECK_EQ(appeared["counts"]["removed"], 0);
  CHECK_EQ(appeared["changes"], 1);

  const json gone = api.upload(2);
  const json vanished = api.get("/api/v1/comparisons/" + gone["comparison"].dump()).json();
  CHECK_EQ(vanished["counts"]["removed"], n);
  CHECK_EQ(vanished["changes"], 1);
}

TEST_CASE("what a comparison takes when it is not told can be read before") {
  ApiFixture api;
  api.make_site_and_sensor();
  const json scan = api.upload(0);
  for (const std::string grouping : {"consensus", "union"}) {
    const json defaults = api.get("/api/v1/sites/yard/parameters?grouping=" + grouping).json();
    const json asked = {{"scan", scan["id"]}, {"parameters", {{"grouping", grouping}}}};
    CHECK_EQ(api.post("/api/v1/comparisons", asked).json()["parameters"], defaults);
  }
  CHECK_EQ(api.get("/api/v1/sites/yard/parameters").json()["grouping"], "consensus");
  CHECK_NE(api.get("/api/v1/sites/yard/parameters?grouping=vote").complaint_about("grouping"), "");
  CHECK_EQ(api.get("/api/v1/sites/hall/parameters").status, 404);
}

TEST_CASE("the points of a comparison have their classes, those of the priors too") {
  ApiFixture api;
  api.make_site_and_sensor();
  api.upload(0);
  api.upload(1, {.box = true});
  const json gone = api.upload(2);
  const auto n = static_cast<int>(box_points());
  const std::string target = "/api/v1/comparisons/" + gone["comparison"].dump() + "/points?format=csv";
  const Reply all = api.get(target);
  REQUIRE_EQ(all.status, 200);
  const auto by_class = count_by(all.body, "class");
  CHECK_EQ(by_class.at("removed"), n);
  CHECK_EQ(all.body.substr(0, all.body.find('\n')), "x,y,z,class,free,supported,change,prior");
  const auto by_prior = count_by(all.body, "prior");
  CHECK_EQ(by_prior.at(""), kWallPoints);
  CHECK_EQ(by_prior.at("0"), n);

  // The box's face stands at x = 4.5 in the sensor's frame; the pose is a half turn about z.
  const Reply sensor = api.get(target + "&class=removed&frame=sensor");
  CHECK_EQ(count_by(sensor.body, "class"), std::map<std::string, int>{{"removed", n}});
  std::istringstream lines(sensor.body);
  std::string line;
  std::getline(lines, line);
  while (std::getline(lines, line)) CHECK(std::stod(line) == doctest::Approx(4.5));
  std::istringstream world(api.get(target + "&class=removed").body);
  std::getline(world, line);
  while (std::getline(world, line)) CHECK(std::stod(line) == doctest::Approx(95.5));

  CHECK_EQ(count_by(api.get(target + "&class=removed,added&voxel_m=5").body, "class").size(), 1);
  const std::string base = target.substr(0, target.find('?'));
  const std::string quantised = api.get(base + "?format=q16&class=removed").body;
  REQUIRE_EQ(quantised.size(), 96 + box_points() * 8);
  for (std::size_t at = 96 + 6; at < quantised.size(); at += 8) CHECK_EQ(quantised[at], 2);
  const Reply wrong = api.get(target + "&class=removed,gone");
  CHECK_EQ(wrong.status, 422);
  CHECK_NE(wrong.complaint_about("class"), "");
  CHECK_EQ(api.get(target, {{"If-None-Match", all.header("ETag")}}).status, 304);
}

TEST_CASE("a stored scan is compared again with named scans and parameters") {
  ApiFixture api;
  api.make_site_and_sensor();
  const json empty = api.upload(0);
  const json with_box = api.upload(1, {.box = true});
  const json parameters = {{"grouping", "union"},
                           {"angle_deg", 1.2},
                           {"range_m", 0.3},
                           {"clustering", false},
                           {"support_distance_m", 0.07},
                           {"growth_distance_m", 0.2},
                           {"foliage_distance_m", 0.6},
                           {"cluster_distance_m", 0.4},
                           {"cluster_min_points", 7},
                           {"min_range_m", 0.5},
                           {"max_range_m", 80.0},
                           {"contemporary_s", 2.5},
                           {"align", false}};
  const json reference = {{"scans", {empty["id"]}}};
  const Reply queued =
      api.post("/api/v1/comparisons", {{"scan", with_box["id"]}, {"reference", reference}, {"parameters", parameters}});
  REQUIRE_EQ(queued.status, 202);
  CHECK_EQ(queued.header("Location"), "/api/v1/comparisons/" + queued.json()["id"].dump());
  const json done = wait_until_done(api, queued.json());
  CHECK_EQ(done["state"], "done");
  CHECK_EQ(done["reference"], reference);
  CHECK_EQ(done["parameters"], parameters);
  CHECK_EQ(done["counts"]["added"], static_cast<int>(box_points()));
  const json scan = api.get("/api/v1/scans/" + with_box["id"].dump()).json();
  CHECK_EQ(scan["comparison"], with_box["comparison"]);
  CHECK_EQ(scan["comparisons"].size(), 3);
  CHECK_EQ(api.get("/api/v1/comparisons?scan=" + with_box["id"].dump()).json()["items"].size(), 3);
  CHECK_EQ(api.get("/api/v1/comparisons?state=failed").json()["items"], json::array());
  CHECK_EQ(api.get("/api/v1/comparisons?site=yard&limit=1").json()["items"][0]["id"], done["id"]);
}

TEST_CASE("a window of time is a reference, and parameters that are not given are the profile's") {
  ApiFixture api;
  api.make_site_and_sensor();
  api.patch("/api/v1/sites/yard", {{"profile", "outdoor"}});
  const json empty = api.upload(0);
  const json with_box = api.upload(1, {.box = true});
  const json reference = {{"from", "2026-03-01T08:00:00Z"}, {"to", "2026-03-01T08:00:30Z"}};
  const json done = wait_until_done(
      api, api.post("/api/v1/comparisons", {{"scan", with_box["id"]}, {"reference", reference}}).json());
  CHECK_EQ(done["reference"], reference);
  REQUIRE_EQ(done["priors"].size(), 1);
  CHECK_EQ(done["priors"][0]["scan"], empty["id"]);
  CHECK_EQ(done["parameters"]["grouping"], "consensus");
  CHECK(done["parameters"]["angle_deg"].is_null());
  CHECK_EQ(done["parameters"], api.get("/api/v1/comparisons/" + with_box["comparison"].dump()).json()["parameters"]);
}

TEST_CASE("what is wrong with a comparison's request is said for all of it at once") {
  ApiFixture api;
  api.make_site_and_sensor();
  const json scan = api.upload(0)["id"];
  const auto post = [&](const json& body) { return api.post("/api/v1/comparisons", body); };
  api.post("/api/v1/baselines/yard/accept", {{"by", "anna"}, {"mode", "learn"}});
  CHECK_EQ(post({{"scan", scan}, {"reference", "baseline"}}).complaint_about("reference"), "the site has no baseline");
  const Reply parameters = post({{"scan", scan},
                                 {"parameters",
                                  {{"grouping", "majority"},
                                   {"angle_deg", 0},
                                   {"range_m", -1},
                                   {"clustering", "no"},
                                   {"cluster_distance_m", 0},
                                   {"cluster_min_points", 1.5},
                                   {"min_range_m", nullptr},
                                   {"contemporary_s", -1},
                                   {"angel_deg", 1}}}});
  REQUIRE_EQ(parameters.status, 422);
  for (const char* field : {"grouping", "angle_deg", "range_m", "clustering", "cluster_distance_m",
                            "cluster_min_points", "min_range_m", "contemporary_s", "angel_deg"}) {
    CAPTURE(field);
    CHECK_NE(parameters.complaint_about(std::string("parameters.") + field), "");
  }
  CHECK_EQ(parameters.complaint_about("parameters.angel_deg"), "unknown member; did you mean 'angle_deg'?");
  CHECK_NE(post({{"scan", scan}, {"parameters", {{"min_range_m", 9}, {"max_range_m", 8}}}})
               .complaint_about("parameters.min_range_m"),
           "");
  CHECK_NE(post({{"scan", scan}, {"reference", "latest"}}).complaint_about("reference"), "");
  CHECK_NE(post({{"scan", scan}, {"reference", 7}}).complaint_about("reference"), "");
  CHECK_NE(post({{"scan", scan}, {"reference", nullptr}}).complaint_about("reference"), "");
  CHECK_NE(post({{"scan", scan}, {"reference", {{"from", "2026-03-01T08:00:00Z"}}}}).complaint_about("reference.to"),
           "");
  CHECK_NE(post({{"scan", scan}, {"reference", {{"from", "2026-03-02T08:00:00Z"}, {"to", "2026-03-01T08:00:00Z"}}}})
               .complaint_about("reference.to"),
           "");
  CHECK_NE(post({{"scan", scan}, {"reference", {{"scans", json::array()}}}}).complaint_about("reference.scans"), "");
  CHECK_NE(post({{"scan", scan}, {"reference", {{"scans", {scan}}}}}).complaint_about("reference.scans"), "");
  CHECK_NE(post({{"scan", scan}, {"reference", {{"scans", {1, 1}}}}}).complaint_about("reference.scans"), "");
  CHECK_NE(post({{"scan", scan}, {"reference", {{"scans", {1}}, {"to", "now"}}}}).complaint_about("reference.to"), "");
  CHECK_EQ(post({{"scan", scan}, {"reference", {{"scans", {99}}}}}).status, 404);
  CHECK_EQ(post({{"scan", 99}}).status, 404);
  CHECK_EQ(post({{"scan", "1"}}).complaint_about("scan"), "must be a whole number");
  CHECK_EQ(post(json::object()).complaint_about("scan"), "is required");
  CHECK_EQ(api.get("/api/v1/comparisons").json()["items"].size(), 2);
}

TEST_CASE("a stored scan is compared with what is normal, and that moves no track") {
  ApiFixture api;
  api.make_site_and_sensor();
  for (int i = 0; i < 3; ++i) api.upload(i);
  const json with_box = api.upload(3, {.box = true});
  const Reply queued = api.post("/api/v1/comparisons", {{"scan", with_box["id"]}, {"reference", "baseline"}});
  REQUIRE_EQ(queued.status, 202);
  const json done = wait_until_done(api, queued.json());
  CHECK_EQ(done["reference"], "baseline");
  CHECK_EQ(done["changes"], 1);
  CHECK_FALSE(done["priors"].empty());
  CHECK_EQ(api.get("/api/v1/tracks").json()["items"][0]["seen"], 1);
}

TEST_CASE("with Prefer: wait a comparison that is asked for is answered when it is done") {
  ApiFixture api;
  api.make_site_and_sensor();
  api.upload(0);
  const json scan = api.upload(1)["id"];
  const Reply reply = api.post("/api/v1/comparisons", {{"scan", scan}}, {{"Prefer", "wait=50"}});
  CHECK_EQ(reply.status, 202);
  CHECK_EQ(reply.header("Preference-Applied"), "wait=50");
  CHECK_EQ(reply.json()["state"], "done");
  CHECK_EQ(api.post("/api/v1/comparisons", {{"scan", scan}}).header("Preference-Applied"), "");
}

TEST_CASE("scans of different sites are not compared") {
  ApiFixture api;
  api.make_site_and_sensor();
  const json here = api.upload(0)["id"];
  api.post("/api/v1/sites", {{"name", "hall"}});
  api.post("/api/v1/sensors", {{"name", "door"}, {"site", "hall"}});
  const json there = api.upload_bytes(pcd_of(wall_points({}), wall_pose()),
                                      "sensor=door&captured_at=2026-03-01T08:05:00Z", {{"Prefer", "wait=50"}})
                         .json()["id"];
  const Reply reply = api.post("/api/v1/comparisons", {{"scan", there}, {"reference", {{"scans", {here}}}}});
  CHECK_EQ(reply.status, 422);
  CHECK_NE(reply.complaint_about("reference.scans"), "");
}

TEST_CASE("a comparison that does not exist has no parts either") {
  ApiFixture api;
  for (const char* part : {"", "/changes", "/points"}) {
    CHECK_EQ(api.get(std::string("/api/v1/comparisons/1") + part).status, 404);
  }
}

}  // namespace
}  // namespace raywatch::testing
