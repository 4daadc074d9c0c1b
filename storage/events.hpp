#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/ids.hpp"
#include "core/time.hpp"
#include "storage/store.hpp"

namespace raywatch {

/// Something that happened, committed together with what it tells about. Ids rise in the order of the commits, are
/// never used again, and are the places of the event stream.
struct Event {
  EventId id;
  Time at;
  std::string type;  ///< such as "alert.opened"
  std::optional<SiteId> site;
  std::optional<ScanId> scan;
  std::optional<ComparisonId> comparison;
  std::optional<TrackId> track;
  std::optional<AlertId> alert;
  std::optional<ZoneId> zone;
  std::optional<RuleId> rule;
  std::optional<SensorId> sensor;
  std::string text;  ///< one sentence for people
};

/// The event's id is ignored. Queues it for the channels that want it, too.
EventId insert_event(Transaction& transaction, const Event& event);
std::optional<Event> find_event(const Snapshot& snapshot, EventId id);
/// The first `limit` events after an id, in order; of one site, when given.
std::vector<Event> events_after(const Snapshot& snapshot, EventId after, std::optional<SiteId> site, std::size_t limit);
/// The oldest event that is kept; 0 when there is none. Ids rise without gaps, so those before it were pruned.
EventId first_event(const Snapshot& snapshot);
/// The latest event; 0 when there is none.
EventId last_event(const Snapshot& snapshot);

}  // namespace raywatch
