#include "server/delivery/sender.hpp"

#include "server/delivery/mail_sender.hpp"
#include "server/delivery/mqtt_sender.hpp"
#include "server/delivery/webhook_sender.hpp"

namespace raywatch {

std::unique_ptr<Sender> make_sender(const ChannelSettings& settings, const SenderConfig& config,
                                    std::function<RetainedTopics()> state) {
  struct Make {
    const SenderConfig& config;
    std::function<RetainedTopics()>& state;
    std::unique_ptr<Sender> operator()(const WebhookSettings& s) const {
      return std::make_unique<WebhookSender>(s, config);
    }
    std::unique_ptr<Sender> operator()(const MailSettings& s) const { return std::make_unique<MailSender>(s, config); }
    std::unique_ptr<Sender> operator()(const MqttSettings& s) const {
      return std::make_unique<MqttSender>(s, config, std::move(state));
    }
  };
  return std::visit(Make{config, state}, settings);
}

}  // namespace raywatch
