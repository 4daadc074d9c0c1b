#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <sstream>

#include "tests/api/pit_week.hpp"

namespace raywatch::testing {
namespace {

using nlohmann::json;

/// What is true of the cells that a survey saw in both epochs.
double true_net_m3(PitWeek& pit, const json& survey, std::size_t before, std::size_t after) {
  const json grid = pit.get("/api/v1/surveys/" + survey.dump() + "/dod").json();
  const simulator::TrueGround& ground = pit.ground();
  REQUIRE_EQ(grid["columns"].get<std::uint32_t>(), ground.columns);
  REQUIRE_EQ(grid["rows"].get<std::uint32_t>(), ground.rows);
  double net_m3 = 0.0;
  for (std::size_t cell = 0; cell < ground.columns * std::size_t{ground.rows}; ++cell) {
    if (grid["rise_m"][cell].is_null()) continue;
    const double rise_m = ground.mean_height_m[after][cell] - ground.mean_height_m[before][cell];
    net_m3 += ground.cell_m * ground.cell_m * rise_m;
  }
  return net_m3;
}

double true_whole_net_m3(const PitWeek& pit, std::size_t before, std::size_t after) {
  const simulator::TrueGround& ground = pit.ground();
  double net_m3 = 0.0;
  for (std::size_t cell = 0; cell < ground.mean_height_m[before].size(); ++cell) {
    net_m3 += ground.cell_m * ground.cell_m * (ground.mean_height_m[after][cell] - ground.mean_height_m[before][cell]);
  }
  return net_m3;
}

TEST_CASE(
    "a week of nights runs through a schedule: volumes hold the truth, a night without scans is told, levels rise and "
    "clear") {
  PitWeek pit;
  const std::uint32_t missing = 3;
  for (std::uint32_t night = 0; night < 7; ++night) {
    if (night != missing) pit.upload_night(night);
  }
  // Every night more than 100 m3 are moved; no night moves a million.
  const json schedule = pit.add_schedule(
      {{"zones", {pit.zone()}},
       {"cell_m", pit.ground().cell_m},
       {"core_spacing_m", 4.0},
       {"density_t_per_m3", 2.65},
       {"thresholds",
        {{{"figure", "cut_m3"}, {"zone", pit.zone()}, {"yellow", 10.0}, {"orange", 20.0}, {"red", 1e6}},
         {{"figure", "net_m3"}, {"yellow", 1e6}}}}});
  const json runs = pit.finished_runs(schedule);
  REQUIRE_EQ(runs.size(), 9);  // and two nights of March, in which nothing was scanned
  std::vector<std::string> states;
  for (const json& run : runs) states.push_back(run["state"]);
  CHECK_EQ(states, std::vector<std::string>{"done", "done", "done", "no_scans", "done", "done", "done", "no_scans",
                                            "no_scans"});
  CHECK_EQ(runs[0]["survey"], nullptr);  // nothing to compare with
  std::map<std::size_t, std::size_t> earlier{{1, 0}, {2, 1}, {4, 2}, {5, 4}, {6, 5}};
  for (const auto& [night, before] : earlier) {
    CAPTURE(night);
    const json survey = runs[night]["survey"];
    REQUIRE(survey.is_number());
    const json figures = pit.get("/api/v1/surveys/" + survey.dump() + "/volumes").json()["zones"][0];
    const double truth_m3 = true_net_m3(pit, survey, before, night);
    CHECK_GE(truth_m3, figures["net"]["low_m3"].get<double>());
    CHECK_LE(truth_m3, figures["net"]["high_m3"].get<double>());
    CHECK_GE(true_whole_net_m3(pit, before, night), figures["whole"]["low_m3"].get<double>());
    CHECK_LE(true_whole_net_m3(pit, before, night), figures["whole"]["high_m3"].get<double>());
    CHECK_GT(figures["seen_share"].get<double>(), 0.2);
    CHECK_GT(pit.items("/api/v1/surveys/" + survey.dump() + "/changes").size(), 0);
  }
  std::map<std::string, std::vector<std::string>> alerts;
  for (const json& alert : pit.items("/api/v1/alerts?site=pit&limit=1000")) {
    alerts[alert["cause"]].push_back(alert["state"]);
  }
  // Newest first: of both nights of March one, and that of the missing night.
  CHECK_EQ(alerts["survey-missing"], std::vector<std::string>{"open", "resolved"});
  REQUIRE_EQ(alerts["survey-level"].size(), 1);  // raised once, by the first survey
  const json series =
      pit.get("/api/v1/surveys/series?figure=cut_m3&schedule=" + schedule["id"].dump() + "&zone=" + pit.zone().dump())
          .json();
  REQUIRE_EQ(series["values"].size(), 5);
  CHECK_EQ(series["values"][0]["level"], "orange");
  CHECK(series["cumulative"] == true);
  CHECK_GT(series["velocities"].size(), 0);
}

/// What every file of a survey begins with.
void check_files(PitWeek& pit, const std::string& survey) {
  const std::map<std::string, std::string> beginnings{
      {"dod.tif", "II"},     {"before.tif", "II"},       {"after.tif", "II"},    {"before.las", "LASF"},
      {"after.las", "LASF"}, {"changes.csv", "change,"}, {"zones.csv", "zone,"}, {"report.html", "<!DOCTYPE html>"},
      {"bundle.zip", "PK"},  {"map.geojson", "{"},
  };
  for (const auto& [file, beginning] : beginnings) {
    CAPTURE(file);
    const Reply reply = pit.get(survey + "/" + file);
    REQUIRE_EQ(reply.status, 200);
    CHECK_EQ(reply.body.substr(0, beginning.size()), beginning);
    CHECK_EQ(pit.get(survey + "/" + file, {{"If-None-Match", reply.header("ETag")}}).status, 304);
  }
  CHECK_EQ(json::parse(pit.get(survey + "/map.geojson").body)["type"], "FeatureCollection");
  const Reply report = pit.get(survey + "/report.html");
  CHECK_NE(report.header("Content-Security-Policy").find("default-src 'none'"), std::string::npos);
  CHECK_EQ(report.body.find("<script"), std::string::npos);
  CHECK_EQ(pit.get("/api/v1/surveys/999/bundle.zip").status, 404);
}

/// A quarter turn about the site's zero, and moved: x and y become 1000 - y and 2000 + x, heights 300 more.
const json kQuarterTurn = {
    {"mine_grid",
     {{"site_origin_m", {0.0, 0.0, 0.0}}, {"grid_origin_m", {1000.0, 2000.0, 300.0}}, {"rotation_deg", 90.0}}}};

/// Every file of a survey goes out in the mine grid of its site.
void check_mine_grid(PitWeek& pit, const std::string& survey) {
  const std::string plain_las = pit.get(survey + "/after.las").body;
  REQUIRE_EQ(pit.patch("/api/v1/sites/pit", kQuarterTurn).status, 200);
  const json change = pit.items(survey + "/changes").at(0);
  std::istringstream csv(pit.get(survey + "/changes.csv").body);
  std::string row, cell;
  std::getline(csv, row);
  std::getline(csv, row);
  std::istringstream cells(row);
  std::vector<std::string> texts;
  while (std::getline(cells, cell, ',')) texts.push_back(cell);
  const auto near = [](double value, double other) { CHECK_LT(std::abs(value - other), 1e-6); };
  near(std::stod(texts.at(2)), 1000.0 - change["centroid_m"][1].get<double>());
  near(std::stod(texts.at(3)), 2000.0 + change["centroid_m"][0].get<double>());
  near(std::stod(texts.at(4)), 300.0 + change["centroid_m"][2].get<double>());

  const json grid = pit.get(survey + "/dod").json();
  CHECK_EQ(grid["output"]["coordinates"], "mine_grid");
  near(grid["output"]["corner_m"][0], 1000.0 - grid["corner_m"][1].get<double>());
  near(grid["output"]["corner_m"][1], 2000.0 + grid["corner_m"][0].get<double>());
  near(grid["output"]["a_column_m"][1], grid["cell_m"]);
  near(grid["output"]["a_row_m"][0], -grid["cell_m"].get<double>());
  near(grid["output"]["above_site_m"], 300.0);

  const json map = json::parse(pit.get(survey + "/map.geojson").body);
  CHECK_EQ(map["coordinate_system"]["name"], "local mine grid");
  const json corner = map["features"][0]["geometry"]["coordinates"][0][0];
  const json zone = pit.get("/api/v1/zones/" + pit.zone().dump()).json();
  near(corner[0], 1000.0 - zone["polygon_m"][0][1].get<double>());
  near(corner[1], 2000.0 + zone["polygon_m"][0][0].get<double>());

  // The bounds in the header of LAS 1.4: greatest x at byte 179, then least x, greatest y, least y, and so on.
  const std::string las = pit.get(survey + "/after.las").body;
  const auto bound_m = [](const std::string& file, int number) {
    double value = 0.0;
    std::memcpy(&value, file.data() + 179 + 8 * number, sizeof value);
    return value;
  };
  near(bound_m(las, 0), 1000.0 - bound_m(plain_las, 3));
  near(bound_m(las, 2), 2000.0 + bound_m(plain_las, 0));
  near(bound_m(las, 4), 300.0 + bound_m(plain_las, 4));
  const std::string report = pit.get(survey + "/report.html").body;
  CHECK_NE(
      report.find("local mine grid: (1,000.000; 2,000.000; 300.000) is the place (0.000; 0.000; 0.000) of the site, "
                  "turned by 90.000000°, scale 1.00000000"),
      std::string::npos);
  CHECK_NE(report.find("grid N"), std::string::npos);
}

TEST_CASE("epochs are made by hand, accepted, compared by hand, and deleted") {
  PitWeek pit;
  for (const std::uint32_t night : {0u, 2u}) pit.upload_night(night);
  const auto epoch = [&](const std::string& day) {
    return pit.post(
        "/api/v1/epochs",
        {{"site", "pit"}, {"name", "night of " + day}, {"from", day + "T00:00:00Z"}, {"to", day + "T12:00:00Z"}});
  };
  const Reply before = epoch("2026-02-22"), after = epoch("2026-02-24");
  REQUIRE_EQ(before.status, 201);
  CHECK_EQ(before.json()["scans"].size(), 2);
  CHECK_EQ(pit.get(before.header("Location")).json()["name"], "night of 2026-02-22");
  CHECK_EQ(epoch("2026-02-23").complaint_about("from"), "there are no scans between 'from' and 'to'");
  const json ids{{"site", "pit"},
                 {"before", before.json()["id"]},
                 {"after", after.json()["id"]},
                 {"survey", {{"zones", {pit.zone()}}, {"cell_m", 2.0}, {"core_spacing_m", 8.0}}}};
  const Reply queued = pit.post("/api/v1/surveys", ids);
  REQUIRE_EQ(queued.status, 202);
  const json run = pit.finished(queued.json());
  REQUIRE_EQ(run["state"], "done");
  const json detail = pit.get("/api/v1/surveys/" + run["survey"].dump()).json();
  CHECK_EQ(detail["schedule"], nullptr);
  CHECK_EQ(detail["ground"]["scans"]["before"].size(), 2);
  CHECK_EQ(detail["ground"]["scans"]["after"][0]["sha256"].get<std::string>().size(), 64);
  CHECK_EQ(pit.items("/api/v1/surveys?site=pit").size(), 1);
  CHECK_EQ(pit.items("/api/v1/surveys/runs?site=pit").size(), 1);
  CHECK_EQ(pit.get("/api/v1/surveys/series?site=pit").json()["values"].size(), 1);
  const std::string binary = pit.get("/api/v1/surveys/" + run["survey"].dump() + "/dod?format=bin").body;
  CHECK_EQ(binary.substr(0, 4), "RWDG");
  CHECK_EQ(binary.size(), 48 + 4 * 4 * pit.ground().columns * std::size_t{pit.ground().rows});

  check_files(pit, "/api/v1/surveys/" + run["survey"].dump());
  check_mine_grid(pit, "/api/v1/surveys/" + run["survey"].dump());

  const std::string place = "/api/v1/epochs/" + before.json()["id"].dump();
  CHECK_EQ(pit.post(place + "/accept", json::object()).complaint_about("by"), "is required");
  CHECK_EQ(pit.post(place + "/accept", {{"by", "anna"}}).json()["state"], "accepted");
  CHECK_EQ(pit.remove("/api/v1/scans/" + before.json()["scans"][0].dump()).status, 409);
  json swapped = ids;
  std::swap(swapped["before"], swapped["after"]);
  CHECK_NE(pit.post("/api/v1/surveys", swapped).complaint_about("before"), "");
  json unknown = ids;
  unknown["after"] = 999999;
  CHECK_EQ(pit.post("/api/v1/surveys", unknown).complaint_about("after"),
           "must be an epoch of the site that was not refused");
  CHECK_EQ(pit.remove(place).status, 204);
  CHECK_EQ(pit.get(place).status, 404);
}

TEST_CASE("two time windows are surveyed once, without epochs made before; runs are cancelled by name") {
  PitWeek pit;
  for (const std::uint32_t night : {0u, 2u}) pit.upload_night(night);
  const auto window = [](const std::string& day) {
    return json{{"from", day + "T00:00:00Z"}, {"to", day + "T12:00:00Z"}};
  };
  json asked{{"site", "pit"},
             {"before", window("2026-02-22")},
             {"after", window("2026-02-24")},
             {"survey", {{"zones", {pit.zone()}}, {"cell_m", 2.0}, {"core_spacing_m", 8.0}}}};
  const auto complaint = [&](const char* member, json value, const std::string& about) {
    json wrong = asked;
    wrong[member] = std::move(value);
    return pit.post("/api/v1/surveys", wrong).complaint_about(about);
  };
  CHECK_EQ(complaint("before", window("2026-02-23"), "before.from"), "there are no scans between 'from' and 'to'");
  CHECK_EQ(complaint("after", window("2026-02-22"), "before"),
           "must end before the epoch 'after' begins, at 2026-02-22T00:00:00Z");
  CHECK_EQ(complaint("after", {{"from", "2026-02-24T00:00:00Z"}}, "after.to"), "is required");
  CHECK_EQ(complaint("after", nullptr, "after"), "must not be null");
  CHECK_NE(complaint("after", "yesterday", "after"), "");
  CHECK(pit.items("/api/v1/epochs?site=pit").empty());

  const Reply queued = pit.post("/api/v1/surveys", asked);
  REQUIRE_EQ(queued.status, 202);
  const json run = pit.finished(queued.json());
  REQUIRE_EQ(run["state"], "done");
  CHECK_EQ(pit.items("/api/v1/epochs?site=pit").size(), 2);
  const json detail = pit.get("/api/v1/surveys/" + run["survey"].dump()).json();
  CHECK_EQ(detail["ground"]["scans"]["before"].size(), 2);
  CHECK_EQ(detail["before"]["captured_at"], "2026-02-22T02:00:00Z");

  const std::string cancel = "/api/v1/surveys/runs/" + run["id"].dump() + "/cancel";
  CHECK_EQ(pit.post(cancel, json::object()).complaint_about("by"), "is required");
  CHECK_EQ(pit.post(cancel, {{"by", "anna"}}).status, 409);
  CHECK_EQ(pit.post("/api/v1/surveys/runs/999/cancel", {{"by", "anna"}}).status, 404);
}

TEST_CASE("schedules are made, read, replaced, refused and deleted") {
  PitWeek pit;
  const json schedule = pit.add_schedule({{"zones", {pit.zone()}}}, {{"since", format_rfc3339(fixture_now())}});
  CHECK_EQ(schedule["time_zone"], "Australia/Perth");
  CHECK_EQ(schedule["survey"]["reference"]["policy"], "previous");
  CHECK_EQ(schedule["next_run_at"], "2026-03-03T05:10:00Z");
  const std::string place = "/api/v1/schedules/" + schedule["id"].dump();
  const Reply got = pit.get(place);
  CHECK_EQ(pit.get(place, {{"If-None-Match", got.header("ETag")}}).status, 304);
  CHECK_EQ(pit.items("/api/v1/schedules?site=pit").size(), 1);
  const Reply run = pit.send("POST", place + "/run", "");
  REQUIRE_EQ(run.status, 202);
  const json ended = pit.finished(run.json());
  CHECK_EQ(ended["state"], "no_scans");
  CHECK_EQ(ended["to"], format_rfc3339(fixture_now()));
  CHECK_EQ(pit.items(place + "/runs").size(), 1);
  json changed{{"site", "pit"}, {"name", "weekly"}, {"cron", "@weekly"}, {"enabled", false}};
  const auto put = [&](const json& body, const std::string& tag) {
    return pit.send("PUT", place, body.dump(), {{"Content-Type", "application/json"}, {"If-Match", tag}});
  };
  CHECK_EQ(put(changed, "\"other\"").status, 412);
  CHECK_EQ(put(changed, got.header("ETag")).json()["next_run_at"], nullptr);
  const Reply wrong =
      pit.post("/api/v1/schedules",
               {{"site", "pit"},
                {"name", "x"},
                {"cron", "61 * * * *"},
                {"since", "2099-01-01T00:00:00Z"},
                {"survey",
                 {{"cell_m", 0.0}, {"reference", {{"policy", "days_ago"}}}, {"thresholds", {{{"figure", "width"}}}}}}});
  REQUIRE_EQ(wrong.status, 422);
  CHECK_EQ(wrong.complaint_about("cron"), "minute: \"61\": must be 0 to 59");
  CHECK_EQ(wrong.complaint_about("since"), "must not be later than now");
  CHECK_EQ(wrong.complaint_about("survey.cell_m"), "must be 0.02 to 100");
  CHECK_NE(wrong.complaint_about("survey.reference.days"), "");
  CHECK_NE(wrong.complaint_about("survey.thresholds.0.figure"), "");
  CHECK_EQ(
      pit.post("/api/v1/schedules", {{"site", "pit"}, {"name", "x"}, {"cron", "@daily"}, {"survey", {{"zones", {99}}}}})
          .status,
      404);
  CHECK_EQ(pit.remove(place).status, 204);
  CHECK_EQ(pit.get(place).status, 404);
}

}  // namespace
}  // namespace raywatch::testing
