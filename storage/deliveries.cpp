#include "storage/deliveries.hpp"

#include <array>
#include <limits>

#include "core/names.hpp"
#include "storage/alerts.hpp"
#include "storage/columns.hpp"
#include "storage/cursor.hpp"
#include "storage/events.hpp"
#include "storage/snapshot.hpp"

namespace raywatch {
namespace {

constexpr Names<DeliveryState, 5> kDeliveryStates{{{DeliveryState::pending, "pending"},
                                                   {DeliveryState::sending, "sending"},
                                                   {DeliveryState::delivered, "delivered"},
                                                   {DeliveryState::failed, "failed"},
                                                   {DeliveryState::dropped, "dropped"}}};

constexpr std::string_view kDeliveryList = "deliveries";
const std::string kSelectDeliveries =
    "SELECT id, channel, kind, event, alert, step, type, message_id, body, state, attempts, created_at, queued_at, "
    "next_attempt_at, last_attempt_at, ended_at, took_ms, response_code, error FROM deliveries ";

DeliveryRecord read_delivery(Statement& row) {
  DeliveryRecord delivery;
  delivery.id = row.take<DeliveryId>();
  delivery.channel = row.take<ChannelId>();
  delivery.kind = parse_channel_kind(row.take<std::string>());
  delivery.event = row.take<EventId>();
  delivery.alert = row.take<std::optional<AlertId>>();
  delivery.step = row.take<std::optional<std::int64_t>>();
  delivery.type = row.take<std::string>();
  delivery.message_id = row.take<std::string>();
  delivery.body = row.take<std::string>();
  delivery.state = parse_delivery_state(row.take<std::string>());
  delivery.attempts = row.take<std::uint32_t>();
  delivery.created_at = row.take<Time>();
  delivery.queued_at = row.take<Time>();
  delivery.next_attempt_at = row.take<Time>();
  delivery.last_attempt_at = row.take<std::optional<Time>>();
  delivery.ended_at = row.take<std::optional<Time>>();
  delivery.took_ms = row.take<std::optional<double>>();
  delivery.response_code = row.take<std::optional<std::int64_t>>();
  delivery.error = row.take<std::string>();
  return delivery;
}

/// The step of an alert that an event tells of: its last.
struct AlertStepKey {
  std::int64_t place = 0;
  Severity severity = Severity::info;
};
std::optional<AlertStepKey> step_of(const Snapshot& snapshot, const Event& event) {
  if (!event.alert || !event.type.starts_with("alert.")) return std::nullopt;
  Statement row(database_of(snapshot),
                "SELECT place, severity FROM alert_steps WHERE alert = ? ORDER BY place DESC LIMIT 1");
  if (!row.bind(*event.alert).next()) return std::nullopt;
  const auto place = row.take<std::int64_t>();
  return AlertStepKey{place, parse_severity(row.take<std::string>())};
}

/// A channel as the outbox sees it: without its settings, which nobody needs for each event.
struct Interest {
  ChannelId channel;
  std::string kind;
  std::optional<SiteId> site;
  Severity min_severity = Severity::info;
  std::vector<std::string> events;

