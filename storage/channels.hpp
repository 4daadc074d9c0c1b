#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "core/ids.hpp"
#include "core/rule.hpp"
#include "core/time.hpp"
#include "storage/page.hpp"
#include "storage/store.hpp"

namespace raywatch {

using ChannelId = Id<struct ChannelTag>;

/// In the order of `ChannelSettings`.
enum class ChannelKind : std::uint8_t { webhook, mail, mqtt };
std::string_view to_string(ChannelKind kind);
/// @throws InvalidInput naming the known ones.
ChannelKind parse_channel_kind(std::string_view name);

struct WebhookSettings {
  std::string url;
  std::vector<std::string> secrets;  ///< "whsec_" and base64; each signs, so that they can be changed one by one
};

enum class MailSecurity : std::uint8_t { none, starttls, tls };
std::string_view to_string(MailSecurity security);
/// @throws InvalidInput naming the known ones.
MailSecurity parse_mail_security(std::string_view name);

struct MailSettings {
  std::string host;
  std::uint16_t port = 0;
  MailSecurity security = MailSecurity::starttls;
  std::string user, password;  ///< empty: the server asks for none
  std::string from;
  std::vector<std::string> to;
};

struct MqttSettings {
  std::string host;
  std::uint16_t port = 0;
  bool tls = false;
  std::string user, password;    ///< empty: the broker asks for none
  std::string topic_prefix;      ///< of everything that is published
  std::string discovery_prefix;  ///< of Home Assistant; empty: none
};

using ChannelSettings = std::variant<WebhookSettings, MailSettings, MqttSettings>;

/// Someone who is told: how, and of what.
struct ChannelRecord {
  ChannelId id;
  std::string name;
  ChannelSettings settings;  ///< with its secrets
  bool enabled = true;
  std::optional<SiteId> site;  ///< only what happens there; not given: anywhere
  Severity min_severity = Severity::info;
  std::vector<std::string> events;  ///< types; "alert.*" stands for all that begin so, "*" for all
  std::uint32_t per_minute = 30;    ///< messages, at most; more wait
  std::int64_t revision = 1;        ///< rises with each edit
  std::string trouble;              ///< why the last message did not go out; empty when it did
  std::optional<Time> failing_since;
  std::string by;  ///< who edited it last
  Time created_at, edited_at;

  ChannelKind kind() const { return static_cast<ChannelKind>(settings.index()); }
};

/// Its id, revision, trouble and times are decided here.
/// @throws Conflict when there is a channel of that name; NotFound for the site.
ChannelRecord insert_channel(Transaction& transaction, const ChannelRecord& channel, Time now);
std::optional<ChannelRecord> find_channel(const Snapshot& snapshot, ChannelId id);
/// Oldest first; with a site, those that tell of it.
Page<ChannelRecord> list_channels(const Snapshot& snapshot, std::optional<SiteId> site, const PageRequest& page);
std::vector<ChannelRecord> enabled_channels(const Snapshot& snapshot);
/// Replaces what an operator decides; its kind must stay. What waits goes out by the new settings.
ChannelRecord replace_channel(Transaction& transaction, const ChannelRecord& channel, Time now);
/// What still waits is dropped; the log of its deliveries stays.
void delete_channel(Transaction& transaction, ChannelId id, Time now);

/// How the last message went. `disable` ends the channel, until an operator enables it again.
struct ChannelHealth {
  std::string trouble;
  std::optional<Time> failing_since;
  bool disable = false;
};
void note_health(Transaction& transaction, ChannelId id, const ChannelHealth& health);

/// Whether one of a channel's patterns covers a type of events.
bool covers(const std::vector<std::string>& patterns, std::string_view type);

}  // namespace raywatch
