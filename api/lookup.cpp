#include "api/lookup.hpp"

namespace raywatch {
namespace {

std::string quoted_name(std::string_view name) { return "'" + std::string(name.substr(0, 200)) + "'"; }

}  // namespace

Site site_named(const Snapshot& snapshot, std::string_view name) {
  return required(find_site(snapshot, name), "site " + quoted_name(name));
}

Sensor sensor_named(const Snapshot& snapshot, std::string_view name) {
  return required(find_sensor(snapshot, name), "sensor " + quoted_name(name));
}

Site site_with(const Snapshot& snapshot, SiteId id) {
  return required(find_site(snapshot, id), "site with id " + std::to_string(id.value));
}

ScanRecord scan_with(const Snapshot& snapshot, ScanId id) {
  return required(find_scan(snapshot, id), "scan " + std::to_string(id.value));
}

ComparisonRecord comparison_with(const Snapshot& snapshot, ComparisonId id) {
  return required(find_comparison(snapshot, id), "comparison " + std::to_string(id.value));
}

ChangeRecord change_with(const Snapshot& snapshot, ChangeId id) {
  return required(find_change(snapshot, id), "change " + std::to_string(id.value));
}

ZoneRecord zone_with(const Snapshot& snapshot, ZoneId id) {
  return required(find_zone(snapshot, id), "zone " + std::to_string(id.value));
}

RuleRecord rule_with(const Snapshot& snapshot, RuleId id) {
  return required(find_rule(snapshot, id), "rule " + std::to_string(id.value));
}

SilenceRecord silence_with(const Snapshot& snapshot, SilenceId id) {
  return required(find_silence(snapshot, id), "silence " + std::to_string(id.value));
}

TrackRecord track_with(const Snapshot& snapshot, TrackId id) {
  return required(find_track(snapshot, id), "track " + std::to_string(id.value));
}

AlertRecord alert_with(const Snapshot& snapshot, AlertId id) {
  return required(find_alert(snapshot, id), "alert " + std::to_string(id.value));
}

ChannelRecord channel_with(const Snapshot& snapshot, ChannelId id) {
  return required(find_channel(snapshot, id), "channel " + std::to_string(id.value));
}

DeliveryRecord delivery_with(const Snapshot& snapshot, DeliveryId id) {
  return required(find_delivery(snapshot, id), "delivery " + std::to_string(id.value));
}

}  // namespace raywatch
