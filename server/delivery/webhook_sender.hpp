#pragma once

#include "server/delivery/sender.hpp"

namespace raywatch {

/// POSTs messages as JSON, signed after the Standard Webhooks scheme. A status of 2xx is taken for a receipt; 410 says
/// that the receiver wants no more.
class WebhookSender final : public Sender {
 public:
  WebhookSender(const WebhookSettings& settings, const SenderConfig& config) : settings_(settings), config_(config) {}
  SendResult send(const Message& message, const std::stop_token& stop) override;

 private:
  WebhookSettings settings_;
  SenderConfig config_;
};

}  // namespace raywatch
