#pragma once

#include <chrono>
#include <condition_variable>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <stop_token>
#include <thread>
#include <vector>

#include "api/services.hpp"
#include "server/delivery/channel_runner.hpp"
#include "server/delivery/delivery_config.hpp"
#include "server/delivery/mqtt_connection.hpp"
#include "server/delivery/sender.hpp"
#include "server/delivery/transfer.hpp"
#include "storage/channels.hpp"
#include "storage/store.hpp"

namespace raywatch {

/// Tells others what happened: keeps one thread for each enabled channel, which sends what the outbox holds for it, and
/// prunes the log. What is in the outbox is sent at least once, however often the program ends. Thread-safe.
class Deliverer {
 public:
  Deliverer(Store& store, const DeliveryConfig& config, std::function<Time()> now);
  /// Waits for the threads.
  ~Deliverer();

  /// Sends a test by itself, at once, past the outbox and its pace. @throws NotFound.
  ChannelTest test(ChannelId channel);
  /// Deletes a channel and resolves the alerts about it. @throws NotFound.
  void delete_channel(ChannelId channel);
  /// By kind. @throws core/error.hpp when the store cannot be read.
  std::vector<DeliveryFigures> figures() const;

  /// Attempts under way are broken off.
  void request_stop();
  /// After `request_stop`: true when all ended before the deadline.
  bool wait_stopped(std::chrono::steady_clock::time_point deadline);

 private:
  void supervise();
  void match_runners(const std::vector<ChannelRecord>& enabled);
  void tell_of_outages(const std::vector<ChannelRecord>& enabled, Time now);
  void settle_disabled(Time now);
  void prune(Time now);

  const TransferLibrary transfers_;
  const MqttLibrary mqtt_;
  Store& store_;
  const DeliveryConfig config_;
  const std::function<Time()> now_;
  DeliveryCounters counters_;
  std::map<ChannelId, std::unique_ptr<ChannelRunner>> runners_;  ///< of the supervising thread
  Time pruned_at_{};
  std::stop_source stop_;
  std::mutex mutex_;
  std::condition_variable ended_;
  bool has_ended_ = false;
  std::jthread thread_;  // last: it uses all of the above
};

}  // namespace raywatch
