#include "server/delivery/channel_runner.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <utility>

#include "core/error.hpp"
#include "server/delivery/failing_channel.hpp"
#include "server/delivery/mqtt_state.hpp"
#include "server/delivery/notice.hpp"
#include "storage/signal.hpp"

namespace raywatch {
namespace {

using Clock = std::chrono::steady_clock;

/// So long it takes at most until what became due by the clock alone is seen.
constexpr std::chrono::seconds kChannelPatience{1};
/// After so many failures in a row it was the receiver: when it is back, everything that waits is sent at once.
constexpr std::uint32_t kOutage = 3;

std::function<RetainedTopics()> state_of(Store& store, const ChannelRecord& channel) {
  if (channel.kind() != ChannelKind::mqtt) return {};
  return [&store, settings = std::get<MqttSettings>(channel.settings), site = channel.site] {
    return store.read([&](const Snapshot& snapshot) { return mqtt_state(snapshot, settings, site); });
  };
}

double milliseconds_since(Clock::time_point begin) {
  return std::chrono::duration<double, std::milli>(Clock::now() - begin).count();
}

bool is_passing(const Error& error) {
  return dynamic_cast<const StorageError*>(&error) != nullptr && dynamic_cast<const CorruptData*>(&error) == nullptr;
}

}  // namespace

ChannelRunner::ChannelRunner(Store& store, const DeliveryConfig& config, const std::function<Time()>& now,
                             DeliveryCounters& counters, const ChannelRecord& channel)
    : store_(store),
      config_(config),
      now_(now),
      counters_(counters),
      channel_(channel),
      pace_(channel.per_minute, config.retry_delays.front()),
      sender_(make_sender(channel.settings, config.sender, state_of(store, channel))),
      thread_([this](const std::stop_token& stop) { work(stop); }) {}

void ChannelRunner::work(const std::stop_token& stop) {
  bool is_clean = false;
  while (!stop.stop_requested() && !gone_ && !store_.commits().is_closed()) {
    const std::uint64_t seen = store_.commits().generation();
    try {
      if (!is_clean) {
        store_.write([&](Transaction& transaction) { requeue_started_deliveries(transaction, channel_.id); });
      }
      is_clean = true;
      sender_->tend(stop);
      if (const std::optional<DeliveryRecord> next = take_next()) {
        is_clean = false;  // until it is written down how it ended
        send(*next, stop);
        is_clean = true;
        continue;
      }
    } catch (const std::exception& error) {
      spdlog::error("channel {}: {}", channel_.name, error.what());
    }
    wait(seen, stop);
  }
}

/// Until something was committed, or until the pace allows the next message.
void ChannelRunner::wait(std::uint64_t seen, const std::stop_token& stop) {
  const auto now = Clock::now();
  const auto paced = std::min(pace_.next(), now + kChannelPatience);
  if (paced <= now) {
    store_.commits().wait_past(seen, now + kChannelPatience);
    return;
  }
  std::mutex mutex;
  std::unique_lock lock(mutex);
  std::condition_variable_any().wait_until(lock, stop, paced, [] { return false; });
}

std::optional<DeliveryRecord> ChannelRunner::take_next() {
  if (pace_.next() > Clock::now()) return std::nullopt;
  const Time now = now_();
  const auto due = store_.read([&](const Snapshot& snapshot) { return next_attempt_of(snapshot, channel_.id); });
  if (!due || *due > now) return std::nullopt;
  return store_.write([&](Transaction& transaction) {
    std::optional<DeliveryRecord> started = start_delivery(transaction, channel_.id, now);
    if (!started || !started->body.empty()) return started;
    try {
      started->body = compose_notice(transaction, *started, config_.public_url);
      set_body(transaction, started->id, started->body);
    } catch (const Error& error) {
      // What cannot be read on a broken disk waits; what was deleted, or is damaged, will never be told.
      if (is_passing(error)) throw;
      end_attempt(transaction, started->id, {.state = DeliveryState::dropped, .at = now, .error = error.what()});
      started.reset();
    }
    return started;
  });
}

void ChannelRunner::send(const DeliveryRecord& delivery, const std::stop_token& stop) {
  const auto begin = Clock::now();
  pace_.sent(begin);
  const SendResult result =
      sender_->send({.id = delivery.message_id, .type = delivery.type, .body = delivery.body, .sent_at = now_()}, stop);
  if (result.interrupted) {
    return store_.write([&](Transaction& transaction) { requeue_started_deliveries(transaction, channel_.id); });
  }
  AttemptEnd end = end_of(delivery, result, now_());
  end.took_ms = milliseconds_since(begin);
  const bool was_out = pace_.failures_in_a_row() >= kOutage;
  if (result.delivered) {
    pace_.succeeded();
  } else {
    pace_.failed(Clock::now(), result.retry_after.value_or(std::chrono::seconds(0)));
    spdlog::warn("channel {}: delivery {}, attempt {}: {}", channel_.name, delivery.id.value, delivery.attempts,
                 result.error);
  }
  store_.write([&](Transaction& transaction) {
    write_down(transaction, delivery, result, end);
    if (result.delivered && was_out) hasten_deliveries(transaction, channel_.id, end.at);
  });
  channel_.trouble = result.error;
  channel_.failing_since = result.delivered ? std::nullopt : std::optional(channel_.failing_since.value_or(end.at));
  gone_ = result.gone;
  const auto kind = static_cast<std::size_t>(channel_.kind());
  if (end.state == DeliveryState::delivered) ++counters_.delivered[kind];
  if (end.state == DeliveryState::failed) ++counters_.failed[kind];
}

AttemptEnd ChannelRunner::end_of(const DeliveryRecord& delivery, const SendResult& result, Time now) {
  AttemptEnd end{.at = now, .response_code = result.response_code, .error = result.error};
  if (result.delivered) return end;
  const bool given_up =
      result.gone || delivery.attempts >= config_.attempts || now - delivery.queued_at >= config_.give_up_after;
  end.state = given_up ? DeliveryState::failed : DeliveryState::pending;
  const Duration asked = result.retry_after.value_or(std::chrono::seconds(0));
  const Duration planned = retry_delay(config_.retry_delays, delivery.attempts, random_);
  end.next_attempt_at = now + std::max(planned, std::min<Duration>(asked, std::chrono::hours(24)));
  return end;
}

void ChannelRunner::write_down(Transaction& transaction, const DeliveryRecord& delivery, const SendResult& result,
                               const AttemptEnd& end) {
  if (!result.delivered && !find_channel(transaction, channel_.id)) return;  // it was dropped with its channel
  end_attempt(transaction, delivery.id, end);
  if (result.delivered) {
    if (channel_.trouble.empty()) return;
    note_health(transaction, channel_.id, {});
    return settle_failing(transaction, channel_, "A message went out again.", end.at);
  }
  const Time since = channel_.failing_since.value_or(end.at);
  note_health(transaction, channel_.id, {.trouble = result.error, .failing_since = since, .disable = result.gone});
  if (end.state == DeliveryState::failed) tell_failing(transaction, channel_, result.error, end.at);
}

}  // namespace raywatch
