#include "server/delivery/deliverer.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <exception>

#include "api/lookup.hpp"
#include "server/delivery/failing_channel.hpp"
#include "server/delivery/notice.hpp"
#include "storage/signal.hpp"

namespace raywatch {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::seconds kDelivererPatience{1};
constexpr std::chrono::hours kPruneEvery{1};
/// At once, so that others can write between.
constexpr std::int64_t kPruned = 1000;

}  // namespace

Deliverer::Deliverer(Store& store, const DeliveryConfig& config, std::function<Time()> now)
    : store_(store), config_(config), now_(std::move(now)), thread_([this] { supervise(); }) {}

Deliverer::~Deliverer() { request_stop(); }

void Deliverer::request_stop() { stop_.request_stop(); }

bool Deliverer::wait_stopped(Clock::time_point deadline) {
  std::unique_lock lock(mutex_);
  return ended_.wait_until(lock, deadline, [this] { return has_ended_; });
}

void Deliverer::supervise() {
  const std::stop_token stop = stop_.get_token();
  while (!stop.stop_requested() && !store_.commits().is_closed()) {
    const std::uint64_t seen = store_.commits().generation();
    try {
      const auto enabled = store_.read([](const Snapshot& snapshot) { return enabled_channels(snapshot); });
      match_runners(enabled);
      tell_of_outages(enabled, now_());
      settle_disabled(now_());
      prune(now_());
    } catch (const std::exception& error) {
      spdlog::error("the channels cannot be looked after: {}", error.what());
    }
    if (!stop.stop_requested()) store_.commits().wait_past(seen, Clock::now() + kDelivererPatience);
  }
  for (const auto& [id, runner] : runners_) runner->request_stop();
  runners_.clear();
  const std::lock_guard lock(mutex_);
  has_ended_ = true;
  ended_.notify_all();
}

/// One runner for each enabled channel, made from its latest revision.
void Deliverer::match_runners(const std::vector<ChannelRecord>& enabled) {
  std::erase_if(runners_, [&](const auto& entry) {
    return std::ranges::none_of(enabled, [&](const ChannelRecord& channel) {
      return channel.id == entry.first && channel.revision == entry.second->revision();
    });
  });
  for (const ChannelRecord& channel : enabled) {
    if (runners_.contains(channel.id)) continue;
    runners_[channel.id] = std::make_unique<ChannelRunner>(store_, config_, now_, counters_, channel);
  }
}

/// The next attempt may be hours away.
void Deliverer::tell_of_outages(const std::vector<ChannelRecord>& enabled, Time now) {
  for (const ChannelRecord& channel : enabled) {
    if (!channel.failing_since || now - *channel.failing_since < config_.alarm_after) continue;
    if (store_.read([&](const Snapshot& snapshot) { return is_told_failing(snapshot, channel); })) continue;
    store_.write([&](Transaction& transaction) {
      const std::optional<ChannelRecord> still = find_channel(transaction, channel.id);
      if (still && still->failing_since) tell_failing(transaction, *still, still->trouble, now);
    });
  }
}

void Deliverer::settle_disabled(Time now) {
  const auto channels = store_.read([](const Snapshot& snapshot) { return disabled_while_failing(snapshot); });
  for (const ChannelRecord& channel : channels) {
    store_.write(
        [&](Transaction& transaction) { settle_failing(transaction, channel, "The channel was disabled.", now); });
  }
}

void Deliverer::prune(Time now) {
  if (now - pruned_at_ < kPruneEvery) return;
  const auto pruned = store_.write(
      [&](Transaction& transaction) { return prune_deliveries(transaction, now - config_.keep, kPruned); });
  if (pruned < kPruned) pruned_at_ = now;
}

ChannelTest Deliverer::test(ChannelId id) {
  const ChannelRecord channel = store_.read([&](const Snapshot& snapshot) { return channel_with(snapshot, id); });
  const Time now = now_();
  const auto begin = Clock::now();
  const std::unique_ptr<Sender> sender = make_sender(channel.settings, config_.sender);
  // Each test is a message of its own.
  const std::string message_id =
      "msg_test_" + std::to_string(channel.id.value) + "_" + std::to_string(now.time_since_epoch().count());
  const SendResult result = sender->send(
      {.id = message_id, .type = "test", .body = compose_test(channel, now), .sent_at = now}, stop_.get_token());
  return {.delivered = result.delivered,
          .response_code = result.response_code,
          .error = result.error,
          .took_ms = std::chrono::duration<double, std::milli>(Clock::now() - begin).count()};
}

std::vector<DeliveryFigures> Deliverer::figures() const {
  auto pending = store_.read([](const Snapshot& snapshot) { return unfinished_deliveries(snapshot); });
  std::vector<DeliveryFigures> all;
  for (const ChannelKind kind : {ChannelKind::webhook, ChannelKind::mail, ChannelKind::mqtt}) {
    const auto place = static_cast<std::size_t>(kind);
    all.push_back({kind, pending[kind], counters_.delivered[place], counters_.failed[place]});
  }
  return all;
}

void Deliverer::delete_channel(ChannelId id) {
  const Time now = now_();
  store_.write([&](Transaction& transaction) {
    const ChannelRecord channel = channel_with(transaction, id);
    raywatch::delete_channel(transaction, id, now);
    settle_failing(transaction, channel, "The channel was deleted.", now);
  });
}

}  // namespace raywatch
