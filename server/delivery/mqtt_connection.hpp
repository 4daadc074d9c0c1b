#pragma once

#include <chrono>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>

#include "server/delivery/delivery_config.hpp"
#include "storage/channels.hpp"

namespace raywatch {

/// One connection to a broker, driven by whoever calls: it has no thread of its own. Once it is lost it stays so. Not
/// thread-safe.
class MqttConnection {
 public:
  /// @param will_topic gets "offline", retained, when the connection is lost; empty: none
  /// @throws core/error.hpp when libmosquitto cannot be used.
  MqttConnection(const MqttSettings& settings, const SenderConfig& config, const std::string& will_topic);
  ~MqttConnection();
  MqttConnection(const MqttConnection&) = delete;
  MqttConnection& operator=(const MqttConnection&) = delete;

  /// Waits until the broker has let it in. @returns what went wrong; empty when nothing did.
  std::string open(const std::stop_token& stop);
  /// Publishes with QoS 1 and waits until the broker has acknowledged it. @returns what went wrong; empty: nothing.
  std::string publish(const std::string& topic, const std::string& payload, bool retained, const std::stop_token& stop);
  /// Reads and writes what is due, and waits for no more.
  void tend();
  bool is_open() const;
  /// The broker's answer to the log-in, if it gave one.
  std::optional<int> answer() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// What libmosquitto needs once, before the first thread that uses it.
class MqttLibrary {
 public:
  MqttLibrary();
  ~MqttLibrary();
  MqttLibrary(const MqttLibrary&) = delete;
  MqttLibrary& operator=(const MqttLibrary&) = delete;
};

}  // namespace raywatch
