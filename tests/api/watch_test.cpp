#include <doctest/doctest.h>

#include "tests/api/api_fixture.hpp"
#include "tests/api/event_listener.hpp"

namespace raywatch::testing {
namespace {

using nlohmann::json;

const WallScene kBox{.box = true};
const json kGate = {{"site", "yard"},  {"name", "gate"},
                    {"kind", "alert"}, {"polygon_m", {{90, 195}, {99, 195}, {99, 205}, {90, 205}}},
                    {"z_min_m", 0.0},  {"z_max_m", 3.0}};

struct WatchedYard : ApiFixture {
  WatchedYard() { make_site_and_sensor(); }

  json scan(const WallScene& scene = {}) { return upload(number_++, scene); }
  void learn() {
    for (int i = 0; i < 3; ++i) scan();
  }
  /// Learns the place, puts the box and waits for its alert.
  json alert_of_box() {
    learn();
    scan(kBox);
    scan(kBox);
    const json alerts = items("/api/v1/alerts");
    REQUIRE_EQ(alerts.size(), 1);
    return get("/api/v1/alerts/" + alerts[0]["id"].dump()).json();
  }
  json items(const std::string& target) { return get(target).json()["items"]; }

 private:
  int number_ = 0;
};

TEST_CASE("a new site tells of whatever lasts, by a rule that can be read and changed") {
  WatchedYard yard;
  const json rules = yard.items("/api/v1/rules?site=yard");
  REQUIRE_EQ(rules.size(), 1);
  CHECK_EQ(rules[0]["name"], "anything that lasts");
  CHECK_EQ(rules[0]["zone"], nullptr);
  CHECK_EQ(rules[0]["persistence"]["scans"], 2);
  CHECK_EQ(rules[0]["kinds"], json({"added", "removed"}));
}

TEST_CASE("an alert says why it was raised, and each step stands in its history") {
  WatchedYard yard;
  const json alert = yard.alert_of_box();
  CHECK_EQ(alert["state"], "open");
  CHECK_EQ(alert["cause"], "change");
  CHECK_EQ(alert["severity"], "warning");
  CHECK_EQ(alert["why"]["rule"]["name"], "anything that lasts");
  CHECK_EQ(alert["why"]["track"]["kind"], "added");
  CHECK(alert["why"]["track"]["centroid_m"][0].get<double>() == doctest::Approx(95.5).epsilon(0.001));
  CHECK_EQ(alert["why"]["observations"][0]["scans"], 2);
  CHECK_EQ(alert["why"]["changes"].size(), 1);
  CHECK_FALSE(alert["why"]["priors"].empty());

  const std::string target = "/api/v1/alerts/" + alert["id"].dump();
  const Reply acknowledged = yard.post(target + "/acknowledge", {{"by", "anna"}, {"note", "on my way"}});
  CHECK_EQ(acknowledged.status, 200);
  CHECK_EQ(acknowledged.json()["state"], "acknowledged");
  const json resolved = yard.post(target + "/resolve", {{"by", "anna"}}).json();
  REQUIRE_EQ(resolved["history"].size(), 3);
  CHECK_EQ(resolved["history"][1]["note"], "on my way");
  CHECK_EQ(resolved["history"][2]["by"], "anna");
  CHECK_EQ(yard.post(target + "/acknowledge", {{"by", "anna"}}).status, 409);
  CHECK_EQ(yard.items("/api/v1/alerts?site=yard&state=open").size(), 0);
  CHECK_EQ(yard.items("/api/v1/alerts?site=yard&state=resolved").size(), 1);
  yard.scan(kBox);  // an operator resolved it: it does not come back
  CHECK_EQ(yard.items("/api/v1/alerts").size(), 1);
}

TEST_CASE("a track is listed by kind and time, with its alerts and what it was made of") {
  WatchedYard yard;
  const json alert = yard.alert_of_box();
  const json tracks = yard.items("/api/v1/tracks?kind=added");
  REQUIRE_EQ(tracks.size(), 1);
  CHECK_EQ(yard.items("/api/v1/tracks?kind=removed").size(), 0);
  CHECK_EQ(yard.items("/api/v1/tracks?to=" + tracks[0]["first_seen_at"].get<std::string>()).size(), 0);
  CHECK_EQ(yard.items("/api/v1/tracks?from=" + tracks[0]["last_seen_at"].get<std::string>()).size(), 1);
  CHECK_NE(yard.get("/api/v1/tracks?kind=gone").complaint_about("kind"), "");
  const std::string backwards = "from=2026-03-02T00:00:00Z&to=2026-03-01T00:00:00Z";
  for (const std::string list : {"tracks?", "changes?", "history?site=yard&point=0,0,0&"}) {
    CAPTURE(list);
    CHECK_EQ(yard.get("/api/v1/" + list + backwards).complaint_about("to"), "must be later than 'from'");
  }

  const std::string target = "/api/v1/tracks/" + tracks[0]["id"].dump();
  const json alerts = yard.get(target).json()["alerts"];
  REQUIRE_EQ(alerts.size(), 1);
  CHECK_EQ(alerts[0]["id"], alert["id"]);
  const json changes = yard.items(target + "/changes");
  REQUIRE_EQ(changes.size(), 2);
  CHECK_EQ(changes[0]["id"], tracks[0]["latest_change"]);
  for (const json& change : changes) CHECK_EQ(change["track"], tracks[0]["id"]);
  CHECK_EQ(yard.get("/api/v1/tracks/99/changes").status, 404);
}

TEST_CASE("a calendar counts what happened on each day of the site's time zone") {
  WatchedYard yard;
  yard.patch("/api/v1/sites/yard", {{"time_zone", "Europe/Berlin"}});
  yard.alert_of_box();
  const json calendar = yard.get("/api/v1/calendar?site=yard&from=2026-03-01T12:00:00Z&to=2026-03-02T12:00:00Z").json();
  CHECK_EQ(calendar["time_zone"], "Europe/Berlin");
  REQUIRE_EQ(calendar["days"].size(), 2);
  const json& first = calendar["days"][0];
  CHECK_EQ(first["date"], "2026-03-01");
  CHECK_EQ(first["from"], "2026-02-28T23:00:00Z");
  CHECK_EQ(first["scans"], 5);
  CHECK_EQ(first["tracks"], 1);
  CHECK_EQ(calendar["days"][1]["from"], first["to"]);
  CHECK_EQ(calendar["days"][1]["scans"], 0);
  CHECK_EQ(first["alerts"].get<int>() + calendar["days"][1]["alerts"].get<int>(), 1);

  // The clocks go forward: this day has 23 hours.
  const json march = yard.get("/api/v1/calendar?site=yard&from=2026-03-29T10:00:00Z&to=2026-03-29T11:00:00Z").json();
  REQUIRE_EQ(march["days"].size(), 1);
  CHECK_EQ(march["days"][0]["from"], "2026-03-28T23:00:00Z");
  CHECK_EQ(march["days"][0]["to"], "2026-03-29T22:00:00Z");

  const std::string range = "/api/v1/calendar?site=yard&from=2026-03-01T12:00:00Z&to=";
  CHECK_EQ(yard.get(range + "2026-03-01T12:00:00Z").complaint_about("to"), "must be later than 'from'");
  CHECK_EQ(yard.get(range + "2028-03-01T12:00:00Z").complaint_about("to"), "must be at most 400 days after 'from'");
  CHECK_EQ(yard.get("/api/v1/calendar?site=yard").complaint_about("from"), "is required");
  const std::string centuries = "/api/v1/calendar?site=yard&from=1700-01-01T00:00:00Z&to=2200-01-01T00:00:00Z";
  CHECK_EQ(yard.get(centuries).complaint_about("to"), "must be at most 400 days after 'from'");
}

TEST_CASE("the evidence of a change is its points, what is around them, and the rays that went through its place") {
  WatchedYard yard;
  const json alert = yard.alert_of_box();
  const std::string target = "/api/v1/changes/" + alert["why"]["changes"][0].dump() + "/evidence";
  const json added = yard.get(target).json();
  CHECK_EQ(added["kind"], "added");
  REQUIRE_EQ(added["changed"].size(), 1);
  CHECK_EQ(added["changed"][0]["scan"], alert["scan"]);
  CHECK_EQ(added["changed"][0]["count"], box_points());
  for (const json& point : added["changed"][0]["positions_m"]) CHECK_EQ(point[0], doctest::Approx(95.5).epsilon(1e-4));
  CHECK_EQ(added["surroundings"].size(), 1 + alert["why"]["priors"].size());
  // The prior's rays end at the wall, ten metres before the sensor, and pass where the box is.
  REQUIRE_EQ(added["rays"].size(), alert["why"]["priors"].size());
  const json& rays = added["rays"][0];
  CHECK_EQ(rays["scan"], alert["why"]["priors"][0]);
  CHECK_GE(rays["count"].get<std::size_t>(), box_points());
  for (const json& end : rays["to_m"]) CHECK_EQ(end[0], doctest::Approx(90.0).epsilon(1e-4));

  const json few = yard.get(target + "?margin_m=5&points=3&rays=2").json();
  CHECK_LE(few["changed"][0]["positions_m"].size(), 3);
  CHECK_LE(few["rays"][0]["to_m"].size(), 2);
  CHECK_EQ(few["rays"][0]["count"], rays["count"]);
  CHECK_NE(yard.get(target + "?rays=0").complaint_about("rays"), "");
  CHECK_EQ(yard.get("/api/v1/changes/999/evidence").status, 404);
}

TEST_CASE("what was removed is proved by the rays of the scan that misses it") {
  WatchedYard yard;
  for (int i = 0; i < 3; ++i) yard.scan(kBox);
  yard.scan();
  const json stolen = yard.scan();
  const json changes = yard.items("/api/v1/changes?reference=baseline&kind=removed");
  REQUIRE_FALSE(changes.empty());
  const json evidence = yard.get("/api/v1/changes/" + changes[0]["id"].dump() + "/evidence").json();
  REQUIRE_FALSE(evidence["changed"].empty());
  CHECK_NE(evidence["changed"][0]["scan"], stolen["id"]);
  REQUIRE_EQ(evidence["rays"].size(), 1);
  CHECK_EQ(evidence["rays"][0]["scan"], stolen["id"]);
  CHECK_GE(evidence["rays"][0]["count"].get<std::size_t>(), box_points());
}

TEST_CASE("an action needs who does it, and a snooze an end that lies ahead") {
  WatchedYard yard;
  const std::string target = "/api/v1/alerts/" + yard.alert_of_box()["id"].dump();
  CHECK_EQ(yard.post(target + "/acknowledge", json::object()).complaint_about("by"), "is required");
  CHECK_EQ(yard.post(target + "/snooze", {{"by", "anna"}}).complaint_about("until"), "is required");
  CHECK_NE(yard.post(target + "/snooze", {{"by", "anna"}, {"until", "2026-03-01T00:00:00Z"}}).complaint_about("until"),
           "");
  const Reply snoozed = yard.post(target + "/snooze", {{"by", "anna"}, {"until", "2030-01-01T00:00:00Z"}});
  CHECK_EQ(snoozed.json()["state"], "snoozed");
  CHECK_EQ(yard.post(target + "/resolve", {{"by", "anna"}}, {{"If-Match", "\"other\""}}).status, 412);
  CHECK_EQ(yard.post(target + "/resolve", {{"by", "anna"}}, {{"If-Match", snoozed.header("ETag")}}).status, 200);
  CHECK_EQ(yard.post("/api/v1/alerts/99/resolve", {{"by", "anna"}}).status, 404);
}

TEST_CASE("what is accepted is normal from then on, and its theft is told") {
  WatchedYard yard;
  const json alert = yard.alert_of_box();
  const json accepted =
      yard.post("/api/v1/alerts/" + alert["id"].dump() + "/accept", {{"by", "anna"}, {"note", "ours"}}).json();
  CHECK_EQ(accepted["state"], "resolved");
  CHECK_EQ(accepted["history"].back()["action"], "accepted");
  const json baseline = yard.items("/api/v1/baselines?site=yard");
  REQUIRE_EQ(baseline.size(), 4);
  CHECK_EQ(baseline[0]["kind"], "accepted");
  CHECK_EQ(baseline[0]["by"], "anna");
  CHECK_EQ(baseline[0]["note"], "ours");
  REQUIRE_EQ(baseline[0]["entries"].size(), 4);
  const json region = baseline[0]["entries"][3]["region_m"];
  CHECK(region["min"][0].get<double>() < 95.5);
  CHECK(region["max"][0].get<double>() > 95.5);

  yard.scan(kBox);
  yard.scan(kBox);
  CHECK_EQ(yard.items("/api/v1/changes?reference=baseline").size(), 2);  // those before it was accepted
  CHECK_EQ(yard.items("/api/v1/alerts?state=open").size(), 0);
  yard.scan();
  yard.scan();
  const json stolen = yard.items("/api/v1/alerts?state=open");
  REQUIRE_EQ(stolen.size(), 1);
  const std::string severity = stolen[0]["severity"], other = severity == "info" ? "critical" : "info";
  CHECK_EQ(yard.items("/api/v1/alerts?state=open&severity=" + severity).size(), 1);
  CHECK_EQ(yard.items("/api/v1/alerts?site=yard&severity=" + other).size(), 0);
  CHECK_EQ(yard.get("/api/v1/tracks/" + stolen[0]["track"].dump()).json()["kind"], "removed");
}

TEST_CASE("what is normal can be set, extended and learned anew, and every version stays readable") {
  WatchedYard yard;
  yard.learn();
  const json with_box = yard.scan(kBox);
  const std::string target = "/api/v1/baselines/yard/accept";
  const Reply replaced = yard.post(target, {{"by", "anna"}, {"mode", "replace"}, {"scans", {with_box["id"]}}});
  CHECK_EQ(replaced.status, 201);
  CHECK_EQ(replaced.json()["entries"].size(), 1);
  CHECK_EQ(yard.items("/api/v1/tracks?state=open").size(), 0);
  CHECK_EQ(yard.items("/api/v1/tracks?state=accepted").size(), 1);
  yard.scan(kBox);
  CHECK_EQ(yard.items("/api/v1/tracks").size(), 1);

  CHECK_EQ(yard.post(target, {{"by", "anna"}, {"mode", "learn"}}).json()["entries"].size(), 0);
  for (int i = 0; i < 4; ++i) yard.scan();
  CHECK_EQ(yard.items("/api/v1/tracks").size(), 1);
  const json versions = yard.items("/api/v1/baselines?site=yard");
  CHECK_EQ(versions.size(), 8);
  CHECK_EQ(versions[0]["entries"].size(), 3);
  CHECK_EQ(versions[7]["entries"].size(), 1);
  CHECK_EQ(yard.items("/api/v1/baselines").size(), 1);

  CHECK_NE(yard.post(target, {{"by", "anna"}}).complaint_about("scans"), "");
  CHECK_EQ(yard.post(target, {{"by", "anna"}, {"scans", {999}}}).status, 404);
  CHECK_EQ(yard.post(target, {{"by", "anna"}, {"track", 999}}).status, 404);
  const json flat = {{"min", {0, 0, 0}}, {"max", {1, 1, 0}}};
  CHECK_NE(yard.post(target, {{"by", "anna"}, {"scans", {1}}, {"region_m", flat}}).complaint_about("region_m"), "");
}

TEST_CASE("zones are made, read, replaced and deleted, in the coordinates of the site") {
  WatchedYard yard;
  const Reply made = yard.post("/api/v1/zones", kGate);
  REQUIRE_EQ(made.status, 201);
  CHECK_EQ(made.json()["polygon_m"], kGate["polygon_m"]);
  const std::string target = made.header("Location");
  CHECK_EQ(yard.get(target).json(), made.json());
  CHECK_EQ(yard.post("/api/v1/zones", kGate).status, 409);
  json smaller = kGate;
  smaller["z_max_m"] = 2.0;
  CHECK_EQ(
      yard.send("PUT", target, smaller.dump(), {{"Content-Type", "application/json"}, {"If-Match", "\"x\""}}).status,
      412);
  const Reply replaced = yard.send("PUT", target, smaller.dump(),
                                   {{"Content-Type", "application/json"}, {"If-Match", made.header("ETag")}});
  CHECK_EQ(replaced.status, 200);
  CHECK_EQ(replaced.json()["z_max_m"], 2.0);
  CHECK_EQ(yard.items("/api/v1/zones?site=yard").size(), 1);
  CHECK_EQ(yard.remove(target).status, 204);
  CHECK_EQ(yard.get(target).status, 404);

  json crossed = kGate;
  crossed["polygon_m"] = {{0, 0}, {2, 2}, {2, 0}, {0, 2}};
  CHECK_NE(yard.post("/api/v1/zones", crossed).complaint_about("polygon_m"), "");
  crossed["polygon_m"] = {{0, 0}, {2}, {2, 0}};
  CHECK_NE(yard.post("/api/v1/zones", crossed).complaint_about("polygon_m"), "");
  json nowhere = kGate;
  nowhere.erase("site");
  CHECK_NE(yard.post("/api/v1/zones", nowhere).complaint_about("site"), "");
}

TEST_CASE("a zone in map coordinates is where the scans are, also when it was drawn before the first of them") {
  ApiFixture api;
  api.make_site_and_sensor();
  json zone = kGate;
  for (json& corner : zone["polygon_m"])
    corner = {corner[0].get<double>() + 400'000.0, corner[1].get<double>() + 5'500'000.0};
  const Reply made = api.post("/api/v1/zones", zone);
  REQUIRE_EQ(made.status, 201);
  CHECK_EQ(made.json()["polygon_m"], zone["polygon_m"]);
  Pose pose = wall_pose();
  pose.position_m += Eigen::Vector3d(400'000.0, 5'500'000.0, 0.0);
  const Reply stored = api.upload_bytes(pcd_of(wall_points({}), pose), "sensor=gate&captured_at=2026-03-01T08:00:00Z",
                                        {{"Prefer", "wait=50"}});
  REQUIRE_EQ(stored.status, 201);
  const json coverage = api.get(made.header("Location") + "/coverage").json()["items"];
  REQUIRE_EQ(coverage.size(), 1);
  CHECK_GT(coverage[0]["share"].get<double>(), 0.5);
}

TEST_CASE("every zone tells for each scan how much of it could be judged") {
  WatchedYard yard;
  const std::string target = yard.post("/api/v1/zones", kGate).header("Location");
  yard.scan();
  yard.scan(kBox);
  const json coverage = yard.items(target + "/coverage");
  REQUIRE_EQ(coverage.size(), 2);
  CHECK_LT(coverage[0]["share"], coverage[1]["share"]);
}

TEST_CASE("rules are made, read, replaced and deleted, and one that cannot work is refused by name") {
  WatchedYard yard;
  const json zone = yard.post("/api/v1/zones", kGate).json();
  const json rule = {{"name", "night"},
                     {"zone", zone["id"]},
                     {"kinds", {"added"}},
                     {"min_points", 5},
                     {"persistence", {{"scans", 1}, {"of", 2}, {"seconds", 1.5}}},
                     {"severity", "critical"},
                     {"schedule", {{{"days", {"mon", "sun"}}, {"from", "20:00"}, {"to", "06:00"}}}},
                     {"auto_resolve", false}};
  const Reply made = yard.post("/api/v1/rules", rule);
  REQUIRE_EQ(made.status, 201);
  for (const auto& [name, value] : rule.items()) CHECK_EQ(made.json()[name], value);
  CHECK_EQ(made.json()["site"], "yard");
  const std::string target = made.header("Location");
  CHECK_EQ(yard.remove("/api/v1/zones/" + zone["id"].dump()).status, 409);

  const auto refused = [&](const char* name, const json& value) {
    json wrong = rule;
    wrong["name"] = "other";
    wrong[name] = value;
    return yard.post("/api/v1/rules", wrong);
  };
  CHECK_NE(refused("kinds", {"moved"}).complaint_about("kinds"), "");
  CHECK_NE(refused("kinds", json::array()).complaint_about("kinds"), "");
  CHECK_NE(refused("severity", "bad").complaint_about("severity"), "");
  CHECK_NE(refused("persistence", {{"scans", 3}, {"of", 2}}).complaint_about("persistence.scans"), "");
  CHECK_NE(refused("schedule", {{{"days", {"someday"}}}}).complaint_about("schedule.0.days"), "");
  CHECK_NE(refused("schedule", {{{"from", "25:00"}}}).complaint_about("schedule.0.from"), "");
  CHECK_NE(refused("min_poins", 1).complaint_about("min_poins"), "");
  CHECK_EQ(refused("zone", 99).status, 404);

  json milder = rule;
  milder["severity"] = "info";
  CHECK_EQ(yard.send("PUT", target, milder.dump(), {{"Content-Type", "application/json"}}).json()["severity"], "info");
  CHECK_EQ(yard.remove(target).status, 204);
  CHECK_EQ(yard.items("/api/v1/rules?site=yard").size(), 1);
}

TEST_CASE("a rule tried over what happened alerts exactly as it would have") {
  WatchedYard yard;
  yard.learn();
  for (const bool box : {true, true, false, true, true, true, false, false, true, false, false})
    yard.scan({.box = box});
  const json rule = yard.items("/api/v1/rules?site=yard")[0];
  const std::string target = "/api/v1/rules/" + rule["id"].dump() + "/test";
  const json alerts = yard.items("/api/v1/alerts");
  const json tried = yard.post(target, json::object()).json()["alerts"];
  REQUIRE_EQ(tried.size(), alerts.size());
  for (std::size_t i = 0; i < tried.size(); ++i) {
    const json& alert = alerts[alerts.size() - 1 - i];  // newest first
    CHECK_EQ(tried[i]["track"], alert["track"]);
    CHECK_EQ(tried[i]["scan"], alert["scan"]);
    CHECK_EQ(tried[i]["resolved_at"].is_null(), alert["state"] != "resolved");
  }
  // A rule that asks for less would have told sooner, and of the short visit as well.
  const json at_once = {{"name", "at once"}, {"persistence", {{"scans", 1}}}};
  const json more = yard.post(target, {{"rule", at_once}}).json()["alerts"];
  CHECK_GT(more.size(), tried.size());
  CHECK_EQ(more[0]["at"], "2026-03-01T08:03:00Z");
  CHECK_EQ(yard.post(target, {{"to", "2026-03-01T08:03:00Z"}, {"rule", at_once}}).json()["alerts"].size(), 0);
  CHECK_EQ(yard.post(target, {{"from", "2026-03-01T08:03:00Z"}, {"to", "2026-03-01T08:03:01Z"}, {"rule", at_once}})
               .json()["alerts"]
               .size(),
           1);
  CHECK_NE(yard.post(target, {{"from", "2026-03-02T00:00:00Z"}, {"to", "2026-03-01T00:00:00Z"}}).complaint_about("to"),
           "");
}

TEST_CASE("the history of a place says when it was free, occupied or out of sight, from the rays alone") {
  WatchedYard yard;
  yard.scan();
  yard.scan();
  yard.scan(kBox);
  yard.scan(kBox);
  yard.scan();
  // The face of the box is at x = 95.5; behind it nothing is seen while it stands there.
  const json at_face = yard.get("/api/v1/history?site=yard&point=95.5,200,1.5").json();
  CHECK_EQ(at_face["scans"], 5);
  REQUIRE_EQ(at_face["intervals"].size(), 3);
  CHECK_EQ(at_face["intervals"][0]["state"], "free");
  CHECK_EQ(at_face["intervals"][0]["last_scan"], 2);
  CHECK_EQ(at_face["intervals"][1]["state"], "occupied");
  CHECK_EQ(at_face["intervals"][1]["from"], "2026-03-01T08:02:00Z");
  CHECK_EQ(at_face["intervals"][2]["state"], "free");
  const json behind = yard.get("/api/v1/history?site=yard&point=93,200,1.5").json()["intervals"];
  REQUIRE_EQ(behind.size(), 1);
  CHECK_EQ(behind[0]["state"], "free");
  CHECK_EQ(behind[0]["scans"], 3);
  CHECK_EQ(behind[0]["not_seen"], 2);
  const json wall = yard.get("/api/v1/history?site=yard&point=80,200,1.5").json()["intervals"];
  REQUIRE_EQ(wall.size(), 1);
  CHECK_EQ(wall[0]["state"], "not_seen");
  const json box = yard.get("/api/v1/history?site=yard&box=95.2,199.8,1.2,95.8,200.2,1.8").json()["intervals"];
  REQUIRE_EQ(box.size(), 3);
  CHECK_EQ(box[1]["state"], "occupied");
  const std::string later = "&from=2026-03-01T08:02:00Z&to=2026-03-01T08:04:00Z";
  CHECK_EQ(yard.get("/api/v1/history?site=yard&point=95.5,200,1.5" + later).json()["intervals"].size(), 1);
  CHECK_EQ(yard.get("/api/v1/history?site=yard").complaint_about("point"), "must be given, or else 'box'");
  CHECK_EQ(yard.get("/api/v1/history?site=yard&point=1,1,1&box=1,1,1,2,2,2").complaint_about("point"),
           "give 'point' or 'box', not both");
  CHECK_NE(yard.get("/api/v1/history?site=yard&box=1,1,1,1,2,2").complaint_about("box"), "");
  CHECK_EQ(yard.get("/api/v1/history?site=nowhere&point=0,0,0").status, 404);
}

TEST_CASE("a silence holds back alerts of what it names") {
  WatchedYard yard;
  const Reply made = yard.post("/api/v1/silences", {{"site", "yard"},
                                                    {"sensor", "gate"},
                                                    {"from", "2026-03-01T00:00:00Z"},
                                                    {"until", "2026-03-03T00:00:00Z"},
                                                    {"by", "anna"}});
  REQUIRE_EQ(made.status, 201);
  CHECK_EQ(made.json()["sensor"], "gate");
  yard.learn();
  for (int i = 0; i < 3; ++i) yard.scan(kBox);
  CHECK_EQ(yard.items("/api/v1/alerts").size(), 0);
  CHECK_EQ(yard.remove(made.header("Location")).status, 204);
  yard.scan(kBox);
  CHECK_EQ(yard.items("/api/v1/alerts").size(), 1);
  CHECK_NE(yard.post("/api/v1/silences", {{"site", "yard"}, {"until", "2026-01-01T00:00:00Z"}, {"by", "anna"}})
               .complaint_about("until"),
           "");
}

TEST_CASE("a silence is for a sensor of its own site, and what is wrong with it is said once") {
  WatchedYard yard;
  yard.post("/api/v1/sites", {{"name", "hall"}});
  json silence = {{"site", "hall"}, {"sensor", "gate"}, {"until", "2026-03-03T00:00:00Z"}, {"by", "anna"}};
  CHECK_EQ(yard.post("/api/v1/silences", silence).complaint_about("sensor"), "is of another site");
  CHECK_EQ(yard.items("/api/v1/silences").size(), 0);
  silence.erase("until");
  silence["from"] = "2026-03-02T00:00:00Z";
  silence["to"] = "2026-03-03T00:00:00Z";
  const Reply reply = yard.post("/api/v1/silences", silence);
  CHECK_EQ(reply.complaint_about("until"), "is required");
  CHECK_EQ(reply.complaint_about("to").find("did you mean"), std::string::npos);
}

TEST_CASE("the log of events has everything in order, by pages") {
  WatchedYard yard;
  yard.alert_of_box();
  const json all = yard.items("/api/v1/events/log?limit=1000");
  std::vector<std::string> types;
  for (const json& event : all) types.push_back(event["type"]);
  CHECK_EQ(std::count(types.begin(), types.end(), "scan.stored"), 5);
  CHECK_EQ(std::count(types.begin(), types.end(), "baseline.learned"), 3);
  CHECK_EQ(std::count(types.begin(), types.end(), "alert.opened"), 1);
  json pages = json::array();
  for (json page = yard.get("/api/v1/events/log?limit=3").json();;
       page = yard.get("/api/v1/events/log?limit=3&after=" + page["next"].get<std::string>()).json()) {
    pages.insert(pages.end(), page["items"].begin(), page["items"].end());
    if (page["next"].is_null()) break;
  }
  CHECK_EQ(pages, all);
  CHECK_EQ(yard.items("/api/v1/events/log?after=" + all.back()["id"].dump()).size(), 0);
}

TEST_CASE("a stream of events begins where the client wants, and gives what the log has") {
  WatchedYard yard;
  yard.learn();
  const json log = yard.items("/api/v1/events/log?limit=1000");
  EventListener from_the_start(yard.port(), "?after=0");
  EventListener behind_the_second(yard.port(), "", log[1]["id"].dump());
  EventListener from_now(yard.port(), "?site=yard");
  yard.scan();
  const json longer = yard.items("/api/v1/events/log?limit=1000");
  REQUIRE_GT(longer.size(), log.size());
  CHECK_EQ(from_the_start.take(longer.size()), longer);
  CHECK_EQ(behind_the_second.take(longer.size() - 2), json(longer.begin() + 2, longer.end()));
  CHECK_EQ(from_now.take(longer.size() - log.size()),
           json(longer.begin() + static_cast<std::ptrdiff_t>(log.size()), longer.end()));
}

TEST_CASE("streams leave threads for others: one too many is asked to come back") {
  WatchedYard yard;
  std::vector<std::unique_ptr<EventListener>> listeners;
  for (int i = 0; i < 4; ++i) listeners.push_back(std::make_unique<EventListener>(yard.port(), ""));
  const Reply refused = yard.get("/api/v1/events");
  CHECK_EQ(refused.status, 503);
  CHECK_NE(refused.header("Retry-After"), "");
  CHECK_EQ(yard.get("/healthz").status, 200);
}

TEST_CASE("a stream has a head for those who only ask for that, and an id that is none is refused") {
  ApiFixture api;
  CHECK_EQ(api.head("/api/v1/events").status, 200);
  CHECK_EQ(api.get("/api/v1/events", {{"Last-Event-ID", "soon"}}).status, 422);
  CHECK_EQ(api.get("/api/v1/events?site=nowhere").status, 404);
}

}  // namespace
}  // namespace raywatch::testing