  bool covers(const Event& event, const std::optional<AlertStepKey>& step) const {
    if (site && event.site != site) return false;
    if (step && step->severity < min_severity) return false;
    return raywatch::covers(events, event.type);
  }
};

std::vector<Interest> interests(const Snapshot& snapshot) {
  Statement rows(database_of(snapshot),
                 "SELECT id, kind, site, min_severity, events FROM channels WHERE id > 0 AND enabled = 1 ORDER BY id");
  std::vector<Interest> all;
  while (rows.next()) {
    Interest& interest = all.emplace_back();
    interest.channel = rows.take<ChannelId>();
    interest.kind = rows.take<std::string>();
    interest.site = rows.take<std::optional<SiteId>>();
    interest.min_severity = parse_severity(rows.take<std::string>());
    interest.events = texts_from_json(rows.take<std::string>());
  }
  return all;
}

void insert_delivery(Database& database, const Interest& to, const Event& event, std::optional<std::int64_t> step) {
  const auto waiting = database.find<std::int64_t>(
      "SELECT count(*) FROM deliveries INDEXED BY deliveries_pending WHERE channel = ? AND state = 'pending'",
      to.channel);
  const bool full = *waiting >= kMostPending;
  // The id is random, so that it is like no other in another store, too; it is made once, and committed.
  database.run(
      "INSERT INTO deliveries (channel, kind, event, alert, step, type, message_id, body, state, attempts, created_at, "
      "queued_at, next_attempt_at, ended_at, error) "
      "VALUES (?, ?, ?, ?, ?, ?, 'msg_' || lower(hex(randomblob(16))), '', ?, 0, ?, ?, ?, ?, ?)",
      to.channel, to.kind, event.id, event.alert, step, event.type,
      to_string(full ? DeliveryState::dropped : DeliveryState::pending), event.at, event.at, event.at,
      full ? std::optional(event.at) : std::nullopt, full ? "too many wait for this channel already" : "");
}

std::string where(const DeliveryFilter& filter) {
  std::string index;
  if (filter.alert) {
    index = "INDEXED BY deliveries_by_alert ";
  } else if (filter.channel) {
    index = filter.state ? "INDEXED BY deliveries_by_channel_and_state " : "INDEXED BY deliveries_by_channel ";
  } else if (filter.state) {
    index = "INDEXED BY deliveries_by_state ";
  }
  return index + "WHERE " + (filter.alert ? "alert = ? AND " : "") + (filter.channel ? "channel = ? AND " : "") +
         (filter.state ? "state = ? AND " : "");
}

}  // namespace

std::string_view to_string(DeliveryState state) { return name_of(kDeliveryStates, state); }
DeliveryState parse_delivery_state(std::string_view name) { return value_of(kDeliveryStates, name, "state"); }

void queue_deliveries(Transaction& transaction, const Event& event) {
  const std::vector<Interest> all = interests(transaction);
  if (all.empty()) return;
  const std::optional<AlertStepKey> step = step_of(transaction, event);
  for (const Interest& interest : all) {
    if (!interest.covers(event, step)) continue;
    insert_delivery(database_of(transaction), interest, event, step ? std::optional(step->place) : std::nullopt);
  }
}

std::optional<DeliveryRecord> start_delivery(Transaction& transaction, ChannelId channel, Time now) {
  Database& database = database_of(transaction);
  const auto id = database.find<DeliveryId>(
      "SELECT id FROM deliveries INDEXED BY deliveries_pending WHERE channel = ? AND state = 'pending' AND "
      "next_attempt_at <= ? ORDER BY next_attempt_at, id LIMIT 1",
      channel, now);
  if (!id) return std::nullopt;
  database.run("UPDATE deliveries SET state = 'sending', attempts = attempts + 1, last_attempt_at = ? WHERE id = ?",
               now, *id);
  return find_delivery(transaction, *id);
}

void set_body(Transaction& transaction, DeliveryId id, std::string_view body) {
  database_of(transaction).run("UPDATE deliveries SET body = ? WHERE id = ?", body, id);
}

void end_attempt(Transaction& transaction, DeliveryId id, const AttemptEnd& end) {
  const bool again = end.state == DeliveryState::pending;
  database_of(transaction)
      .run(
          "UPDATE deliveries SET state = ?, next_attempt_at = ifnull(?, next_attempt_at), ended_at = ?, took_ms = ?, "
          "response_code = ?, error = ? WHERE id = ?",
          to_string(end.state), again ? std::optional(end.next_attempt_at) : std::nullopt,
          again ? std::nullopt : std::optional(end.at), end.took_ms, end.response_code, end.error, id);
}

void requeue_started_deliveries(Transaction& transaction, ChannelId channel) {
  database_of(transaction)
      .run(
          "UPDATE deliveries INDEXED BY deliveries_sending SET state = 'pending' "
          "WHERE channel = ? AND state = 'sending'",
          channel);
}

void hasten_deliveries(Transaction& transaction, ChannelId channel, Time now) {
  database_of(transaction)
      .run(
          "UPDATE deliveries INDEXED BY deliveries_pending SET next_attempt_at = ? "
          "WHERE channel = ? AND state = 'pending' AND next_attempt_at > ?",
          now, channel, now);
}

void drop_deliveries(Transaction& transaction, ChannelId channel, std::string_view why, Time now) {
  for (const DeliveryState state : {DeliveryState::pending, DeliveryState::sending}) {
    database_of(transaction)
        .run(
            "UPDATE deliveries INDEXED BY deliveries_by_channel_and_state SET state = 'dropped', ended_at = ?, "
            "error = ? WHERE channel = ? AND state = ?",
            now, why, channel, to_string(state));
  }
}

DeliveryRecord retry_delivery(Transaction& transaction, DeliveryId id, Time now) {
  const std::optional<DeliveryRecord> delivery = find_delivery(transaction, id);
  if (!delivery) throw NotFound("there is no delivery " + std::to_string(id.value));
  if (delivery->state != DeliveryState::failed && delivery->state != DeliveryState::dropped) {
    throw Conflict("delivery " + std::to_string(id.value) + " is " + std::string(to_string(delivery->state)) +
                   ": only what failed or was dropped can be sent again");
  }
  if (!find_channel(transaction, delivery->channel)) throw Conflict("the channel of the delivery was deleted");
  database_of(transaction)
      .run(
          "UPDATE deliveries SET state = 'pending', attempts = 0, queued_at = ?, next_attempt_at = ?, ended_at = NULL "
          "WHERE id = ?",
          now, now, id);
  return find_delivery(transaction, id).value();
}

std::int64_t prune_deliveries(Transaction& transaction, Time before, std::int64_t limit) {
  Database& database = database_of(transaction);
  database.run(
      "DELETE FROM deliveries WHERE id IN (SELECT id FROM deliveries INDEXED BY deliveries_by_end "
      "WHERE ended_at IS NOT NULL AND ended_at < ? LIMIT ?)",
      before, limit);
  return database.changed_rows();
}

std::optional<DeliveryRecord> find_delivery(const Snapshot& snapshot, DeliveryId id) {
  Statement row(database_of(snapshot), kSelectDeliveries + "WHERE id = ?");
  if (!row.bind(id).next()) return std::nullopt;
  return read_delivery(row);
}

std::optional<Time> next_attempt_of(const Snapshot& snapshot, ChannelId channel) {
  return database_of(snapshot)
      .find<std::optional<Time>>(
          "SELECT min(next_attempt_at) FROM deliveries INDEXED BY deliveries_pending WHERE channel = ? AND state = "
          "'pending'",
          channel)
      .value_or(std::nullopt);
}

Page<DeliveryRecord> list_deliveries(const Snapshot& snapshot, const DeliveryFilter& filter, const PageRequest& page) {
  const auto [before] = key_before<1>(page, kDeliveryList, {std::numeric_limits<std::int64_t>::max()});
  Statement rows(database_of(snapshot), kSelectDeliveries + where(filter) + "id < ? ORDER BY id DESC LIMIT ?");
  if (filter.alert) rows.bind(*filter.alert);
  if (filter.channel) rows.bind(*filter.channel);
  if (filter.state) rows.bind(to_string(*filter.state));
  rows.bind(before, rows_to_read(page));
  std::vector<DeliveryRecord> deliveries;
  while (rows.next()) deliveries.push_back(read_delivery(rows));
  return make_page(std::move(deliveries), page, kDeliveryList,
                   [](const DeliveryRecord& d) { return std::array{d.id.value}; });
}

std::map<ChannelKind, std::uint64_t> unfinished_deliveries(const Snapshot& snapshot) {
  std::map<ChannelKind, std::uint64_t> counts;
  for (const DeliveryState state : {DeliveryState::pending, DeliveryState::sending}) {
    Statement rows(database_of(snapshot), "SELECT kind FROM deliveries INDEXED BY deliveries_by_state WHERE state = ?");
    rows.bind(to_string(state));
    while (rows.next()) ++counts[parse_channel_kind(rows.take<std::string>())];
  }
  return counts;
}

}  // namespace raywatch
