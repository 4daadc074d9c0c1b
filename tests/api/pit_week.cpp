#include "tests/api/pit_week.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <chrono>
#include <thread>

#include "tests/simulator/family.hpp"

namespace raywatch::testing {

using nlohmann::json;

PitWeek::PitWeek()
    : timeline_(make_timeline(simulator::Family::pit,
                              {.seed = 3, .density = 0.5, .start = parse_rfc3339("2026-02-22T02:00:00Z")})) {
  const json site{{"name", "pit"}, {"time_zone", "Australia/Perth"}, {"profile", "survey"}};
  REQUIRE_EQ(post("/api/v1/sites", site).status, 201);
  for (const char* sensor : {"pit-1", "pit-2"}) {
    REQUIRE_EQ(post("/api/v1/sensors", {{"name", sensor}, {"site", "pit"}}).status, 201);
  }
  const simulator::TrueGround& ground = timeline_.ground;
  const double x = ground.corner_m.x(), y = ground.corner_m.y();
  const double right = x + ground.cell_m * ground.columns, top = y + ground.cell_m * ground.rows;
  const Reply zone = post("/api/v1/zones", {{"site", "pit"},
                                            {"name", "bench"},
                                            {"kind", "volume"},
                                            {"polygon_m", {{x, y}, {right, y}, {right, top}, {x, top}}},
                                            {"z_min_m", -1.0},
                                            {"z_max_m", 40.0}});
  REQUIRE_EQ(zone.status, 201);
  zone_ = zone.json()["id"];
}

void PitWeek::upload_night(std::uint32_t night) {
  for (std::size_t i = 2 * night; i < 2 * night + 2; ++i) {
    const simulator::SimulatedScan scan = take_scan(timeline_, timeline_.moments.at(i));
    const Reply reply = upload_bytes(pcd_of(scan.points, scan.reported_world_from_sensor),
                                     "sensor=" + scan.sensor + "&captured_at=" + format_rfc3339(scan.captured_at),
                                     {{"Prefer", "wait=50"}});
    REQUIRE_EQ(reply.status, 201);
    REQUIRE_EQ(reply.json()["state"], "compared");
  }
}

json PitWeek::add_schedule(const json& survey, const json& more) {
  json schedule{{"site", "pit"},     {"name", "nightly"}, {"cron", "0 13 * * *"}, {"since", "2026-02-21T06:00:00Z"},
                {"catch_up", "all"}, {"survey", survey}};
  schedule.update(more);
  const Reply reply = post("/api/v1/schedules", schedule);
  REQUIRE_EQ(reply.status, 201);
  return reply.json();
}

json PitWeek::finished(json run) {
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(60);
  while (run["state"] == "queued" || run["state"] == "running") {
    REQUIRE(std::chrono::steady_clock::now() < deadline);
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    run = get("/api/v1/surveys/runs/" + run["id"].dump()).json();
  }
  return run;
}

json PitWeek::finished_runs(const json& schedule) {
  const std::string target = "/api/v1/schedules/" + schedule["id"].dump() + "/runs?limit=1000";
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(60);
  json runs = items(target);
  const auto is_there = [&] { return !runs.empty(); };
  while (!is_there()) {
    REQUIRE(std::chrono::steady_clock::now() < deadline);
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    runs = items(target);
  }
  for (const json& run : runs) finished(run);
  runs = items(target);
  std::reverse(runs.begin(), runs.end());
  return runs;
}

json PitWeek::items(const std::string& target) {
  const Reply reply = get(target);
  REQUIRE_EQ(reply.status, 200);
  return reply.json()["items"];
}

}  // namespace raywatch::testing
