#include <doctest/doctest.h>

#include "tests/api/api_fixture.hpp"

namespace raywatch::testing {
namespace {

using nlohmann::json;

const std::string kSecret = "whsec_MfKQ9r8GKYqrTwjUPD8ILPZIo2LaLaSw";

/// Nobody listens there: port 9 of loopback.
json webhook(const std::string& name) {
  return {{"name", name},
          {"kind", "webhook"},
          {"by", "anna"},
          {"webhook", {{"url", "http://127.0.0.1:9/hook"}, {"secrets", {kSecret}}}}};
}
json mail(const std::string& name) {
  return {{"name", name},
          {"kind", "mail"},
          {"by", "anna"},
          {"mail",
           {{"host", "127.0.0.1"},
            {"port", 9},
            {"user", "u"},
            {"password", "hidden"},
            {"from", "r@example.com"},
            {"to", {"g@example.com"}}}}};
}

TEST_CASE("a channel is made, read, replaced and deleted, and its secrets never come back") {
  ApiFixture api;
  api.make_site_and_sensor();
  json given = webhook("ops");
  given["site"] = "yard";
  given["enabled"] = false;
  const Reply made = api.post("/api/v1/channels", given);
  REQUIRE_EQ(made.status, 201);
  CHECK_EQ(made.header("Location"), "/api/v1/channels/1");
  CHECK_EQ(made.json()["events"], json({"alert.*"}));
  CHECK_EQ(made.json()["webhook"]["secrets"], 1);
  CHECK_EQ(made.json()["by"], "anna");
  CHECK_EQ(made.body.find("MfKQ9r8G"), std::string::npos);
  CHECK_EQ(api.post("/api/v1/channels", given).status, 409);

  given["webhook"].erase("secrets");  // they stay
  given["min_severity"] = "critical";
  given["by"] = "ben";
  const Reply replaced = api.send("PUT", "/api/v1/channels/1", given.dump(),
                                  {{"Content-Type", "application/json"}, {"If-Match", made.header("ETag")}});
  REQUIRE_EQ(replaced.status, 200);
  CHECK_EQ(replaced.json()["webhook"]["secrets"], 1);
  CHECK_EQ(replaced.json()["min_severity"], "critical");
  CHECK_EQ(api.send("PUT", "/api/v1/channels/1", given.dump(),
                    {{"Content-Type", "application/json"}, {"If-Match", made.header("ETag")}})
               .status,
           412);
  json as_mail = mail("ops");
  as_mail["enabled"] = false;
  CHECK_NE(api.send("PUT", "/api/v1/channels/1", as_mail.dump(), {{"Content-Type", "application/json"}})
               .complaint_about("kind"),
           "");
  CHECK_EQ(api.get("/api/v1/channels?site=yard").json()["items"].size(), 1);
  CHECK_EQ(api.remove("/api/v1/channels/1").status, 204);
  CHECK_EQ(api.get("/api/v1/channels/1").status, 404);
  const json log = api.get("/api/v1/events/log?limit=1000").json()["items"];
  CHECK_EQ(log.back()["text"], "ben edited channel ops.");
}

TEST_CASE("passwords of mail and MQTT are not shown either") {
  ApiFixture api;
  json given = mail("guards");
  given["enabled"] = false;
  const Reply made = api.post("/api/v1/channels", given);
  REQUIRE_EQ(made.status, 201);
  CHECK_EQ(made.json()["mail"]["has_password"], true);
  CHECK_EQ(made.json()["mail"]["security"], "starttls");
  CHECK_EQ(made.body.find("hidden"), std::string::npos);
  given["mail"]["password"] = nullptr;
  CHECK_EQ(api.send("PUT", "/api/v1/channels/1", given.dump(), {{"Content-Type", "application/json"}})
               .json()["mail"]["has_password"],
           false);
  const Reply mqtt = api.post("/api/v1/channels", {{"name", "home"},
                                                   {"kind", "mqtt"},
                                                   {"by", "anna"},
                                                   {"enabled", false},
                                                   {"mqtt", {{"host", "broker"}, {"password", "hidden"}}}});
  REQUIRE_EQ(mqtt.status, 201);
  CHECK_EQ(mqtt.json()["mqtt"]["port"], 1883);
  CHECK_EQ(mqtt.json()["mqtt"]["discovery_prefix"], "homeassistant");
  CHECK_EQ(mqtt.body.find("hidden"), std::string::npos);
}

TEST_CASE("what is wrong with a channel is named") {
  ApiFixture api;
  const auto complaint = [&](json given, const std::string& part, const std::string& field, const json& value) {
    (part.empty() ? given : given[part])[field] = value;
    const Reply reply = api.post("/api/v1/channels", given);
    CHECK_EQ(reply.status, 422);
    return reply.complaint_about(part.empty() ? field : part + "." + field);
  };
  CHECK_EQ(complaint(webhook("a"), "webhook", "url", "ftp://example.com"), "must begin with https:// or http://");
  CHECK_EQ(complaint(webhook("a"), "webhook", "url", "http:///x"), "must name a host");
  CHECK_EQ(complaint(webhook("a"), "webhook", "url", "http://u:p@example.com"),
           "must not have a user or password in it");
  CHECK_EQ(complaint(webhook("a"), "webhook", "secrets", {"whsec_c2hvcnQ="}),
           "must be whsec_ and the base64 of 24 to 64 bytes");
  CHECK_EQ(complaint(webhook("a"), "", "events", {"Alert opened"}),
           "must be a type of events such as alert.opened, or the beginning of some such as alert.*");
  CHECK_NE(complaint(webhook("a"), "", "per_minute", 0), "");
  CHECK_NE(complaint(webhook("a"), "", "by", ""), "");
  CHECK_EQ(complaint(mail("a"), "mail", "to", {"g@example.com>\r\nRCPT TO:<x@y"}),
           "must be a plain address, such as guard@example.com");
  CHECK_NE(complaint(mail("a"), "mail", "host", "mx example"), "");
  json in_the_clear = mail("a");
  in_the_clear["mail"]["security"] = "none";
  CHECK_EQ(api.post("/api/v1/channels", in_the_clear).complaint_about("mail.user"),
           "needs the security starttls or tls: a password never goes out in the clear");
  CHECK_EQ(complaint({{"name", "a"}, {"kind", "mqtt"}, {"by", "b"}, {"mqtt", {{"host", "h"}}}}, "mqtt", "topic_prefix",
                     "a/#"),
           "must be 1 to 100 bytes without '#' and '+', and with no slash at its ends");
  json without = webhook("a");
  without["webhook"].erase("secrets");
  CHECK_EQ(api.post("/api/v1/channels", without).complaint_about("webhook.secrets"), "is required");
  without.erase("webhook");
  CHECK_EQ(api.post("/api/v1/channels", without).complaint_about("webhook"), "is required");
  json elsewhere = webhook("a");
  elsewhere["site"] = "moon";
  CHECK_EQ(api.post("/api/v1/channels", elsewhere).status, 404);
}

TEST_CASE("a test says what happened, and what failed stands in the log and in the figures, and can be sent again") {
  DaemonConfig config;
  config.delivery.attempts = 1;
  ApiFixture api(config);
  api.make_site_and_sensor();
  REQUIRE_EQ(api.post("/api/v1/channels", webhook("ops")).status, 201);
  const json test = api.post("/api/v1/channels/1/test", json::object()).json();
  CHECK_EQ(test["delivered"], false);
  CHECK_EQ(test["response_code"], nullptr);
  CHECK_NE(test["error"], nullptr);
  CHECK_EQ(api.post("/api/v1/channels/7/test", json::object()).status, 404);

  for (int i = 0; i < 3; ++i) api.upload(i);
  for (int i = 3; i < 5; ++i) api.upload(i, {.box = true});
  const std::string of_alert = "/api/v1/deliveries?channel=1&alert=1";
  json deliveries;
  do {
    deliveries = api.get(of_alert).json()["items"];
    REQUIRE_EQ(deliveries.size(), 1);
  } while (deliveries[0]["state"] != "failed");
  CHECK_EQ(deliveries[0]["type"], "alert.opened");
  CHECK_EQ(deliveries[0]["channel_name"], "ops");
  CHECK_EQ(deliveries[0]["attempts"], 1);
  CHECK_EQ(api.get(of_alert + "&state=delivered").json()["items"].size(), 0);
  CHECK_NE(api.get("/metrics").body.find("raywatch_deliveries_failed_total{kind=\"webhook\"}"), std::string::npos);
  CHECK_NE(api.get("/api/v1/channels/1").json()["trouble"], nullptr);

  const std::string retry = "/api/v1/deliveries/" + deliveries[0]["id"].dump() + "/retry";
  CHECK_EQ(api.post(retry, json::object()).complaint_about("by"), "is required");
  CHECK_EQ(api.post(retry, {{"by", "anna"}}).json()["state"], "pending");
  CHECK_EQ(api.post("/api/v1/deliveries/999/retry", {{"by", "anna"}}).status, 404);
  CHECK_EQ(api.remove("/api/v1/channels/1").status, 204);
  const json alerts = api.get("/api/v1/alerts").json()["items"];
  CHECK_EQ(alerts[0]["cause"], "delivery-failing");
  CHECK_EQ(alerts[0]["state"], "resolved");
}

}  // namespace
}  // namespace raywatch::testing
