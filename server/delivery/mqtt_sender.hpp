#pragma once

#include <chrono>
#include <memory>

#include "server/delivery/mqtt_connection.hpp"
#include "server/delivery/sender.hpp"

namespace raywatch {

/// Publishes messages with QoS 1, each delivered when the broker has acknowledged it: alerts to PREFIX/SITE/alerts,
/// other events to PREFIX/SITE/events, both with the message's `id`. When it is given a state, it keeps that up, too:
/// retained, with PREFIX/status as "online" or, by a last will, "offline".
class MqttSender final : public Sender {
 public:
  MqttSender(const MqttSettings& settings, const SenderConfig& config, std::function<RetainedTopics()> state);
  ~MqttSender() override;

  SendResult send(const Message& message, const std::stop_token& stop) override;
  /// What cannot be published now is published when the broker is there again.
  void tend(const std::stop_token& stop) override;

 private:
  /// Connects, unless it is. @returns what went wrong; empty when nothing did.
  std::string connect(const std::stop_token& stop);
  std::string publish_state(const std::stop_token& stop);
  std::string topic(const std::string& rest) const { return settings_.topic_prefix + "/" + rest; }

  MqttSettings settings_;
  SenderConfig config_;
  std::function<RetainedTopics()> state_;
  std::unique_ptr<MqttConnection> connection_;
  RetainedTopics published_;  ///< by this connection
  std::chrono::steady_clock::time_point rest_until_{};
};

}  // namespace raywatch
