#include <doctest/doctest.h>

#include <chrono>
#include <random>
#include <set>
#include <thread>

#include "storage/store.hpp"
#include "storage/sweep.hpp"
#include "tests/end_to_end/api_client.hpp"
#include "tests/end_to_end/daemon_process.hpp"
#include "tests/simulator/family.hpp"
#include "tests/support/temp_dir.hpp"

using namespace raywatch::test;
namespace simulator = raywatch::simulator;
using nlohmann::json;

namespace {

/// Two nights of a simulated pit, in whose slopes scans are registered: its time windows, surveyed so finely
/// that it takes a while.
json survey_of_the_pit() {
  return {{"site", "yard"},
          {"before", {{"from", "2026-02-22T00:00:00Z"}, {"to", "2026-02-23T00:00:00Z"}}},
          {"after", {{"from", "2026-02-23T00:00:00Z"}, {"to", "2026-02-24T00:00:00Z"}}},
          {"survey", {{"cell_m", 1.0}, {"core_spacing_m", 1.0}}}};
}

void set_up(const std::filesystem::path& data_dir) {
  const simulator::Timeline pit = make_timeline(
      simulator::Family::pit, {.seed = 3, .density = 0.5, .start = raywatch::parse_rfc3339("2026-02-22T02:00:00Z")});
  DaemonProcess daemon(data_dir);
  ApiClient api(daemon.url());
  REQUIRE(api.post("/api/v1/sites", {{"name", "yard"}, {"profile", "survey"}}).status == 201);
  REQUIRE(api.post("/api/v1/sensors", {{"name", "gate"}, {"site", "yard"}}).status == 201);
  for (std::size_t moment = 0; moment < 4; ++moment) {  // two stations each night
    simulator::SimulatedScan scan = take_scan(pit, pit.moments.at(moment));
    const PlaceScan sent{std::move(scan.points), scan.reported_world_from_sensor, scan.captured_at};
    REQUIRE(api.upload(sent, std::chrono::seconds(50)).status == 201);
  }
  api.wait_for_all_scans();
  REQUIRE(daemon.stop() == 0);
}

/// Waits until the run is in none of `states`.
json wait_past(ApiClient& api, const json& run, const std::set<std::string>& states) {
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::minutes(2);
  for (;;) {
    const json now = api.get("/api/v1/surveys/runs/" + run["id"].dump()).json();
    if (!states.contains(now["state"])) return now;
    REQUIRE(std::chrono::steady_clock::now() < deadline);
    std::this_thread::yield();
  }
}

const std::set<std::string> kUnfinished{"queued", "running"};

json volumes_of(ApiClient& api, const json& run) {
  REQUIRE_MESSAGE(run["survey"].is_number(), run.dump());
  json volumes = api.get("/api/v1/surveys/" + run["survey"].dump() + "/volumes").json();
  volumes.erase("survey");
  return volumes;
}

}  // namespace

TEST_CASE("after kill -9 at any moment of a survey it begins again, gives one result, and leaves nothing unowned") {
  const raywatch::TempDir folder;
  const std::filesystem::path data_dir = folder.path() / "data";
  set_up(data_dir);
  std::mt19937 random(20260302);
  std::uniform_int_distribution<int> moment_us(0, 400'000);
  std::vector<json> asked;
  for (int round = 0; round < 5; ++round) {
    DaemonProcess daemon(data_dir);
    ApiClient api(daemon.url());
    const ApiReply reply = api.post("/api/v1/surveys", survey_of_the_pit());
    REQUIRE_MESSAGE(reply.status == 202, reply.body);
    asked.push_back(reply.json());
    // The moment of the crash is what this test varies; nothing waits for it.
    std::this_thread::sleep_for(std::chrono::microseconds(moment_us(random)));
    daemon.kill();
  }
  {
    DaemonProcess daemon(data_dir);
    ApiClient api(daemon.url());
    std::set<json> surveys;
    json first;
    int repeated = 0;
    for (const json& run : asked) {
      const json ended = wait_past(api, run, kUnfinished);
      CHECK(ended["state"] == "done");
      const json volumes = volumes_of(api, ended);
      if (first.is_null()) first = volumes;
      CHECK(volumes == first);
      surveys.insert(ended["survey"]);
      if (ended["attempts"] > 1) ++repeated;
    }
    CHECK(surveys.size() == asked.size());
    CHECK(api.get("/api/v1/surveys?limit=1000").json()["items"].size() == asked.size());
    CHECK(first["total"]["seen_area_m2"] > 0.0);
    CHECK(repeated > 0);  // at least one was killed while it ran
    CHECK(daemon.stop() == 0);
  }
  const raywatch::Store store({.data_dir = data_dir, .readers = 1});
  CHECK(store.open_report().swept_payloads == 0);
  CHECK(store.open_report().swept_spool_files == 0);
  CHECK(store.open_report().warnings.empty());
}

TEST_CASE(
    "the daemon stops within five seconds of SIGTERM during a survey, which begins again and was not tried in vain") {
  const raywatch::TempDir folder;
  set_up(folder.path() / "data");
  json run;
  {
    DaemonProcess daemon(folder.path() / "data");
    ApiClient api(daemon.url());
    run = api.post("/api/v1/surveys", survey_of_the_pit()).json();
    REQUIRE(wait_past(api, run, {"queued"})["state"] == "running");
    const auto asked = std::chrono::steady_clock::now();
    CHECK(daemon.stop() == 0);
    CHECK(std::chrono::steady_clock::now() - asked < std::chrono::seconds(5));
  }
  DaemonProcess daemon(folder.path() / "data");
  ApiClient api(daemon.url());
  const json ended = wait_past(api, run, kUnfinished);
  CHECK(ended["state"] == "done");
  CHECK(ended["attempts"] == 1);
  CHECK(daemon.stop() == 0);
}

TEST_CASE("a survey that runs is cancelled, and the next one is carried out") {
  const raywatch::TempDir folder;
  set_up(folder.path() / "data");
  DaemonProcess daemon(folder.path() / "data");
  ApiClient api(daemon.url());
  const json run = api.post("/api/v1/surveys", survey_of_the_pit()).json();
  REQUIRE(wait_past(api, run, {"queued"})["state"] == "running");
  const std::string cancel = "/api/v1/surveys/runs/" + run["id"].dump() + "/cancel";
  const ApiReply cancelled = api.post(cancel, {{"by", "anna"}, {"note", "the wrong zone"}});
  REQUIRE(cancelled.status == 200);
  CHECK(cancelled.json()["state"] == "cancelled");
  CHECK(cancelled.json()["why"] == "cancelled by anna: the wrong zone");
  CHECK(api.post(cancel, {{"by", "anna"}}).status == 409);
  const json next = wait_past(api, api.post("/api/v1/surveys", survey_of_the_pit()).json(), kUnfinished);
  CHECK(next["state"] == "done");
  CHECK(api.get("/api/v1/surveys").json()["items"].size() == 1);
  CHECK(daemon.log().find("cannot go on") == std::string::npos);
  CHECK(daemon.stop() == 0);
}
