// The story of a guarded place, with the program killed in the middle of it.

#include <doctest/doctest.h>

#include <algorithm>
#include <memory>

#include "tests/end_to_end/api_client.hpp"
#include "tests/end_to_end/daemon_process.hpp"
#include "tests/support/temp_dir.hpp"

using namespace raywatch::test;
using nlohmann::json;

namespace {

/// A daemon that is killed and started again now and then, and the place that it watches.
class GuardedPlace {
 public:
  GuardedPlace() {
    start();
    api().make_site_and_sensor();
  }

  void kill_and_restart() {
    daemon_->kill();
    start();
  }

  /// Sends a scan and does not wait: the program may be killed before it is compared.
  void send(const PlaceState& state) {
    const ApiReply reply = api().upload(scan_place(state, number_++));
    REQUIRE(reply.status == 201);
  }
  void scan(const PlaceState& state, int times = 1) {
    for (int i = 0; i < times; ++i) {
      send(state);
      api().wait_for_all_scans();
    }
  }

  json items(const std::string& target) {
    const ApiReply reply = api().get(target);
    REQUIRE(reply.status == 200);
    return reply.json()["items"];
  }
  json alerts() { return items("/api/v1/alerts?site=yard"); }
  std::size_t events(const std::string& type) {
    const json log = items("/api/v1/events/log?limit=1000");
    return static_cast<std::size_t>(
        std::count_if(log.begin(), log.end(), [&](const json& event) { return event["type"] == type; }));
  }
  ApiClient& api() { return *api_; }

 private:
  void start() {
    daemon_ = std::make_unique<DaemonProcess>(folder_.path() / "data");
    api_ = std::make_unique<ApiClient>(daemon_->url());
  }

  raywatch::TempDir folder_;
  std::unique_ptr<DaemonProcess> daemon_;
  std::unique_ptr<ApiClient> api_;
  int number_ = 0;
};

const PlaceState kQuiet{}, kBag{.box = true};

}  // namespace

TEST_CASE("learn the place, put a bag, one alert, acknowledge, take the bag, it resolves; killed at every step") {
  GuardedPlace place;
  place.scan(kQuiet, 2);
  place.send(kQuiet);
  place.kill_and_restart();
  place.api().wait_for_all_scans();
  CHECK(place.items("/api/v1/baselines?site=yard").size() == 3);

  // Somebody walks through: seen once, told never.
  place.scan({.person_y_m = -2.0});
  place.scan({.person_y_m = 2.0});
  place.scan(kQuiet);
  CHECK(place.alerts().empty());
  CHECK(place.items("/api/v1/tracks?site=yard").size() == 2);

  place.scan(kBag);
  CHECK(place.alerts().empty());
  place.send(kBag);
  place.kill_and_restart();
  place.api().wait_for_all_scans();
  REQUIRE(place.alerts().size() == 1);
  const std::string alert = "/api/v1/alerts/" + place.alerts()[0]["id"].dump();
  CHECK(place.api().post(alert + "/acknowledge", {{"by", "anna"}}).status == 200);
  place.kill_and_restart();
  for (int i = 0; i < 3; ++i) {
    place.send(kBag);
    place.kill_and_restart();
    place.api().wait_for_all_scans();
  }
  CHECK(place.alerts().size() == 1);
  CHECK(place.alerts()[0]["state"] == "acknowledged");

  place.send(kQuiet);
  place.kill_and_restart();
  place.api().wait_for_all_scans();
  const json resolved = place.api().get(alert).json();
  CHECK(resolved["state"] == "resolved");
  REQUIRE(resolved["history"].size() == 3);
  CHECK(resolved["history"][0]["action"] == "opened");
  CHECK(resolved["history"][1]["by"] == "anna");
  CHECK(resolved["history"][2]["by"] == "raywatch");

  // Nothing of it happened twice, and nothing is missing.
  CHECK(place.events("scan.stored") == 12);
  CHECK(place.events("comparison.done") == 24);
  CHECK(place.events("baseline.learned") == 3);
  CHECK(place.events("track.started") == 3);
  CHECK(place.events("track.ended") == 3);
  CHECK(place.events("alert.opened") == 1);
  CHECK(place.events("alert.resolved") == 1);
  const json track = place.api().get("/api/v1/tracks/" + resolved["track"].dump()).json();
  CHECK(track["seen"] == 5);
  CHECK(track["state"] == "gone");
}
