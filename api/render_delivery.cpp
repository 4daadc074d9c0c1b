#include "api/lookup.hpp"
#include "api/render.hpp"

namespace raywatch {
namespace {

/// Secrets stay here: only that there are some is said.
struct RenderSettings {
  Json operator()(const WebhookSettings& s) const { return {{"url", s.url}, {"secrets", s.secrets.size()}}; }
  Json operator()(const MailSettings& s) const {
    return {{"host", s.host},
            {"port", s.port},
            {"security", to_string(s.security)},
            {"user", s.user},
            {"has_password", !s.password.empty()},
            {"from", s.from},
            {"to", s.to}};
  }
  Json operator()(const MqttSettings& s) const {
    return {{"host", s.host},
            {"port", s.port},
            {"tls", s.tls},
            {"user", s.user},
            {"has_password", !s.password.empty()},
            {"topic_prefix", s.topic_prefix},
            {"discovery_prefix", s.discovery_prefix.empty() ? Json(nullptr) : Json(s.discovery_prefix)}};
  }
};

}  // namespace

Json render(const Snapshot& snapshot, const ChannelRecord& channel) {
  return {{"id", channel.id.value},
          {"name", channel.name},
          {"kind", to_string(channel.kind())},
          {"enabled", channel.enabled},
          {"site", channel.site ? Json(site_with(snapshot, *channel.site).name) : Json(nullptr)},
          {"min_severity", to_string(channel.min_severity)},
          {"events", channel.events},
          {"per_minute", channel.per_minute},
          {std::string(to_string(channel.kind())), std::visit(RenderSettings{}, channel.settings)},
          {"trouble", channel.trouble.empty() ? Json(nullptr) : Json(channel.trouble)},
          {"failing_since", render(channel.failing_since)},
          {"by", channel.by},
          {"created_at", format_rfc3339(channel.created_at)},
          {"edited_at", format_rfc3339(channel.edited_at)}};
}

Json render(const Snapshot& snapshot, const DeliveryRecord& delivery) {
  const std::optional<ChannelRecord> channel = find_channel(snapshot, delivery.channel);
  const bool waits = delivery.state == DeliveryState::pending;
  return {{"id", delivery.id.value},
          {"message_id", delivery.message_id},
          {"channel", delivery.channel.value},
          {"channel_name", channel ? Json(channel->name) : Json(nullptr)},
          {"kind", to_string(delivery.kind)},
          {"event", delivery.event.value},
          {"type", delivery.type},
          {"alert", id_or_null(delivery.alert)},
          {"state", to_string(delivery.state)},
          {"attempts", delivery.attempts},
          {"created_at", format_rfc3339(delivery.created_at)},
          {"next_attempt_at", waits ? Json(format_rfc3339(delivery.next_attempt_at)) : Json(nullptr)},
          {"last_attempt_at", render(delivery.last_attempt_at)},
          {"ended_at", render(delivery.ended_at)},
          {"took_ms", json_or_null(delivery.took_ms)},
          {"response_code", json_or_null(delivery.response_code)},
          {"error", delivery.error.empty() ? Json(nullptr) : Json(delivery.error)}};
}

}  // namespace raywatch
