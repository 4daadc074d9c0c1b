#pragma once

#include <string>
#include <vector>

#include "storage/channels.hpp"

namespace raywatch {

/// Raises the system alert "delivery-failing" of each site that the channel tells of, unless it stands.
void tell_failing(Transaction& transaction, const ChannelRecord& channel, const std::string& why, Time now);
/// Whether it stands for each of them.
bool is_told_failing(const Snapshot& snapshot, const ChannelRecord& channel);
/// The channels that somebody disabled while it stood. One that its receiver sent away is not among them.
std::vector<ChannelRecord> disabled_while_failing(const Snapshot& snapshot);
/// Resolves it wherever it stands.
void settle_failing(Transaction& transaction, const ChannelRecord& channel, const std::string& why, Time now);

}  // namespace raywatch
