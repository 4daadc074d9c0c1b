#include <doctest/doctest.h>

#include <algorithm>

#include "tests/api/api_fixture.hpp"

namespace raywatch::testing {
namespace {

using nlohmann::json;

TEST_CASE("a site needs only a name and shows its defaults") {
  ApiFixture api;
  const Reply made = api.post("/api/v1/sites", {{"name", "yard"}});
  REQUIRE_EQ(made.status, 201);
  CHECK_EQ(made.header("Location"), "/api/v1/sites/yard");
  const json site = made.json();
  CHECK_EQ(site["time_zone"], "UTC");
  CHECK_EQ(site["profile"], "indoor");
  CHECK(site["origin_m"].is_null());
  CHECK_EQ(site["created_at"], "2026-03-02T08:00:00Z");
  CHECK_EQ(api.get("/api/v1/sites/yard").json(), site);
}

TEST_CASE("a site keeps all that it is given, under a name that needs encoding") {
  ApiFixture api;
  const json given = {{"name", "Hof Süd+1"},
                      {"time_zone", "Europe/Berlin"},
                      {"profile", "survey"},
                      {"epsg", 25832},
                      {"origin_m", {423000.5, 5462000.25, 210.0}}};
  const Reply made = api.post("/api/v1/sites", given);
  REQUIRE_EQ(made.status, 201);
  const std::string address = "/api/v1/sites/Hof%20S%C3%BCd%2B1";
  // The client library decodes headers.
  CHECK_EQ(made.header("Location"), "/api/v1/sites/Hof Süd+1");
  const json site = api.get(address).json();
  for (const auto& [name, value] : given.items()) CHECK_EQ(site[name], value);
  CHECK_EQ(api.get("/api/v1/sensors?site=Hof%20S%C3%BCd%2B1").json()["items"], json::array());
}

TEST_CASE("a second site of one name is a conflict, and the first stays") {
  ApiFixture api;
  const json first = api.post("/api/v1/sites", {{"name", "yard"}}).json();
  const Reply second = api.post("/api/v1/sites", {{"name", "yard"}, {"profile", "survey"}});
  CHECK_EQ(second.status, 409);
  CHECK_EQ(second.problem(), "conflict");
  CHECK_EQ(api.get("/api/v1/sites").json()["items"], json::array({first}));
}

TEST_CASE("every member of a site that is wrong is named") {
  ApiFixture api;
  const Reply reply = api.post("/api/v1/sites", {{"name", "a/b"},
                                                 {"time_zone", "Mars/Olympus"},
                                                 {"profile", "forest"},
                                                 {"epsg", 25832.5},
                                                 {"origin_m", {1, 2}},
                                                 {"orgin_m", {1, 2, 3}}});
  REQUIRE_EQ(reply.status, 422);
  for (const char* field : {"name", "time_zone", "profile", "epsg", "origin_m", "orgin_m"}) {
    CAPTURE(field);
    CHECK_NE(reply.complaint_about(field), "");
  }
  CHECK_EQ(reply.complaint_about("orgin_m"), "unknown member; did you mean 'origin_m'?");
  CHECK_EQ(api.post("/api/v1/sites", json::object()).complaint_about("name"), "is required");
  CHECK_EQ(api.post("/api/v1/sites", {{"name", nullptr}}).complaint_about("name"), "must not be null");
  CHECK_EQ(api.post("/api/v1/sites", json::array({1})).complaint_about(""), "must be a JSON object");
  for (const char* name : {"", ".", "..", " yard", "yard ", "a\nb"}) {
    CHECK_EQ(api.post("/api/v1/sites", {{"name", name}}).status, 422);
  }
  CHECK_EQ(api.get("/api/v1/sites").json()["items"], json::array());
}

TEST_CASE("an edit changes what it names and nothing else") {
  ApiFixture api;
  json site = api.post("/api/v1/sites", {{"name", "yard"}, {"time_zone", "Europe/Berlin"}}).json();
  const Reply edited = api.patch("/api/v1/sites/yard", {{"profile", "outdoor"}});
  REQUIRE_EQ(edited.status, 200);
  site["profile"] = "outdoor";
  CHECK_EQ(edited.json(), site);
  CHECK_EQ(api.patch("/api/v1/sites/yard", {{"name", "court"}}).status, 422);
  CHECK_EQ(api.patch("/api/v1/sites/yard", {{"profile", nullptr}}).complaint_about("profile"), "must not be null");
  CHECK_EQ(api.patch("/api/v1/sites/court", {{"profile", "outdoor"}}).status, 404);
  CHECK_EQ(api.get("/api/v1/sites/yard").json(), site);
}

TEST_CASE("a site has a mine grid instead of an EPSG code") {
  ApiFixture api;
  const json grid = {{"site_origin_m", {391000.0, 6460000.0, 310.0}},
                     {"grid_origin_m", {5000.0, 10000.0, 1310.0}},
                     {"rotation_deg", 23.5},
                     {"scale", 0.9996}};
  const Reply made = api.post("/api/v1/sites", {{"name", "pit"}, {"mine_grid", grid}});
  REQUIRE_EQ(made.status, 201);
  CHECK_EQ(made.json()["mine_grid"], grid);
  CHECK_EQ(api.get("/api/v1/sites/pit").json()["mine_grid"], grid);
  const std::string both = api.patch("/api/v1/sites/pit", {{"epsg", 28350}}).complaint_about("mine_grid");
  CHECK_EQ(both, "cannot be given beside 'epsg': give null for the one that does not hold");
  const json mapped = api.patch("/api/v1/sites/pit", {{"epsg", 28350}, {"mine_grid", nullptr}}).json();
  CHECK_EQ(mapped["epsg"], 28350);
  CHECK(mapped["mine_grid"].is_null());
  json short_grid = grid;
  short_grid.erase("rotation_deg");
  short_grid.erase("scale");
  const json turned = api.patch("/api/v1/sites/pit", {{"epsg", nullptr}, {"mine_grid", short_grid}}).json();
  CHECK(turned["epsg"].is_null());
  CHECK_EQ(turned["mine_grid"]["rotation_deg"], 0.0);
  CHECK_EQ(turned["mine_grid"]["scale"], 1.0);
  const Reply wrong = api.post(
      "/api/v1/sites",
      {{"name", "x"}, {"mine_grid", {{"site_origin_m", {1, 2}}, {"rotation_deg", 400}, {"scale", 2}, {"turn", 1}}}});
  REQUIRE_EQ(wrong.status, 422);
  CHECK_EQ(wrong.complaint_about("mine_grid.grid_origin_m"), "is required");
  for (const char* field : {"site_origin_m", "rotation_deg", "scale", "turn"}) {
    CAPTURE(field);
    CHECK_NE(wrong.complaint_about(std::string("mine_grid.") + field), "");
  }
}

TEST_CASE("an edit of a version that is no longer stored is refused") {
  ApiFixture api;
  api.make_site_and_sensor();
  for (const std::string target : {"/api/v1/sites/yard", "/api/v1/sensors/gate"}) {
    CAPTURE(target);
    const bool is_site = target.find("sites") != std::string::npos;
    const json first = is_site ? json{{"profile", "survey"}} : json{{"min_range_m", 1.0}};
    const json second = is_site ? json{{"profile", "outdoor"}} : json{{"min_range_m", 2.0}};
    const std::string tag = api.get(target).header("ETag");
    const Reply edited = api.patch(target, first, {{"If-Match", tag}});
    REQUIRE_EQ(edited.status, 200);
    const Reply refused = api.patch(target, second, {{"If-Match", tag}});
    CHECK_EQ(refused.status, 412);
    CHECK_EQ(refused.problem(), "precondition-failed");
    CHECK_EQ(api.get(target).json(), edited.json());
    CHECK_EQ(api.patch(target, second, {{"If-Match", edited.header("ETag")}}).status, 200);
    CHECK_EQ(api.patch(target, first, {{"If-Match", "*"}}).status, 200);
  }
}

TEST_CASE("a site is deleted once it has no sensors") {
  ApiFixture api;
  api.make_site_and_sensor();
  CHECK_EQ(api.remove("/api/v1/sites/yard").status, 409);
  CHECK_EQ(api.remove("/api/v1/sensors/gate").status, 204);
  CHECK_EQ(api.remove("/api/v1/sites/yard").status, 204);
  CHECK_EQ(api.get("/api/v1/sites/yard").status, 404);
  CHECK_EQ(api.remove("/api/v1/sites/yard").status, 404);
}

TEST_CASE("a sensor shows its figures in the units in which they were given") {
  ApiFixture api;
  api.post("/api/v1/sites", {{"name", "yard"}});
  const json given = {{"name", "gate"},
                      {"site", "yard"},
                      {"pose", {{"position_m", {1.5, -2.0, 3.25}}, {"orientation_xyzw", {0.0, 0.0, 1.0, 0.0}}}},
                      {"min_range_m", 0.5},
                      {"max_range_m", 120.0},
                      {"range_noise_m", 0.02},
                      {"angular_resolution_deg", {0.2, 1.3}},
                      {"beam_divergence_mrad", 3.1},
                      {"interval_s", 0.1}};
  REQUIRE_EQ(api.post("/api/v1/sensors", given).status, 201);
  const json sensor = api.get("/api/v1/sensors/gate").json();
  for (const auto& [name, value] : given.items()) CHECK_EQ(sensor[name], value);
  CHECK_EQ(sensor["estimated"], json::object());
}

TEST_CASE("null clears a figure of a sensor, and what is not named stays") {
  ApiFixture api;
  api.post("/api/v1/sites", {{"name", "yard"}});
  api.post("/api/v1/sensors", {{"name", "gate"},
                               {"site", "yard"},
                               {"min_range_m", 0.5},
                               {"interval_s", 10.0},
                               {"pose", {{"position_m", {1, 2, 3}}, {"orientation_xyzw", {0, 0, 0, 1}}}}});
  const json sensor = api.patch("/api/v1/sensors/gate", {{"pose", nullptr}, {"min_range_m", nullptr}}).json();
  CHECK(sensor["pose"].is_null());
  CHECK(sensor["min_range_m"].is_null());
  CHECK_EQ(sensor["interval_s"], 10.0);
}

TEST_CASE("every figure of a sensor that is wrong is named") {
  ApiFixture api;
  api.make_site_and_sensor();
  const Reply reply =
      api.post("/api/v1/sensors", {{"name", "tower"},
                                   {"site", "yard"},
                                   {"min_range_m", -1.0},
                                   {"max_range_m", "far"},
                                   {"angular_resolution_deg", {0.0, 1.0}},
                                   {"beam_divergence_mrad", true},
                                   {"interval_s", 0},
                                   {"pose", {{"position_m", {1, 2, 3}}, {"orientation_xyzw", {0, 0, 0, 2}}}}});
  REQUIRE_EQ(reply.status, 422);
  for (const char* field :
       {"min_range_m", "max_range_m", "angular_resolution_deg", "beam_divergence_mrad", "interval_s", "pose"}) {
    CAPTURE(field);
    CHECK_NE(reply.complaint_about(field), "");
  }
  const Reply nested =
      api.patch("/api/v1/sensors/gate", {{"pose", {{"position_m", {1, 2, 3}}, {"orientation", {0, 0, 0, 1}}}}});
  CHECK_EQ(nested.complaint_about("pose.orientation_xyzw"), "is required");
  CHECK_NE(nested.complaint_about("pose.orientation"), "");
  CHECK_NE(api.patch("/api/v1/sensors/gate", {{"min_range_m", 5}, {"max_range_m", 4}}).complaint_about("min_range_m"),
           "");
  CHECK_EQ(api.post("/api/v1/sensors", {{"name", "tower"}, {"site", "nowhere"}}).status, 404);
  CHECK_EQ(api.post("/api/v1/sensors", {{"name", "gate"}, {"site", "yard"}}).status, 409);
  CHECK_EQ(api.get("/api/v1/sensors").json()["items"].size(), 1);
}

TEST_CASE("what a sensor's scans show is shown as estimated, until it is given") {
  ApiFixture api;
  api.make_site_and_sensor();
  api.upload(0);
  const json estimated = api.get("/api/v1/sensors/gate").json()["estimated"]["angular_resolution_deg"];
  REQUIRE_EQ(estimated.size(), 2);
  CHECK(estimated[0].get<double>() == doctest::Approx(1.0).epsilon(0.1));  // the scan's steps
  const json given = api.patch("/api/v1/sensors/gate", {{"angular_resolution_deg", {1.0, 1.0}}}).json();
  CHECK_FALSE(given["estimated"].contains("angular_resolution_deg"));
}

TEST_CASE("lists of sites and sensors go through all items page by page") {
  ApiFixture api;
  std::vector<std::string> made, listed;
  for (int i = 0; i < 7; ++i) {
    made.push_back("site " + std::to_string(i));
    REQUIRE_EQ(api.post("/api/v1/sites", {{"name", made.back()}}).status, 201);
    REQUIRE_EQ(api.post("/api/v1/sensors", {{"name", made.back()}, {"site", "site 0"}}).status, 201);
  }
  for (const std::string list : {"/api/v1/sites", "/api/v1/sensors?site=site%200"}) {
    listed.clear();
    std::string cursor;
    for (int page = 0; page < 4; ++page) {
      const char* separator = list.find('?') == std::string::npos ? "?" : "&";
      const json answer = api.get(list + separator + "limit=2" + (cursor.empty() ? "" : "&cursor=" + cursor)).json();
      for (const json& item : answer["items"]) listed.push_back(item["name"]);
      CHECK_EQ(answer["next"].is_null(), page == 3);
      if (page < 3) cursor = answer["next"];
    }
    std::sort(listed.begin(), listed.end());
    CHECK_EQ(listed, made);
  }
}

TEST_CASE("limits and cursors that are none are refused") {
  ApiFixture api;
  for (const char* limit : {"0", "1001", "-1", "ten", "1.5", "99999999999999999999"}) {
    CAPTURE(limit);
    const Reply reply = api.get(std::string("/api/v1/sites?limit=") + limit);
    CHECK_EQ(reply.status, 422);
    CHECK_NE(reply.complaint_about("limit"), "");
  }
  const auto complaint = [&](const std::string& limit) {
    return api.get("/api/v1/sites?limit=" + limit).complaint_about("limit");
  };
  CHECK_EQ(complaint("100000000000000000000"), "must be at most 1000");
  CHECK_EQ(complaint("-100000000000000000000"), "must be at least 1");
  CHECK_EQ(complaint("1.5"), "must be a whole number");
  CHECK_EQ(api.get("/api/v1/sites?cursor=%F0%9F%90%A0nonsense").status, 422);
  CHECK_EQ(api.get("/api/v1/scans?cursor=AAAA").status, 422);
}

}  // namespace
}  // namespace raywatch::testing
