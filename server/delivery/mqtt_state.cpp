#include "server/delivery/mqtt_state.hpp"

#include <algorithm>
#include <cctype>

#include "api/json.hpp"
#include "api/render.hpp"
#include "api/text_values.hpp"
#include "storage/all_of_list.hpp"

namespace raywatch {
namespace {

/// So many open alerts are listed; all are counted.
constexpr std::size_t kListed = 20;

std::vector<AlertRecord> standing_alerts(const Snapshot& snapshot, SiteId site) {
  std::vector<AlertRecord> all;
  for (const AlertState state : {AlertState::open, AlertState::acknowledged, AlertState::snoozed}) {
    const auto some = all_of_list(
        [&](const PageRequest& page) { return list_alerts(snapshot, {.site = site, .state = state}, page); });
    all.insert(all.end(), some.begin(), some.end());
  }
  return all;
}

/// As ids may be written in Home Assistant. Programs that share a broker have prefixes of their own.
std::string id_text(std::string text) {
  std::ranges::replace_if(
      text, [](char c) { return std::isalnum(static_cast<unsigned char>(c)) == 0; }, '_');
  return text;
}

/// Gathers the topics of one site.
class SiteTopics {
 public:
  SiteTopics(const Snapshot& snapshot, const MqttSettings& settings, const Site& site, RetainedTopics& topics)
      : snapshot_(snapshot),
        settings_(settings),
        site_(site),
        id_(id_text(settings.topic_prefix)),
        base_(settings.topic_prefix + "/" + percent_encoded(site.name)),
        alerts_(standing_alerts(snapshot, site.id)),
        topics_(topics) {}

  void add_site() {
    const std::string topic = base_ + "/state";
    Json list = Json::array();
    std::size_t open = 0;
    for (const AlertRecord& alert : alerts_) {
      if (alert.state != AlertState::open) continue;
      if (open++ < kListed) list.push_back(render(snapshot_, alert));
    }
    topics_[topic] = to_json_text(Json{{"open_alerts", open}, {"standing_alerts", alerts_.size()}, {"alerts", list}});
    const std::string id = id_ + "_site_" + std::to_string(site_.id.value);
    discover("sensor", id + "_open_alerts", topic,
             {{"name", "Open alerts"},
              {"value_template", "{{ value_json.open_alerts }}"},
              {"json_attributes_topic", topic}});
    discover("binary_sensor", id + "_alert", topic,
             {{"name", "Alert"},
              {"device_class", "problem"},
              {"value_template", "{{ 'ON' if value_json.open_alerts > 0 else 'OFF' }}"}});
  }

  void add_sensor(const Sensor& sensor) {
    const std::string topic = base_ + "/sensors/" + percent_encoded(sensor.name);
    const Page<ScanRecord> last = list_scans(snapshot_, {.sensor = sensor.id}, {.limit = 1, .cursor = {}});
    Json problems = Json::array();
    bool is_silent = last.items.empty();
    for (const AlertRecord& alert : alerts_) {
      if (alert.sensor != sensor.id || alert.cause == kChangeCause) continue;
      if (alert.cause == "sensor-silent") is_silent = true;
      problems.push_back(alert.cause);
    }
    const Json captured = last.items.empty() ? Json(nullptr) : Json(format_rfc3339(last.items.front().captured_at));
    topics_[topic] = to_json_text(
        Json{{"state", is_silent ? "offline" : "online"}, {"last_scan_at", captured}, {"problems", problems}});
    const std::string id = id_ + "_sensor_" + std::to_string(sensor.id.value);
    discover("binary_sensor", id + "_online", topic,
             {{"name", sensor.name},
              {"device_class", "connectivity"},
              {"value_template", "{{ 'ON' if value_json.state == 'online' else 'OFF' }}"}});
    discover("binary_sensor", id + "_problem", topic,
             {{"name", sensor.name + " problem"},
              {"device_class", "problem"},
              {"value_template", "{{ 'ON' if value_json.problems else 'OFF' }}"},
              {"json_attributes_topic", topic}});
    discover("sensor", id + "_last_scan", topic,
             {{"name", sensor.name + " last scan"},
              {"device_class", "timestamp"},
              {"value_template", "{{ value_json.last_scan_at }}"}});
  }

 private:
  /// The configuration of an entity, as Home Assistant reads it from DISCOVERY/COMPONENT/ID/config.
  void discover(const std::string& component, const std::string& id, const std::string& topic, Json entity) {
    if (settings_.discovery_prefix.empty()) return;
    entity["unique_id"] = id;
    entity["state_topic"] = topic;
    entity["availability_topic"] = settings_.topic_prefix + "/status";
    entity["device"] = {{"identifiers", {id_ + "_site_" + std::to_string(site_.id.value)}},
                        {"name", "raywatch " + site_.name},
                        {"manufacturer", "raywatch"}};
    entity["origin"] = {{"name", "raywatch"}};
    topics_[settings_.discovery_prefix + "/" + component + "/" + id + "/config"] = to_json_text(entity);
  }

  const Snapshot& snapshot_;
  const MqttSettings& settings_;
  const Site& site_;
  std::string id_, base_;
  std::vector<AlertRecord> alerts_;
  RetainedTopics& topics_;
};

}  // namespace

RetainedTopics mqtt_state(const Snapshot& snapshot, const MqttSettings& settings, std::optional<SiteId> of) {
  RetainedTopics topics;
  for (const Site& site : all_of_list([&](const PageRequest& page) { return list_sites(snapshot, page); })) {
    if (of && *of != site.id) continue;
    SiteTopics of_site(snapshot, settings, site, topics);
    of_site.add_site();
    for (const Sensor& sensor :
         all_of_list([&](const PageRequest& page) { return list_sensors(snapshot, site.id, page); })) {
      of_site.add_sensor(sensor);
    }
  }
  return topics;
}

}  // namespace raywatch
