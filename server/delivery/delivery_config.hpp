#pragma once

#include <chrono>
#include <cstdint>
#include <string>
#include <vector>

namespace raywatch {

/// How one message is sent.
struct SenderConfig {
  std::chrono::milliseconds connect_timeout{5000};
  std::chrono::milliseconds timeout{15000};  ///< of the whole attempt
  std::string proxy;                         ///< for HTTP, such as "http://proxy:3128"; empty: none
  std::string ca_file;                       ///< certificates to trust; empty: those of the machine
};

struct DeliveryConfig {
  std::string public_url;  ///< under which people reach this program; empty: messages have no link
  SenderConfig sender;
  std::uint32_t attempts = 10;            ///< given up after so many
  std::chrono::hours give_up_after{72};   ///< or so long after it was queued
  std::chrono::seconds alarm_after{600};  ///< a channel that failed for so long is told of
  std::chrono::hours keep{24 * 30};       ///< what ended is deleted from the log after this time
  /// Between attempts, as Standard Webhooks proposes; the last stands for all that follow.
  std::vector<std::chrono::milliseconds> retry_delays = {
      std::chrono::seconds(5), std::chrono::minutes(5), std::chrono::minutes(30),
      std::chrono::hours(2),   std::chrono::hours(5),   std::chrono::hours(10),
      std::chrono::hours(14),  std::chrono::hours(20),  std::chrono::hours(24)};
};

}  // namespace raywatch
