#pragma once

#include <optional>
#include <string>

#include "core/rule.hpp"
#include "storage/store.hpp"

namespace raywatch {

/// What a system alert is about; there is one that stands for each site, cause and subject.
struct SystemSubject {
  SiteId site;
  std::string cause;
  std::string subject;
  std::optional<ZoneId> zone;
  std::optional<SensorId> sensor;
};

struct SystemNews {
  Severity severity = Severity::warning;
  std::optional<ScanId> scan;
  Time at;
  std::string title;
};

/// Opens the alert, unless it stands already.
void raise_system_alert(Transaction& transaction, const SystemSubject& subject, const SystemNews& news);
/// Resolves it, if it stands.
void settle_system_alert(Transaction& transaction, const SystemSubject& subject, const std::string& why,
                         std::optional<ScanId> scan, Time now);

std::string sensor_name(const Snapshot& snapshot, SensorId sensor);

}  // namespace raywatch
