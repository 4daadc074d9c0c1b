#include "server/delivery/webhook_sender.hpp"

#include <algorithm>

#include "server/delivery/transfer.hpp"
#include "server/delivery/webhook_signature.hpp"

namespace raywatch {
namespace {

/// The beginning of an answer as one readable line: it may be anything.
std::string readable(std::string text) {
  constexpr std::size_t kMost = 200;
  if (text.size() > kMost) text.resize(kMost);
  std::ranges::replace_if(
      text, [](char c) { return c < 0x20 || c >= 0x7F; }, ' ');
  return text;
}

std::string refusal(const TransferEnd& end) {
  const std::string said = readable(end.content);
  return "the receiver answered with " + std::to_string(end.response_code) + (said.empty() ? "" : ": " + said);
}

}  // namespace

SendResult WebhookSender::send(const Message& message, const std::stop_token& stop) {
  Transfer transfer(settings_.url, "http,https", config_);
  transfer.post(
      message.body,
      {"Content-Type: application/json", "User-Agent: raywatch", "Expect:", "webhook-id: " + message.id,
       "webhook-timestamp: " + std::to_string(unix_seconds(message.sent_at)),
       "webhook-signature: " + webhook_signature(settings_.secrets, message.id, message.sent_at, message.body)});
  const TransferEnd end = transfer.run(stop);
  SendResult result{.interrupted = end.interrupted, .retry_after = end.retry_after};
  if (end.response_code != 0) result.response_code = end.response_code;
  result.delivered = end.complete && end.response_code / 100 == 2;
  result.gone = end.complete && end.response_code == 410;
  if (!result.delivered) result.error = end.complete ? refusal(end) : end.error;
  return result;
}

}  // namespace raywatch
