// What is committed is told, however the program ends.

#include <doctest/doctest.h>

#include "tests/delivery/http_receiver.hpp"
#include "tests/end_to_end/api_client.hpp"
#include "tests/end_to_end/daemon_process.hpp"
#include "tests/support/temp_dir.hpp"

using namespace raywatch::test;
using nlohmann::json;

TEST_CASE(
    "killed between the commit of an alert and its delivery, the program sends it after the restart, as the same") {
  const raywatch::TempDir folder;
  HttpReceiver receiver;
  receiver.hang();
  std::string id, body;
  {
    DaemonProcess daemon(folder.path() / "data");
    ApiClient api(daemon.url());
    api.make_site_and_sensor();
    const ApiReply made =
        api.post("/api/v1/channels",
                 {{"name", "ops"},
                  {"kind", "webhook"},
                  {"by", "anna"},
                  {"webhook", {{"url", receiver.url()}, {"secrets", {"whsec_MfKQ9r8GKYqrTwjUPD8ILPZIo2LaLaSw"}}}}});
    REQUIRE(made.status == 201);
    for (int number = 0; number < 5; ++number) {
      REQUIRE(api.upload(scan_place({.box = number >= 3}, number)).status == 201);
    }
    const ReceivedRequest unanswered = receiver.wait_for(1)[0];
    id = unanswered.id;
    body = unanswered.body;
    daemon.kill();
  }
  CHECK(json::parse(body)["type"] == "alert.opened");

  DaemonProcess daemon(folder.path() / "data");
  const ReceivedRequest again = receiver.wait_for(2)[1];
  CHECK(again.id == id);
  CHECK(again.body == body);
  ApiClient api(daemon.url());
  const json deliveries = api.get("/api/v1/deliveries").json()["items"];
  REQUIRE(deliveries.size() == 1);
  CHECK(deliveries[0]["message_id"] == id);
  CHECK(deliveries[0]["attempts"] == 2);
  CHECK(daemon.stop() == 0);  // although the receiver still hangs
}
