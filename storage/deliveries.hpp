#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/ids.hpp"
#include "core/time.hpp"
#include "storage/channels.hpp"
#include "storage/page.hpp"
#include "storage/store.hpp"

namespace raywatch {

struct Event;
using DeliveryId = Id<struct DeliveryTag>;

enum class DeliveryState : std::uint8_t {
  pending,    ///< waits for its next attempt
  sending,    ///< is under way; what a crash leaves so is sent again
  delivered,  ///< the receiver took it
  failed,     ///< given up
  dropped,    ///< never sent: too many waited, or the channel was deleted
};
std::string_view to_string(DeliveryState state);
/// @throws InvalidInput naming the known ones.
DeliveryState parse_delivery_state(std::string_view name);

/// One event on its way to one channel, at least once: receivers know by `message_id` what they have already.
struct DeliveryRecord {
  DeliveryId id;
  ChannelId channel;  ///< may be deleted meanwhile
  ChannelKind kind = ChannelKind::webhook;
  EventId event;
  std::optional<AlertId> alert;
  std::optional<std::int64_t> step;  ///< its place in the alert's history
  std::string type;                  ///< of the event
  std::string message_id;            ///< the same in all attempts, and like no other
  std::string body;                  ///< JSON, the same in all attempts; empty before the first
  DeliveryState state = DeliveryState::pending;
  std::uint32_t attempts = 0;  ///< since it was queued
  Time created_at;
  Time queued_at;  ///< when it was made, or an operator had it retried
  Time next_attempt_at;
  std::optional<Time> last_attempt_at, ended_at;
  std::optional<double> took_ms;              ///< the last attempt
  std::optional<std::int64_t> response_code;  ///< of HTTP or SMTP; of MQTT the reason
  std::string error;                          ///< of the last attempt; empty when it worked
};

/// Queues an event for every channel that wants it. Part of `insert_event`: what is committed is on its way.
void queue_deliveries(Transaction& transaction, const Event& event);
/// So many may wait for one channel; what comes then is written down as dropped.
inline constexpr std::int64_t kMostPending = 10'000;

/// The next one of a channel that is due becomes `sending`.
std::optional<DeliveryRecord> start_delivery(Transaction& transaction, ChannelId channel, Time now);
void set_body(Transaction& transaction, DeliveryId id, std::string_view body);

/// How an attempt ended.
struct AttemptEnd {
  DeliveryState state = DeliveryState::delivered;
  Time at;
  Time next_attempt_at;  ///< of the state pending
  std::optional<std::int64_t> response_code;
  std::string error;
  std::optional<double> took_ms;
};
void end_attempt(Transaction& transaction, DeliveryId id, const AttemptEnd& end);
/// Puts back what was under way when the program, or the channel, stopped: nobody knows whether it arrived.
void requeue_started_deliveries(Transaction& transaction, ChannelId channel);
/// Has everything that waits for a channel sent now, not later.
void hasten_deliveries(Transaction& transaction, ChannelId channel, Time now);
void drop_deliveries(Transaction& transaction, ChannelId channel, std::string_view why, Time now);
/// Has one that failed, or was dropped, sent again. @throws NotFound; Conflict when it is in another state, or its
/// channel was deleted.
DeliveryRecord retry_delivery(Transaction& transaction, DeliveryId id, Time now);
/// Deletes what ended before a moment, at most `limit`. @returns how many.
std::int64_t prune_deliveries(Transaction& transaction, Time before, std::int64_t limit);

std::optional<DeliveryRecord> find_delivery(const Snapshot& snapshot, DeliveryId id);
/// When the next attempt of a channel is due; nothing when none waits.
std::optional<Time> next_attempt_of(const Snapshot& snapshot, ChannelId channel);
struct DeliveryFilter {
  std::optional<ChannelId> channel;
  std::optional<DeliveryState> state;
  std::optional<AlertId> alert;
};
/// Newest first.
Page<DeliveryRecord> list_deliveries(const Snapshot& snapshot, const DeliveryFilter& filter, const PageRequest& page);
/// How many wait or are under way.
std::map<ChannelKind, std::uint64_t> unfinished_deliveries(const Snapshot& snapshot);

}  // namespace raywatch
