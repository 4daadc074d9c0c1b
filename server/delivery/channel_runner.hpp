#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <random>
#include <stop_token>
#include <thread>

#include "server/delivery/delivery_config.hpp"
#include "server/delivery/pace.hpp"
#include "server/delivery/sender.hpp"
#include "storage/deliveries.hpp"
#include "storage/store.hpp"

namespace raywatch {

/// Messages since the start, by channel kind.
struct DeliveryCounters {
  std::array<std::atomic<std::uint64_t>, 3> delivered{}, failed{};
};

/// The thread that sends what waits for one channel, so that a receiver that hangs delays nobody else. It has the
/// channel as it was when it started; an edited one gets another runner.
class ChannelRunner {
 public:
  ChannelRunner(Store& store, const DeliveryConfig& config, const std::function<Time()>& now,
                DeliveryCounters& counters, const ChannelRecord& channel);

  /// It ends soon; an attempt under way is broken off and put back.
  void request_stop() { thread_.request_stop(); }
  std::int64_t revision() const { return channel_.revision; }

 private:
  void work(const std::stop_token& stop);
  void wait(std::uint64_t seen, const std::stop_token& stop);
  std::optional<DeliveryRecord> take_next();
  void send(const DeliveryRecord& delivery, const std::stop_token& stop);
  AttemptEnd end_of(const DeliveryRecord& delivery, const SendResult& result, Time now);
  void write_down(Transaction& transaction, const DeliveryRecord& delivery, const SendResult& result,
                  const AttemptEnd& end);

  Store& store_;
  const DeliveryConfig& config_;
  const std::function<Time()>& now_;
  DeliveryCounters& counters_;
  ChannelRecord channel_;
  Pace pace_;
  std::mt19937_64 random_{std::random_device{}()};
  std::unique_ptr<Sender> sender_;
  bool gone_ = false;
  std::jthread thread_;  // last: it uses all of the above
};

}  // namespace raywatch
