#include "server/delivery/mqtt_sender.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <utility>

#include "api/json.hpp"
#include "api/text_values.hpp"
#include "core/error.hpp"

namespace raywatch {
namespace {

using Clock = std::chrono::steady_clock;

/// A broker that is not there is looked for this often for the sake of the state alone; and so often, at most, the
/// state is looked at while much happens.
constexpr std::chrono::milliseconds kBrokerRest{10'000}, kStatePause{500};
constexpr const char* kStatus = "status";

/// Below the prefix: by site, so that who is responsible for one hears of that alone.
std::string topic_of(const Json& body) {
  const Json& data = body["data"];
  const std::string kind = body["type"].get<std::string>().starts_with("alert.") ? "alerts" : "events";
  const auto site = data.find("site");
  if (site == data.end() || !site->is_string()) return kind;
  return percent_encoded(site->get<std::string>()) + "/" + kind;
}

}  // namespace

MqttSender::MqttSender(const MqttSettings& settings, const SenderConfig& config, std::function<RetainedTopics()> state)
    : settings_(settings), config_(config), state_(std::move(state)) {}

MqttSender::~MqttSender() {
  if (!connection_ || !connection_->is_open() || !state_) return;
  // A clean end sends no last will.
  config_.timeout = std::chrono::milliseconds(500);
  connection_->publish(topic(kStatus), "offline", true, {});
}

std::string MqttSender::connect(const std::stop_token& stop) {
  if (connection_ && connection_->is_open()) connection_->tend();  // it may have been lost meanwhile
  if (connection_ && connection_->is_open()) return {};
  published_.clear();
  try {
    connection_ = std::make_unique<MqttConnection>(settings_, config_, state_ ? topic(kStatus) : "");
  } catch (const Error& error) {  // certificates that cannot be read
    return error.what();
  }
  std::string trouble = connection_->open(stop);
  if (trouble.empty() && state_) trouble = connection_->publish(topic(kStatus), "online", true, stop);
  return trouble;
}

SendResult MqttSender::send(const Message& message, const std::stop_token& stop) {
  Json body = Json::parse(message.body);
  const std::string where = topic(topic_of(body));
  body["id"] = message.id;
  SendResult result{.error = connect(stop)};
  if (result.error.empty()) result.error = connection_->publish(where, to_json_text(body), false, stop);
  if (connection_) result.response_code = connection_->answer();
  result.delivered = result.error.empty();
  result.interrupted = !result.delivered && stop.stop_requested();
  if (!result.delivered) connection_.reset();
  if (result.delivered) rest_until_ = std::min(rest_until_, Clock::now() + kStatePause);  // the broker is there again
  return result;
}

void MqttSender::tend(const std::stop_token& stop) {
  if (!state_ || Clock::now() < rest_until_) return;
  std::string trouble = connect(stop);
  if (trouble.empty()) trouble = publish_state(stop);
  rest_until_ = Clock::now() + kStatePause;
  if (trouble.empty() || stop.stop_requested()) return;
  spdlog::warn("MQTT broker {}: the state cannot be shown: {}", settings_.host, trouble);
  connection_.reset();
  rest_until_ = Clock::now() + kBrokerRest;
}

std::string MqttSender::publish_state(const std::stop_token& stop) {
  RetainedTopics wanted = state_();
  for (const auto& [topic, payload] : published_) wanted.try_emplace(topic, "");  // empty: it is no more
  for (const auto& [topic, payload] : wanted) {
    const auto known = published_.find(topic);
    if (known != published_.end() && known->second == payload) continue;
    std::string trouble = connection_->publish(topic, payload, true, stop);
    if (!trouble.empty()) return trouble;
    published_[topic] = payload;
  }
  std::erase_if(published_, [](const auto& entry) { return entry.second.empty(); });
  return {};
}

}  // namespace raywatch
