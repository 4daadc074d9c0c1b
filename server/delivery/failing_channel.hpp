#pragma once

#include <string>

#include "storage/channels.hpp"

namespace raywatch {

/// Raises the system alert "delivery-failing" of each site that the channel tells of, unless it stands.
void tell_failing(Transaction& transaction, const ChannelRecord& channel, const std::string& why, Time now);
/// Resolves it wherever it stands.
void settle_failing(Transaction& transaction, const ChannelRecord& channel, const std::string& why, Time now);

}  // namespace raywatch
