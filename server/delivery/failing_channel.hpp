#pragma once

#include <string>

#include "storage/channels.hpp"

namespace raywatch {

/// Raises the system alert "delivery-failing" of each site that the channel tells of, unless it stands.
void tell_failing(Transaction& transaction, const ChannelRecord& channel, const std::string& why, Time now);
/// Whether it stands for each of them.
bool is_told_failing(const Snapshot& snapshot, const ChannelRecord& channel);
/// Resolves it wherever it stands.
void settle_failing(Transaction& transaction, const ChannelRecord& channel, const std::string& why, Time now);

}  // namespace raywatch
