#include "storage/channels.hpp"

#include <algorithm>
#include <array>

#include "core/names.hpp"
#include "storage/channel_columns.hpp"
#include "storage/columns.hpp"
#include "storage/cursor.hpp"
#include "storage/deliveries.hpp"
#include "storage/sites.hpp"
#include "storage/snapshot.hpp"

namespace raywatch {
namespace {

constexpr Names<ChannelKind, 3> kKinds{
    {{ChannelKind::webhook, "webhook"}, {ChannelKind::mail, "mail"}, {ChannelKind::mqtt, "mqtt"}}};
constexpr Names<MailSecurity, 3> kSecurities{
    {{MailSecurity::none, "none"}, {MailSecurity::starttls, "starttls"}, {MailSecurity::tls, "tls"}}};

constexpr std::string_view kChannelList = "channels";
constexpr std::int64_t kMostChannels = 50;
const std::string kSelectChannels =
    "SELECT id, name, kind, settings, enabled, site, min_severity, events, per_minute, revision, trouble, "
    "failing_since, actor, created_at, edited_at FROM channels ";

ChannelRecord read_channel(Statement& row) {
  ChannelRecord channel;
  channel.id = row.take<ChannelId>();
  channel.name = row.take<std::string>();
  const ChannelKind kind = parse_channel_kind(row.take<std::string>());
  channel.settings = settings_from_json(kind, row.take<std::string>());
  channel.enabled = row.take<bool>();
  channel.site = row.take<std::optional<SiteId>>();
  channel.min_severity = parse_severity(row.take<std::string>());
  channel.events = texts_from_json(row.take<std::string>());
  channel.per_minute = row.take<std::uint32_t>();
  channel.revision = row.take<std::int64_t>();
  channel.trouble = row.take<std::string>();
  channel.failing_since = row.take<std::optional<Time>>();
  channel.by = row.take<std::string>();
  channel.created_at = row.take<Time>();
  channel.edited_at = row.take<Time>();
  return channel;
}

void require_consistent(const Snapshot& snapshot, const ChannelRecord& channel) {
  const auto other = database_of(snapshot).find<ChannelId>("SELECT id FROM channels WHERE name = ?", channel.name);
  if (other && *other != channel.id) throw Conflict("there is a channel named \"" + channel.name + "\" already");
  if (channel.site && !find_site(snapshot, *channel.site)) throw NotFound("there is no such site");
}

}  // namespace

std::string_view to_string(ChannelKind kind) { return name_of(kKinds, kind); }
ChannelKind parse_channel_kind(std::string_view name) { return value_of(kKinds, name, "kind"); }
std::string_view to_string(MailSecurity security) { return name_of(kSecurities, security); }
MailSecurity parse_mail_security(std::string_view name) { return value_of(kSecurities, name, "security"); }

ChannelRecord insert_channel(Transaction& transaction, const ChannelRecord& channel, Time now) {
  transaction.impl().require_room_for_records();
  require_consistent(transaction, channel);
  Database& database = database_of(transaction);
  if (database.find<std::int64_t>("SELECT count(*) FROM channels WHERE id > 0") >= kMostChannels) {
    throw Conflict("there are " + std::to_string(kMostChannels) + " channels already, each of which has a thread");
  }
  database.run(
      "INSERT INTO channels (name, kind, settings, enabled, site, min_severity, events, per_minute, revision, trouble, "
      "actor, created_at, edited_at) VALUES (?, ?, ?, ?, ?, ?, ?, ?, 1, '', ?, ?, ?)",
      channel.name, to_string(channel.kind()), settings_json(channel.settings), channel.enabled, channel.site,
      to_string(channel.min_severity), texts_json(channel.events), channel.per_minute, channel.by, now, now);
  return find_channel(transaction, ChannelId{database.last_id()}).value();
}

std::optional<ChannelRecord> find_channel(const Snapshot& snapshot, ChannelId id) {
  Statement row(database_of(snapshot), kSelectChannels + "WHERE id = ?");
  if (!row.bind(id).next()) return std::nullopt;
  return read_channel(row);
}

Page<ChannelRecord> list_channels(const Snapshot& snapshot, std::optional<SiteId> site, const PageRequest& page) {
  const auto [after] = key_before<1>(page, kChannelList, {0});
  // Channels are made by people: there are few.
  Statement rows(database_of(snapshot),
                 kSelectChannels + "WHERE id > ?1 AND (?2 IS NULL OR site IS NULL OR site = ?2) ORDER BY id LIMIT ?3");
  rows.bind(after, site, rows_to_read(page));
  std::vector<ChannelRecord> channels;
  while (rows.next()) channels.push_back(read_channel(rows));
  return make_page(std::move(channels), page, kChannelList,
                   [](const ChannelRecord& c) { return std::array{c.id.value}; });
}

std::vector<ChannelRecord> enabled_channels(const Snapshot& snapshot) {
  Statement rows(database_of(snapshot), kSelectChannels + "WHERE id > 0 AND enabled = 1 ORDER BY id");
  std::vector<ChannelRecord> channels;
  while (rows.next()) channels.push_back(read_channel(rows));
  return channels;
}

ChannelRecord replace_channel(Transaction& transaction, const ChannelRecord& channel, Time now) {
  require_consistent(transaction, channel);
  database_of(transaction)
      .run(
          "UPDATE channels SET name = ?, settings = ?, enabled = ?, site = ?, min_severity = ?, events = ?, "
          "per_minute = ?, revision = revision + 1, actor = ?, edited_at = ?, "
          "failing_since = CASE WHEN ? THEN failing_since END WHERE id = ?",
          channel.name, settings_json(channel.settings), channel.enabled, channel.site, to_string(channel.min_severity),
          texts_json(channel.events), channel.per_minute, channel.by, now, channel.enabled, channel.id);
  hasten_deliveries(transaction, channel.id, now);
  return find_channel(transaction, channel.id).value();
}

void delete_channel(Transaction& transaction, ChannelId id, Time now) {
  drop_deliveries(transaction, id, "the channel was deleted", now);
  database_of(transaction).run("DELETE FROM channels WHERE id = ?", id);
}

void note_health(Transaction& transaction, ChannelId id, const ChannelHealth& health) {
  database_of(transaction)
      .run(
          "UPDATE channels SET trouble = ?, failing_since = ?, enabled = enabled AND NOT ?, revision = revision + ? "
          "WHERE id = ?",
          health.trouble, health.failing_since, health.disable, health.disable, id);
}

bool covers(const std::vector<std::string>& patterns, std::string_view type) {
  return std::ranges::any_of(patterns, [&](std::string_view pattern) {
    if (!pattern.ends_with('*')) return pattern == type;
    return type.starts_with(pattern.substr(0, pattern.size() - 1));
  });
}

}  // namespace raywatch
