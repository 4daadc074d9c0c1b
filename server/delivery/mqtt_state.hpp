#pragma once

#include "server/delivery/sender.hpp"
#include "storage/store.hpp"

namespace raywatch {

/// What a broker is to know of the sites that a channel tells of, retained: of each sensor PREFIX/SITE/sensors/SENSOR
/// {"state": "online"|"offline", "last_scan_at", "problems"}, of each site PREFIX/SITE/state {"open_alerts",
/// "standing_alerts", "alerts"}, and the messages by which Home Assistant discovers them. Names stand percent-encoded
/// in topics.
RetainedTopics mqtt_state(const Snapshot& snapshot, const MqttSettings& settings, std::optional<SiteId> site);

}  // namespace raywatch
