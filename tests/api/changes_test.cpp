#include <doctest/doctest.h>

#include "tests/api/api_fixture.hpp"

namespace raywatch::testing {
namespace {

using nlohmann::json;

std::size_t found(ApiFixture& api, const std::string& query) {
  return api.get("/api/v1/changes" + query).json()["items"].size();
}

TEST_CASE("a change says what happened, where, how large and how sure it is") {
  ApiFixture api;
  api.make_site_and_sensor();
  api.upload(0);
  const json scan = api.upload(1, {.box = true});
  const json changes = api.get("/api/v1/comparisons/" + scan["comparison"].dump() + "/changes").json()["items"];
  REQUIRE_EQ(changes.size(), 1);
  const json change = changes[0];
  CHECK_EQ(change["kind"], "added");
  CHECK_EQ(change["scan"], scan["id"]);
  CHECK_EQ(change["site"], "yard");
  CHECK_EQ(change["captured_at"], scan["captured_at"]);
  CHECK_EQ(change["points"], box_points());
  CHECK(change["track"].is_null());
  // The face of the box stands 4.5 m before the sensor, which looks back along x from (100, 200, 1.5).
  const double expected_m[3] = {95.5, 200.0, 1.5};
  for (std::size_t k = 0; k < 3; ++k) {
    CHECK(change["centroid_m"][k].get<double>() == doctest::Approx(expected_m[k]).epsilon(0.001));
    CHECK(change["box"]["position_m"][k].get<double>() == doctest::Approx(expected_m[k]).epsilon(0.01));
    CHECK_LE(change["bounds_m"]["min"][k].get<double>(), expected_m[k] + 1e-5);
    CHECK_GE(change["bounds_m"]["max"][k].get<double>(), expected_m[k] - 1e-5);
  }
  CHECK(change["size_m"][0].get<double>() == doctest::Approx(0.95).epsilon(0.1));
  CHECK_EQ(change["confidence"]["value"], 1.0);
  CHECK_EQ(api.get("/api/v1/changes/" + change["id"].dump()).json(), change);
  CHECK_EQ(api.get("/api/v1/changes/99").status, 404);
}

TEST_CASE("changes are found by site, kind, time, place and volume") {
  ApiFixture api;
  api.make_site_and_sensor();
  api.upload(0);
  api.upload(1, {.box = true});
  api.upload(2);
  CHECK_EQ(found(api, ""), 2);
  CHECK_EQ(found(api, "?site=yard"), 2);
  CHECK_EQ(found(api, "?kind=added"), 1);
  CHECK_EQ(found(api, "?kind=removed"), 1);
  CHECK_EQ(found(api, "?kind=discrepancy"), 0);
  CHECK_EQ(found(api, "?from=2026-03-01T08:02:00Z"), 1);
  CHECK_EQ(found(api, "?to=2026-03-01T08:02:00Z"), 1);
  CHECK_EQ(found(api, "?site=yard&box=95,199,1,96,201,2"), 2);
  CHECK_EQ(found(api, "?site=yard&box=4,-1,-1,5,1,1"), 0);
  CHECK_EQ(found(api, "?min_volume_m3=1000"), 0);
  CHECK_EQ(found(api, "?min_volume_m3=0"), 2);
  CHECK_EQ(found(api, "?limit=1"), 1);
  const json page = api.get("/api/v1/changes?limit=1").json();
  CHECK_EQ(page["items"][0]["kind"], "removed");
  const json rest = api.get("/api/v1/changes?limit=1&cursor=" + page["next"].get<std::string>()).json();
  CHECK_EQ(rest["items"][0]["kind"], "added");
  CHECK(rest["next"].is_null());
}

TEST_CASE("a filter that is none is refused by name") {
  ApiFixture api;
  api.make_site_and_sensor();
  const std::map<std::string, std::string> wrong = {
      {"kind", "moved"}, {"from", "today"},       {"to", "2026-13-01T00:00:00Z"},
      {"box", "1,2,3"},  {"min_volume_m3", "-1"}, {"limit", "0"}};
  for (const auto& [name, value] : wrong) {
    CAPTURE(name);
    const Reply reply = api.get("/api/v1/changes?site=yard&" + name + "=" + value);
    CHECK_EQ(reply.status, 422);
    CHECK_NE(reply.complaint_about(name), "");
  }
  CHECK_NE(api.get("/api/v1/changes?box=0,0,0,1,1,1").complaint_about("box"), "");
  CHECK_NE(api.get("/api/v1/changes?site=yard&box=1,0,0,0,1,1").complaint_about("box"), "");
  CHECK_EQ(api.get("/api/v1/changes?site=nowhere").status, 404);
}

}  // namespace
}  // namespace raywatch::testing
