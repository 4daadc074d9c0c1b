#include "storage/events.hpp"

#include "storage/deliveries.hpp"
#include "storage/snapshot.hpp"

namespace raywatch {
namespace {

const std::string kSelectEvents =
    "SELECT id, at, type, site, scan, comparison, track, alert, zone, rule, sensor, text FROM events ";

Event read_event(Statement& row) {
  Event event;
  event.id = row.take<EventId>();
  event.at = row.take<Time>();
  event.type = row.take<std::string>();
  event.site = row.take<std::optional<SiteId>>();
  event.scan = row.take<std::optional<ScanId>>();
  event.comparison = row.take<std::optional<ComparisonId>>();
  event.track = row.take<std::optional<TrackId>>();
  event.alert = row.take<std::optional<AlertId>>();
  event.zone = row.take<std::optional<ZoneId>>();
  event.rule = row.take<std::optional<RuleId>>();
  event.sensor = row.take<std::optional<SensorId>>();
  event.text = row.take<std::string>();
  return event;
}

}  // namespace

EventId insert_event(Transaction& transaction, const Event& event) {
  Database& database = database_of(transaction);
  database.run(
      "INSERT INTO events (at, type, site, scan, comparison, track, alert, zone, rule, sensor, text) "
      "VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)",
      event.at, event.type, event.site, event.scan, event.comparison, event.track, event.alert, event.zone, event.rule,
      event.sensor, event.text);
  Event stored = event;
  stored.id = EventId{database.last_id()};
  queue_deliveries(transaction, stored);
  return stored.id;
}

std::optional<Event> find_event(const Snapshot& snapshot, EventId id) {
  Statement row(database_of(snapshot), kSelectEvents + "WHERE id = ?");
  if (!row.bind(id).next()) return std::nullopt;
  return read_event(row);
}

std::vector<Event> events_after(const Snapshot& snapshot, EventId after, std::optional<SiteId> site,
                                std::size_t limit) {
  Statement rows(database_of(snapshot),
                 kSelectEvents + "WHERE id > ?1 AND (?2 IS NULL OR site IS NULL OR site = ?2) ORDER BY id LIMIT ?3");
  rows.bind(after, site, limit);
  std::vector<Event> events;
  while (rows.next()) events.push_back(read_event(rows));
  return events;
}

EventId first_event(const Snapshot& snapshot) {
  return database_of(snapshot).find<EventId>("SELECT min(id) FROM events").value_or(EventId{});
}

EventId last_event(const Snapshot& snapshot) {
  return database_of(snapshot).find<EventId>("SELECT max(id) FROM events").value_or(EventId{});
}

}  // namespace raywatch
