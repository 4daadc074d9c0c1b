#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>

#include "core/time.hpp"
#include "server/delivery/delivery_config.hpp"
#include "storage/channels.hpp"

namespace raywatch {

/// What is sent. The content follows from the body alone, so that each attempt sends the same.
struct Message {
  std::string id;
  std::string type;  ///< such as "alert.opened"
  std::string body;  ///< JSON {"type", "timestamp", "data"}
  Time sent_at;      ///< this attempt
};

/// How an attempt went. What fails on the way is an expected outcome: nothing is thrown.
struct SendResult {
  bool delivered = false;
  bool interrupted = false;                         ///< it was asked to stop: nobody knows whether it arrived
  bool gone = false;                                ///< the receiver wants no more
  std::optional<std::int64_t> response_code;        ///< of HTTP, SMTP or MQTT
  std::string error;                                ///< one line; empty when it was delivered
  std::optional<std::chrono::seconds> retry_after;  ///< as the receiver asked
};

/// Sends messages to one receiver. Not thread-safe: each channel's thread has its own.
class Sender {
 public:
  virtual ~Sender() = default;
  /// Returns within the configured timeout, and at once when it is asked to stop.
  virtual SendResult send(const Message& message, const std::stop_token& stop) = 0;
  /// Called about once a second between messages, for what must be kept up without any.
  virtual void tend(const std::stop_token& /*stop*/) {}
};

/// What an MQTT broker keeps for whoever asks: payloads by topic.
using RetainedTopics = std::map<std::string, std::string>;

/// @param state what an MQTT channel shows between messages; not given: nothing
std::unique_ptr<Sender> make_sender(const ChannelSettings& settings, const SenderConfig& config,
                                    std::function<RetainedTopics()> state = {});

}  // namespace raywatch
