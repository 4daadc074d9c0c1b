#include "storage/channel_columns.hpp"

#include <nlohmann/json.hpp>

#include "storage/columns.hpp"

namespace raywatch {
namespace {

using Json = nlohmann::json;

struct SettingsToJson {
  Json operator()(const WebhookSettings& s) const { return {{"url", s.url}, {"secrets", s.secrets}}; }
  Json operator()(const MailSettings& s) const {
    return {{"host", s.host}, {"port", s.port},         {"security", to_string(s.security)},
            {"user", s.user}, {"password", s.password}, {"from", s.from},
            {"to", s.to}};
  }
  Json operator()(const MqttSettings& s) const {
    return {{"host", s.host},
            {"port", s.port},
            {"tls", s.tls},
            {"user", s.user},
            {"password", s.password},
            {"topic_prefix", s.topic_prefix},
            {"discovery_prefix", s.discovery_prefix}};
  }
};

MailSecurity security_of(const std::string& name) {
  return enum_from_text(name, {MailSecurity::none, MailSecurity::starttls, MailSecurity::tls});
}

ChannelSettings read_settings(ChannelKind kind, const Json& json) {
  const auto text = [&](const char* name) { return json.at(name).get<std::string>(); };
  const auto texts = [&](const char* name) { return json.at(name).get<std::vector<std::string>>(); };
  const auto port = [&] { return json.at("port").get<std::uint16_t>(); };
  switch (kind) {
    case ChannelKind::webhook:
      return WebhookSettings{.url = text("url"), .secrets = texts("secrets")};
    case ChannelKind::mail:
      return MailSettings{.host = text("host"),
                          .port = port(),
                          .security = security_of(text("security")),
                          .user = text("user"),
                          .password = text("password"),
                          .from = text("from"),
                          .to = texts("to")};
    case ChannelKind::mqtt:
      return MqttSettings{.host = text("host"),
                          .port = port(),
                          .tls = json.at("tls").get<bool>(),
                          .user = text("user"),
                          .password = text("password"),
                          .topic_prefix = text("topic_prefix"),
                          .discovery_prefix = text("discovery_prefix")};
  }
  throw CorruptData("the store holds a channel of an unknown kind");
}

}  // namespace

std::string settings_json(const ChannelSettings& settings) { return std::visit(SettingsToJson{}, settings).dump(); }

ChannelSettings settings_from_json(ChannelKind kind, const std::string& text) {
  try {
    return read_settings(kind, Json::parse(text));
  } catch (const Json::exception& error) {
    throw CorruptData(std::string("the store holds broken settings of a channel: ") + error.what());
  }
}

}  // namespace raywatch
