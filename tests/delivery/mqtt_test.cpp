// MQTT, by a real mosquitto broker on loopback.

#include <doctest/doctest.h>

#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>

#include "storage/sensors.hpp"
#include "tests/delivery/child_process.hpp"
#include "tests/delivery/told_place.hpp"

namespace raywatch::test {
namespace {

using nlohmann::json;

/// A broker that can be stopped and started again.
class Broker {
 public:
  Broker() {
    std::ofstream(folder_ / "mosquitto.conf")
        << "listener " << port_ << " 127.0.0.1\nallow_anonymous true\nlog_dest none\n";
  }
  void start() {
    process_.emplace(std::vector<std::string>{"/usr/sbin/mosquitto", "-c", folder_ / "mosquitto.conf"});
    wait_for_listener(port_);
  }
  void stop() { process_.reset(); }
  MqttSettings settings() const {
    return {.host = "127.0.0.1",
            .port = static_cast<std::uint16_t>(port_),
            .topic_prefix = "raywatch",
            .discovery_prefix = "homeassistant"};
  }
  /// Hears a topic, and what is retained there.
  std::vector<std::string> listener_command(const std::string& topic) const {
    return {"/usr/bin/mosquitto_sub", "-h", "127.0.0.1", "-p", std::to_string(port_), "-q", "1", "-v", "-t", topic};
  }

 private:
  TempDir folder_;
  int port_ = free_port();
  std::optional<ChildProcess> process_;
};

/// The next payload of a topic, past those of others.
std::string next_of(ChildProcess& listener, const std::string& topic) {
  for (;;) {
    const std::string line = listener.next_line();
    if (line.starts_with(topic + " ")) return line.substr(topic.size() + 1);
  }
}

TEST_CASE("alerts are published with their ids, and delivered when the broker has acknowledged them") {
  Broker broker;
  ToldPlace place;
  const ChannelId channel = place.add("home", broker.settings());
  const AlertId alert = place.open_alert("Something was added.");  // nobody is there yet
  place.wait_until([&] { return !place.deliveries(channel)[0].error.empty(); });
  CHECK(place.deliveries(channel)[0].state != DeliveryState::delivered);

  broker.start();
  ChildProcess listener(broker.listener_command("raywatch/#"));
  const DeliveryRecord first = place.wait_until_ended(channel, 1)[0];
  CHECK(first.state == DeliveryState::delivered);
  // The listener may have come after the message: another one tells.
  CHECK(json::parse(next_of(listener, "raywatch/H%C3%B6fe/state"))["standing_alerts"] == 1);
  place.acknowledge(alert);
  json body;
  do body = json::parse(next_of(listener, "raywatch/H%C3%B6fe/alerts"));
  while (body["type"] != "alert.acknowledged");
  CHECK(body["id"] == place.wait_until_ended(channel, 2)[1].message_id);
  CHECK(body["data"]["step"]["by"] == "ben");
  json state;
  do state = json::parse(next_of(listener, "raywatch/H%C3%B6fe/state"));
  while (state["open_alerts"] != 0);
  CHECK(state["standing_alerts"] == 1);
}

TEST_CASE("whoever comes later finds the state of the sensors, and Home Assistant discovers them") {
  Broker broker;
  broker.start();
  ToldPlace place;
  place.store().write(
      [&](Transaction& t) { insert_sensor(t, {.name = "gate", .site = place.site()}, ToldPlace::now()); });
  place.add("home", broker.settings());
  ChildProcess listener(broker.listener_command("#"));
  const json sensor = json::parse(next_of(listener, "raywatch/H%C3%B6fe/sensors/gate"));
  CHECK(sensor["state"] == "offline");
  CHECK(sensor["last_scan_at"] == nullptr);

  ChildProcess late(broker.listener_command("#"));
  std::map<std::string, json> retained;
  while (retained.size() < 5) {
    const std::string line = late.next_line();
    const std::string topic = line.substr(0, line.find(' '));
    if (topic.starts_with("homeassistant/")) retained[topic] = json::parse(line.substr(topic.size() + 1));
  }
  const json online = retained.at("homeassistant/binary_sensor/raywatch_sensor_1_online/config");
  CHECK(online["device_class"] == "connectivity");
  CHECK(online["state_topic"] == "raywatch/H%C3%B6fe/sensors/gate");
  CHECK(online["availability_topic"] == "raywatch/status");
  CHECK(online["device"]["identifiers"] == json({"raywatch_site_1"}));
  CHECK(retained.contains("homeassistant/sensor/raywatch_sensor_1_last_scan/config"));
  CHECK(retained.contains("homeassistant/sensor/raywatch_site_1_open_alerts/config"));
}

TEST_CASE("the broker says online while the program runs, and offline when it has ended") {
  Broker broker;
  broker.start();
  ChildProcess listener(broker.listener_command("raywatch/status"));
  {
    ToldPlace place;
    place.add("home", broker.settings());
    CHECK(next_of(listener, "raywatch/status") == "online");
  }
  CHECK(next_of(listener, "raywatch/status") == "offline");
}

TEST_CASE("a test says that nobody is there, or that it arrived, and leaves the state alone") {
  Broker broker;
  ToldPlace place;
  const ChannelId channel = place.add("home", broker.settings(), {.enabled = false});
  const ChannelTest nobody = place.deliverer().test(channel);
  CHECK_FALSE(nobody.delivered);
  CHECK_FALSE(nobody.error.empty());
  broker.start();
  CHECK(place.deliverer().test(channel).delivered);
}

}  // namespace
}  // namespace raywatch::test
