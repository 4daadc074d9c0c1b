#include "storage/events.hpp"

#include "storage/snapshot.hpp"

namespace raywatch {

EventId insert_event(Transaction& transaction, const Event& event) {
  Database& database = database_of(transaction);
  database.run(
      "INSERT INTO events (at, type, site, scan, comparison, track, alert, zone, rule, sensor, text) "
      "VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)",
      event.at, event.type, event.site, event.scan, event.comparison, event.track, event.alert, event.zone, event.rule,
      event.sensor, event.text);
  return EventId{database.last_id()};
}

std::vector<Event> events_after(const Snapshot& snapshot, EventId after, std::optional<SiteId> site,
                                std::size_t limit) {
  Statement rows(database_of(snapshot),
                 "SELECT id, at, type, site, scan, comparison, track, alert, zone, rule, sensor, text FROM events "
                 "WHERE id > ?1 AND (?2 IS NULL OR site IS NULL OR site = ?2) ORDER BY id LIMIT ?3");
  rows.bind(after, site, limit);
  std::vector<Event> events;
  while (rows.next()) {
    Event& event = events.emplace_back();
    event.id = rows.take<EventId>();
    event.at = rows.take<Time>();
    event.type = rows.take<std::string>();
    event.site = rows.take<std::optional<SiteId>>();
    event.scan = rows.take<std::optional<ScanId>>();
    event.comparison = rows.take<std::optional<ComparisonId>>();
    event.track = rows.take<std::optional<TrackId>>();
    event.alert = rows.take<std::optional<AlertId>>();
    event.zone = rows.take<std::optional<ZoneId>>();
    event.rule = rows.take<std::optional<RuleId>>();
    event.sensor = rows.take<std::optional<SensorId>>();
    event.text = rows.take<std::string>();
  }
  return events;
}

EventId first_event(const Snapshot& snapshot) {
  return database_of(snapshot).find<EventId>("SELECT min(id) FROM events").value_or(EventId{});
}

EventId last_event(const Snapshot& snapshot) {
  return database_of(snapshot).find<EventId>("SELECT max(id) FROM events").value_or(EventId{});
}

}  // namespace raywatch
