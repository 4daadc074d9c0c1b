#include "api/parse_channel.hpp"

#include <algorithm>
#include <functional>

#include "api/channel_rules.hpp"
#include "api/json_object.hpp"
#include "api/name_rules.hpp"

namespace raywatch {
namespace {

using Check = std::function<std::string(const std::string&)>;

constexpr std::size_t kMostTexts = 50;

/// An array of texts that each pass a check; empty when it is absent or wrong.
std::vector<std::string> texts(JsonObject& body, const char* name, const Check& check) {
  std::vector<std::string> result;
  const nlohmann::json* array = body.any(name);
  if (array == nullptr) return result;
  if (!array->is_array() || array->empty() || array->size() > kMostTexts ||
      !std::ranges::all_of(*array, [](const nlohmann::json& text) { return text.is_string(); })) {
    body.fail(name, "must be an array of 1 to " + std::to_string(kMostTexts) + " texts");
    return result;
  }
  for (const nlohmann::json& text : *array) {
    try {
      result.push_back(check(text.get<std::string>()));
    } catch (const InvalidInput& error) {
      body.fail(name, error.what());
    }
  }
  return result;
}

std::uint16_t port_of(JsonObject& body, std::uint16_t usual) {
  return static_cast<std::uint16_t>(body.integer("port", {.min = 1, .max = 65535}).value_or(usual));
}

/// The password, or the one from before when none is given for the same user.
template <class Settings>
std::string password_of(JsonObject& body, const std::string& user, const Settings* before) {
  if (const auto given = body.parsed("password", checked_credential)) return *given;
  return before != nullptr && before->user == user && !body.is_null("password") ? before->password : "";
}

WebhookSettings parse_webhook(JsonObject& body, const WebhookSettings* before) {
  WebhookSettings settings;
  body.require("url");
  settings.url = body.parsed("url", checked_webhook_url).value_or("");
  if (before == nullptr) body.require("secrets");
  settings.secrets = texts(body, "secrets", checked_webhook_secret);
  if (settings.secrets.size() > 5) body.fail("secrets", "must be at most 5");
  if (settings.secrets.empty() && before != nullptr) settings.secrets = before->secrets;
  return settings;
}

MailSettings parse_mail(JsonObject& body, const MailSettings* before) {
  MailSettings settings;
  for (const char* name : {"host", "from", "to"}) body.require(name);
  settings.host = body.parsed("host", checked_host).value_or("");
  settings.security = body.parsed("security", parse_mail_security).value_or(settings.security);
  settings.port = port_of(body, settings.security == MailSecurity::tls        ? 465
                                : settings.security == MailSecurity::starttls ? 587
                                                                              : 25);
  settings.user = body.parsed("user", checked_credential).value_or("");
  settings.password = password_of(body, settings.user, before);
  if (!settings.user.empty() && settings.security == MailSecurity::none) {
    body.fail("user", "needs the security starttls or tls: a password never goes out in the clear");
  }
  settings.from = body.parsed("from", checked_mail_address).value_or("");
  settings.to = texts(body, "to", checked_mail_address);
  return settings;
}

MqttSettings parse_mqtt(JsonObject& body, const MqttSettings* before) {
  MqttSettings settings;
  body.require("host");
  settings.host = body.parsed("host", checked_host).value_or("");
  settings.tls = body.flag("tls").value_or(false);
  settings.port = port_of(body, settings.tls ? 8883 : 1883);
  settings.user = body.parsed("user", checked_credential).value_or("");
  settings.password = password_of(body, settings.user, before);
  settings.topic_prefix = body.parsed("topic_prefix", checked_topic_prefix).value_or("raywatch");
  if (!body.is_null("discovery_prefix")) {
    settings.discovery_prefix = body.parsed("discovery_prefix", checked_topic_prefix).value_or("homeassistant");
  }
  return settings;
}

template <class Settings, class Parse>
ChannelSettings parse_settings(JsonObject& body, ChannelKind kind, const ChannelRecord* before, const Parse& parse) {
  const std::string name(to_string(kind));
  body.require(name);
  auto given = body.object(name);
  if (!given) return Settings{};
  Settings settings = parse(*given, before == nullptr ? nullptr : std::get_if<Settings>(&before->settings));
  given->finish();
  return settings;
}

ChannelSettings parse_settings(JsonObject& body, ChannelKind kind, const ChannelRecord* before) {
  switch (kind) {
    case ChannelKind::mail:
      return parse_settings<MailSettings>(body, kind, before, parse_mail);
    case ChannelKind::mqtt:
      return parse_settings<MqttSettings>(body, kind, before, parse_mqtt);
    case ChannelKind::webhook:
      break;
  }
  return parse_settings<WebhookSettings>(body, ChannelKind::webhook, before, parse_webhook);
}

}  // namespace

GivenChannel parse_channel(const nlohmann::json& json, const ChannelRecord* before) {
  FieldErrors errors;
  JsonObject body(json, "", errors);
  GivenChannel given;
  ChannelRecord& record = given.record;
  for (const char* name : {"name", "kind", "by"}) body.require(name);
  record.name = body.parsed("name", checked_name).value_or("");
  record.by = body.parsed("by", checked_actor).value_or("");
  record.enabled = body.flag("enabled").value_or(true);
  given.site = body.text("site");
  record.min_severity = body.parsed("min_severity", parse_severity).value_or(record.min_severity);
  record.events = texts(body, "events", checked_event_pattern);
  if (record.events.empty()) record.events = {"alert.*"};
  record.per_minute = static_cast<std::uint32_t>(
      body.integer("per_minute", {.min = 1, .max = 6000}).value_or(static_cast<std::int64_t>(record.per_minute)));
  const auto kind = body.parsed("kind", parse_channel_kind);
  if (kind) record.settings = parse_settings(body, *kind, before);
  if (kind && before != nullptr && *kind != before->kind()) body.fail("kind", "cannot be changed: make a new channel");
  body.finish();
  errors.throw_if_any();
  return given;
}

}  // namespace raywatch
