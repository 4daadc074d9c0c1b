#pragma once

#include <charconv>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "core/error.hpp"
#include "storage/alerts.hpp"
#include "storage/channels.hpp"
#include "storage/comparisons.hpp"
#include "storage/deliveries.hpp"
#include "storage/rules.hpp"
#include "storage/scans.hpp"
#include "storage/sensors.hpp"
#include "storage/sites.hpp"
#include "storage/tracks.hpp"
#include "storage/zones.hpp"

namespace raywatch {

/// @{ What a name or an id stands for. @throws NotFound saying what does not exist.
Site site_named(const Snapshot& snapshot, std::string_view name);
Sensor sensor_named(const Snapshot& snapshot, std::string_view name);
Site site_with(const Snapshot& snapshot, SiteId id);
ScanRecord scan_with(const Snapshot& snapshot, ScanId id);
ComparisonRecord comparison_with(const Snapshot& snapshot, ComparisonId id);
ChangeRecord change_with(const Snapshot& snapshot, ChangeId id);
ZoneRecord zone_with(const Snapshot& snapshot, ZoneId id);
RuleRecord rule_with(const Snapshot& snapshot, RuleId id);
SilenceRecord silence_with(const Snapshot& snapshot, SilenceId id);
TrackRecord track_with(const Snapshot& snapshot, TrackId id);
AlertRecord alert_with(const Snapshot& snapshot, AlertId id);
ChannelRecord channel_with(const Snapshot& snapshot, ChannelId id);
DeliveryRecord delivery_with(const Snapshot& snapshot, DeliveryId id);
/// @}

/// What was looked up. @throws NotFound when there is none.
template <class Record>
Record required(std::optional<Record> record, const std::string& what) {
  if (!record) throw NotFound("There is no " + what + ".");
  return *std::move(record);
}

/// The id in a path. What is no id names nothing. @throws NotFound.
template <class SomeId>
SomeId id_in_path(std::string_view text) {
  SomeId id;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), id.value);
  if (error != std::errc{} || end != text.data() + text.size() || id.value < 1) {
    throw NotFound("'" + std::string(text.substr(0, 64)) + "' is no id.");
  }
  return id;
}

}  // namespace raywatch
