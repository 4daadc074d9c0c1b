#include <doctest/doctest.h>

#include "tests/api/api_fixture.hpp"

namespace raywatch::testing {
namespace {

using nlohmann::json;

std::vector<int> ids(const json& page) {
  std::vector<int> list;
  for (const json& item : page["items"]) list.push_back(item["id"]);
  return list;
}

std::string target_of(const json& scan) { return "/api/v1/scans/" + std::to_string(scan["id"].get<int>()); }

/// A scan with three points from another place, without a wait.
json upload_small(ApiFixture& api, const std::string& sensor, int number, const std::string& position) {
  const Reply reply =
      api.upload_bytes("1 2 3\n4 5 6\n7 8 9.5\n",
                       "format=xyz&sensor=" + sensor + "&captured_at=" + format_rfc3339(wall_time(number)) +
                           "&pose=" + position + ",0,0,0,1",
                       {{"Prefer", "wait=50"}});
  REQUIRE_EQ(reply.status, 201);
  return reply.json();
}

TEST_CASE("scans are listed newest first and found by sensor, time, vantage and place") {
  ApiFixture api;
  api.make_site_and_sensor();
  api.post("/api/v1/sensors", {{"name", "tower"}, {"site", "yard"}});
  const int a = upload_small(api, "gate", 1, "10,0,0")["id"];
  const json b = upload_small(api, "tower", 2, "50,0,0");
  const int c = upload_small(api, "gate", 3, "10.1,0,0")["id"];
  const int b_id = b["id"];
  const auto found = [&](const std::string& query) { return ids(api.get("/api/v1/scans" + query).json()); };
  CHECK_EQ(found(""), std::vector{c, b_id, a});
  CHECK_EQ(found("?sensor=gate"), std::vector{c, a});
  CHECK_EQ(found("?site=yard&sensor=tower"), std::vector{b_id});
  CHECK_EQ(found("?vantage=" + b["vantage"].dump()), std::vector{b_id});
  CHECK_EQ(found("?from=2026-03-01T08:02:00Z"), std::vector{c, b_id});
  CHECK_EQ(found("?to=2026-03-01T08:02:00Z"), std::vector{a});
  CHECK_EQ(found("?site=yard&near=49,0,0&radius_m=2"), std::vector{b_id});
  CHECK_EQ(found("?site=yard&near=11,0,0"), std::vector{c, a});
  CHECK_EQ(api.get("/api/v1/scans?near=1,2,3").status, 422);
  const std::string range = "?from=2026-03-01T08:02:00Z&to=2026-03-01T08:01:00Z";
  CHECK_EQ(api.get("/api/v1/scans" + range).complaint_about("to"), "must be later than 'from'");
  CHECK_EQ(api.get("/api/v1/scans?site=yard&near=1,2").complaint_about("near").empty(), false);
  CHECK_EQ(api.get("/api/v1/scans?radius_m=2").complaint_about("radius_m").empty(), false);
  CHECK_EQ(api.get("/api/v1/scans?site=nowhere").status, 404);

  const json vantages = api.get("/api/v1/vantages?site=yard").json();
  REQUIRE_EQ(vantages["items"].size(), 2);
  CHECK_EQ(vantages["items"][0]["scans"].get<int>() + vantages["items"][1]["scans"].get<int>(), 3);
}

TEST_CASE("a cursor goes through many scans, each once, though new ones arrive meanwhile") {
  ApiFixture api;
  api.make_site_and_sensor();
  constexpr int count = 23;
  for (int i = 0; i < count; ++i) upload_small(api, "gate", i, "10,0,0");
  std::vector<int> seen;
  std::string query = "?limit=5";
  for (int page = 0; page < 5; ++page) {
    const json answer = api.get("/api/v1/scans" + query).json();
    for (const int id : ids(answer)) seen.push_back(id);
    if (page == 1) upload_small(api, "gate", 1000, "10,0,0");
    if (answer["next"].is_null()) break;
    query = "?limit=5&cursor=" + answer["next"].get<std::string>();
  }
  REQUIRE_EQ(seen.size(), count);
  for (int i = 0; i < count; ++i) CHECK_EQ(seen[static_cast<std::size_t>(i)], count - i);
}

TEST_CASE("a scan is pinned and noted, and not deleted while it is pinned") {
  ApiFixture api;
  api.make_site_and_sensor();
  const std::string target = target_of(api.upload(0));
  const Reply edited = api.patch(target, {{"pinned", true}, {"note", "before the delivery"}});
  REQUIRE_EQ(edited.status, 200);
  CHECK_EQ(edited.json()["pinned"], true);
  CHECK_EQ(edited.json()["note"], "before the delivery");
  CHECK_EQ(api.remove(target).status, 409);
  CHECK_EQ(api.patch(target, {{"note", ""}}).json()["pinned"], true);
  CHECK_EQ(api.patch(target, {{"pinned", false}}).status, 200);
  CHECK_EQ(api.remove(target).status, 204);
  CHECK_EQ(api.get(target).status, 404);
  CHECK_EQ(api.get(target + "/points").status, 404);
}

TEST_CASE("an edit of a scan is checked as strictly as all others") {
  ApiFixture api;
  api.make_site_and_sensor();
  const std::string target = target_of(api.upload(0));
  const std::string tag = api.get(target).header("ETag");
  CHECK_EQ(api.patch(target, {{"pined", true}}).complaint_about("pined"), "unknown member; did you mean 'pinned'?");
  CHECK_EQ(api.patch(target, {{"pinned", "yes"}}).complaint_about("pinned"), "must be true or false");
  CHECK_EQ(api.patch(target, {{"note", std::string(4001, 'x')}}).status, 422);
  CHECK_EQ(api.patch(target, {{"note", "a"}}, {{"If-Match", tag}}).status, 200);
  CHECK_EQ(api.patch(target, {{"note", "b"}}, {{"If-Match", tag}}).status, 412);
  CHECK_EQ(api.get(target).json()["note"], "a");
}

TEST_CASE("a scan that is a prior of another is not deleted") {
  ApiFixture api;
  api.make_site_and_sensor();
  const json first = api.upload(0);
  const json second = api.upload(1);
  CHECK_EQ(api.remove(target_of(first)).status, 409);
  CHECK_EQ(api.remove(target_of(second)).status, 204);
  CHECK_EQ(api.remove(target_of(first)).status, 204);
}

TEST_CASE("a scan that is deleted is not normal any more") {
  ApiFixture api;
  api.make_site_and_sensor();
  CHECK_EQ(api.remove(target_of(api.upload(0))).status, 204);
  const json versions = api.get("/api/v1/baselines?site=yard").json()["items"];
  REQUIRE_EQ(versions.size(), 2);
  CHECK_EQ(versions[0]["kind"], "withdrawn");
  CHECK_EQ(versions[0]["entries"].size(), 0);
}

TEST_CASE("what is no id names no scan") {
  ApiFixture api;
  for (const char* id : {"1", "0", "-1", "abc", "1e3", "99999999999999999999", "1%20"}) {
    CAPTURE(id);
    CHECK_EQ(api.get(std::string("/api/v1/scans/") + id).status, 404);
  }
}

TEST_CASE("the panorama says how far a scan saw, and null where it saw nothing") {
  ApiFixture api;
  api.make_site_and_sensor();
  const std::string target = target_of(api.upload(0)) + "/panorama";
  const Reply reply = api.get(target);
  const json panorama = reply.json();
  const int rows = panorama["rows"], columns = panorama["columns"];
  REQUIRE_EQ(panorama["farthest_m"].size(), static_cast<std::size_t>(rows * columns));
  const auto cell = [&](int row, int column) {
    return panorama["farthest_m"][static_cast<std::size_t>(row * columns + column)];
  };
  // The cell just above and left of straight ahead reaches to 3 degrees both ways: 10 m / cos(3 deg)^2.
  CHECK(cell(rows / 2, columns / 2).get<double>() == doctest::Approx(10.0).epsilon(0.01));
  CHECK(cell(0, 0).is_null());
  const Reply bytes = api.get(target + "?format=bin");
  CHECK_EQ(bytes.body.size(), static_cast<std::size_t>(rows * columns * 2));
  CHECK_EQ(api.get(target, {{"If-None-Match", reply.header("ETag")}}).status, 304);
  CHECK_EQ(api.get(target + "?format=gif").status, 422);
}

TEST_CASE("every prior that was considered is told with its figures") {
  ApiFixture api;
  api.make_site_and_sensor();
  const json first = api.upload(0);
  const json second = api.upload(1);
  CHECK_EQ(api.get(target_of(first) + "/candidates").json()["items"], json::array());
  const json candidates = api.get(target_of(second) + "/candidates").json();
  CHECK_EQ(candidates["comparison"], second["comparison"]);
  REQUIRE_EQ(candidates["items"].size(), 1);
  CHECK_EQ(candidates["items"][0]["scan"], first["id"]);
  CHECK_EQ(candidates["items"][0]["age_s"], 60.0);
  CHECK_EQ(candidates["items"][0]["chosen"], true);
  CHECK_EQ(api.get(target_of(second) + "/candidates?comparison=" + first["comparison"].dump()).status, 404);
}

}  // namespace
}  // namespace raywatch::testing
