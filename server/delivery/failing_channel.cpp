#include "server/delivery/failing_channel.hpp"

#include <algorithm>

#include "server/system_alerts.hpp"
#include "storage/alerts.hpp"
#include "storage/all_of_list.hpp"
#include "storage/sites.hpp"

namespace raywatch {
namespace {

/// Named by its id: the name may be edited while the alert stands.
SystemSubject subject_of(const ChannelRecord& channel, SiteId site) {
  return {.site = site,
          .cause = "delivery-failing",
          .subject = "channel " + std::to_string(channel.id.value),
          .zone = {},
          .sensor = {}};
}

std::vector<Site> all_sites(const Snapshot& snapshot) {
  return all_of_list([&](const PageRequest& page) { return list_sites(snapshot, page); });
}

std::vector<Site> sites_of(const Snapshot& snapshot, const ChannelRecord& channel) {
  std::vector<Site> sites = all_sites(snapshot);
  if (channel.site) std::erase_if(sites, [&](const Site& site) { return site.id != *channel.site; });
  return sites;
}

bool is_told_of(const Snapshot& snapshot, const ChannelRecord& channel, SiteId site) {
  const SystemSubject subject = subject_of(channel, site);
  return standing_alert(snapshot, subject.site, subject.cause, subject.subject).has_value();
}

}  // namespace

void tell_failing(Transaction& transaction, const ChannelRecord& channel, const std::string& why, Time now) {
  for (const Site& site : sites_of(transaction, channel)) {
    raise_system_alert(transaction, subject_of(channel, site.id),
                       {.severity = Severity::warning,
                        .at = now,
                        .title = "Channel " + channel.name + " (" + std::string(to_string(channel.kind())) +
                                 ") does not deliver: " + why + "."});
  }
}

bool is_told_failing(const Snapshot& snapshot, const ChannelRecord& channel) {
  return std::ranges::all_of(sites_of(snapshot, channel),
                             [&](const Site& site) { return is_told_of(snapshot, channel, site.id); });
}

std::vector<ChannelRecord> disabled_while_failing(const Snapshot& snapshot) {
  std::vector<ChannelRecord> channels =
      all_of_list([&](const PageRequest& page) { return list_channels(snapshot, std::nullopt, page); });
  std::erase_if(channels, [](const ChannelRecord& channel) { return channel.enabled || channel.failing_since; });
  if (channels.empty()) return {};  // as nearly always: this is asked after each commit
  const std::vector<Site> sites = all_sites(snapshot);
  std::erase_if(channels, [&](const ChannelRecord& channel) {
    return std::ranges::none_of(sites, [&](const Site& site) { return is_told_of(snapshot, channel, site.id); });
  });
  return channels;
}

/// The channel may have told of other sites when it was raised.
void settle_failing(Transaction& transaction, const ChannelRecord& channel, const std::string& why, Time now) {
  for (const Site& site : all_sites(transaction)) {
    settle_system_alert(transaction, subject_of(channel, site.id), why, std::nullopt, now);
  }
}

}  // namespace raywatch
