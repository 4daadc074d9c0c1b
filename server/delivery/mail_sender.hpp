#pragma once

#include "server/delivery/sender.hpp"

namespace raywatch {

/// Sends each message as one mail to all addresses.
class MailSender final : public Sender {
 public:
  MailSender(const MailSettings& settings, const SenderConfig& config) : settings_(settings), config_(config) {}
  SendResult send(const Message& message, const std::stop_token& stop) override;

 private:
  MailSettings settings_;
  SenderConfig config_;
};

}  // namespace raywatch
