#include <doctest/doctest.h>

#include <chrono>
#include <thread>

#include "tests/api/api_fixture.hpp"
#include "tests/api/event_listener.hpp"

namespace raywatch::testing {
namespace {

using nlohmann::json;

constexpr WallScene kBox{.box = true};

/// Asks again and again until `holds`, for a while.
template <class Holds>
bool comes_true(const Holds& holds) {
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(30);
  while (!holds()) {
    if (std::chrono::steady_clock::now() > deadline) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  return true;
}

/// A site of which the first three scans are normal, and some more.
struct StoredYard : ApiFixture {
  explicit StoredYard(DaemonConfig config = {}) : ApiFixture(std::move(config)) {
    make_site_and_sensor();
    for (int i = 0; i < 3; ++i) upload(i);
    for (int i = 3; i < 6; ++i) upload(i, i == 4 ? kBox : WallScene{});
  }
  json items(const std::string& target) { return get(target).json()["items"]; }
  json preview(const json& limits) {
    const Reply reply = post("/api/v1/storage/retention/preview", limits);
    REQUIRE_EQ(reply.status, 200);
    return reply.json()["items"][0];
  }
  double metric(const std::string& name) {
    const std::string text = get("/metrics").body;
    return std::stod(text.substr(text.find("\n" + name + " ") + name.size() + 2));
  }
};

TEST_CASE("the storage says what lies where, and what is left") {
  StoredYard yard;
  const json storage = yard.get("/api/v1/storage").json();
  REQUIRE_EQ(storage["sites"].size(), 1);
  CHECK_EQ(storage["sites"][0]["site"], "yard");
  CHECK_GT(storage["sites"][0]["payload_bytes_in_use"].get<double>(), 6 * 10'000);
  CHECK_EQ(storage["sites"][0]["retention"]["max_age_days"], nullptr);
  // All came at one moment of the fixture's clock: that tells no rate.
  CHECK_EQ(storage["sites"][0]["bytes_per_day"], nullptr);
  CHECK_EQ(storage["disk"]["days_to_full"], nullptr);
  CHECK_GT(storage["metadata_bytes"].get<double>(), 0.0);
  CHECK_GE(storage["events"]["events"].get<int>(), 12);
  CHECK_GT(storage["disk"]["bytes"].get<double>(), storage["disk"]["free_bytes"].get<double>());
  CHECK_EQ(storage["disk"]["reserve_bytes"].get<std::uint64_t>(), DaemonConfig{}.min_free_disk_bytes);
}

TEST_CASE("a preview says what would go and what would stay, and deletes nothing") {
  StoredYard yard;
  const json nothing = yard.preview(json::object());
  CHECK_EQ(nothing["scans"], 0);
  CHECK(nothing["reached"].get<bool>());
  const json all = yard.preview({{"site", "yard"}, {"max_bytes", 1}});
  CHECK_EQ(all["scans"], 3);
  CHECK_EQ(all["reasons"]["bytes"], 3);
  CHECK_EQ(all["protected"], json({{"baseline", 3}}));
  CHECK_FALSE(all["reached"].get<bool>());
  CHECK_GT(all["bytes"].get<int>(), 10'000);
  CHECK_EQ(all["oldest_received_at"], format_rfc3339(fixture_now()));
  CHECK_EQ(yard.items("/api/v1/scans").size(), 6);
  CHECK_EQ(yard.post("/api/v1/storage/retention/preview", {{"site", "nowhere"}}).status, 404);
  CHECK_NE(yard.post("/api/v1/storage/retention/preview", {{"max_bytes", -1}}).complaint_about("max_bytes"), "");
  CHECK_NE(yard.post("/api/v1/storage/retention/preview", {{"max_days", 1}}).complaint_about("max_days"), "");
}

TEST_CASE("a site has limits of its own: null is as for all sites, 0 none, and what is not given stays") {
  DaemonConfig config;
  config.retention.defaults.max_age_days = 30;
  ApiFixture api(config);
  api.make_site_and_sensor();
  const auto edit = [&](const json& limits) {
    const Reply reply = api.patch("/api/v1/sites/yard", {{"retention", limits}});
    REQUIRE_EQ(reply.status, 200);
    return reply.json()["retention"];
  };
  const auto in_force = [&] { return api.get("/api/v1/storage").json()["sites"][0]["retention"]; };
  CHECK_EQ(in_force()["max_age_days"], 30);
  CHECK_EQ(edit({{"max_age_days", 0}}),
           json({{"max_age_days", 0}, {"max_bytes", nullptr}, {"min_free_bytes", nullptr}}));
  CHECK_EQ(in_force()["max_age_days"], nullptr);
  CHECK_EQ(edit({{"max_bytes", 5'000'000'000}})["max_age_days"], 0);
  CHECK_EQ(edit({{"max_age_days", nullptr}})["max_bytes"], 5'000'000'000);
  CHECK_EQ(in_force()["max_age_days"], 30);
  CHECK_NE(api.patch("/api/v1/sites/yard", {{"retention", {{"max_age_days", "long"}}}})
               .complaint_about("retention.max_age_days"),
           "");
  CHECK_NE(api.patch("/api/v1/sites/yard", {{"retention", nullptr}}).complaint_about("retention"), "");
}

TEST_CASE("a limit that is misspelt is answered with the one that was meant") {
  ApiFixture api;
  const Reply reply = api.post("/api/v1/sites", {{"name", "yard"}, {"retention", {{"max_age", 1}}}});
  CHECK_EQ(reply.complaint_about("retention.max_age"), "unknown member; did you mean 'max_age_days'?");
}

TEST_CASE("retention deletes what is too much, records it, and what others say about it stays") {
  StoredYard yard;
  const json last = yard.items("/api/v1/scans")[0];
  REQUIRE_EQ(yard.patch("/api/v1/scans/" + last["id"].dump(), {{"pinned", true}}).status, 200);
  const std::string comparison = "/api/v1/comparisons/" + last["comparison"].dump();
  const json before = yard.get(comparison).json();
  REQUIRE_GE(before["priors"].size(), 1);
  REQUIRE_EQ(yard.patch("/api/v1/sites/yard", {{"retention", {{"max_bytes", 1}}}}).status, 200);
  CHECK(comes_true([&] { return yard.items("/api/v1/scans").size() == 4; }));
  CHECK(comes_true([&] { return yard.metric("raywatch_retention_scans_deleted_total") == 2.0; }));
  CHECK_EQ(yard.get(comparison).json(), before);
  CHECK_EQ(yard.get("/api/v1/scans/4").status, 404);

  const json deletions = yard.items("/api/v1/storage/deletions?site=yard");
  REQUIRE_EQ(deletions.size(), 2);
  CHECK_EQ(deletions[1]["scan"], 4);
  CHECK_EQ(deletions[1]["reason"], "bytes");
  CHECK_EQ(deletions[1]["sensor"], "gate");
  CHECK_GT(deletions[1]["bytes"].get<int>(), 1000);
  int told = 0;
  for (const json& event : yard.items("/api/v1/events/log?limit=1000")) told += event["type"] == "scan.deleted" ? 1 : 0;
  CHECK_EQ(told, 2);
}

TEST_CASE("the points of a comparison whose prior was deleted are there but for those that only the prior had") {
  DaemonConfig config;
  config.watch.learn_scans = 1;
  ApiFixture api(config);
  api.make_site_and_sensor();
  api.upload(0);
  api.upload(1, kBox);
  const json after_box = api.upload(2);
  REQUIRE_EQ(api.patch("/api/v1/scans/3", {{"pinned", true}}).status, 200);
  const std::string points = "/api/v1/comparisons/" + after_box["comparison"].dump() + "/points?format=csv";
  REQUIRE_EQ(api.get(points).status, 200);
  REQUIRE_EQ(api.post("/api/v1/baselines/yard/accept", {{"by", "anna"}, {"scans", {1}}, {"mode", "replace"}}).status,
             201);
  for (const json& alert : api.get("/api/v1/alerts").json()["items"]) {
    api.post("/api/v1/alerts/" + alert["id"].dump() + "/resolve", {{"by", "anna"}});
  }
  REQUIRE_EQ(api.patch("/api/v1/sites/yard", {{"retention", {{"max_bytes", 1}}}}).status, 200);
  REQUIRE(comes_true([&] { return api.get("/api/v1/scans/2").status == 404; }));
  const Reply refused = api.get(points);
  CHECK_EQ(refused.status, 404);
  CHECK(refused.json()["detail"].get<std::string>().find("Scan 2, a prior") != std::string::npos);
  CHECK_EQ(api.get(points + "&class=unchanged,added").status, 200);
}

TEST_CASE("a scan that an operator deletes is recorded, too") {
  ApiFixture api;
  api.make_site_and_sensor();
  const json scan = api.upload(0);
  REQUIRE_EQ(api.remove("/api/v1/scans/" + scan["id"].dump()).status, 204);
  const json deletions = api.get("/api/v1/storage/deletions").json()["items"];
  REQUIRE_EQ(deletions.size(), 1);
  CHECK_EQ(deletions[0]["reason"], "operator");
  CHECK_EQ(deletions[0]["scan"], scan["id"]);
}

TEST_CASE("what a client missed and is not kept any more is told as a gap, never left out without a word") {
  DaemonConfig config;
  config.retention.events_max_age = std::chrono::days(-1);  // nothing older than tomorrow is kept
  ApiFixture api(config);
  api.make_site_and_sensor();
  api.upload(0);
  const auto kept = [&] { return api.get("/api/v1/events/log").json()["items"]; };
  REQUIRE(comes_true([&] { return kept().size() == 1; }));
  const json last = kept()[0];
  const json gap = api.get("/api/v1/events/log?after=1").json()["gap"];
  CHECK_EQ(gap["after"], 1);
  CHECK_EQ(gap["id"], last["id"].get<int>() - 1);
  CHECK_EQ(api.get("/api/v1/events/log?after=" + gap["id"].dump()).json()["gap"], nullptr);
  const json streamed = EventListener(api.port(), "", "1").take(2);
  CHECK_EQ(streamed[0], gap);
  CHECK_EQ(streamed[1], last);
}

TEST_CASE("a client that knows more than the store is told that as a gap, too") {
  ApiFixture api;
  api.make_site_and_sensor();
  api.upload(0);
  const json events = api.get("/api/v1/events/log").json()["items"];
  EventListener listener(api.port(), "", "1000000");
  const json gap = listener.take(1)[0];
  CHECK_EQ(gap["type"], "gap");
  CHECK_EQ(gap["id"], events.back()["id"]);
  api.upload(1);
  CHECK_EQ(listener.take(1)[0]["id"], events.back()["id"].get<int>() + 1);
}

}  // namespace
}  // namespace raywatch::testing
