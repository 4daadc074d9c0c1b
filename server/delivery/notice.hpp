#pragma once

#include <string>

#include "storage/deliveries.hpp"

namespace raywatch {

/// What a delivery tells, as JSON {"type", "timestamp", "data"}. Of an alert, `data` is the alert as the API shows it,
/// as it was after this step, with the step, the link, the zone's name, and where and how large its change is; of any
/// other event, the event as the API shows it, with the link.
/// @throws NotFound when what it tells of was deleted.
std::string compose_notice(const Snapshot& snapshot, const DeliveryRecord& delivery, const std::string& public_url);

/// What a test of a channel sends.
std::string compose_test(const ChannelRecord& channel, Time now);

}  // namespace raywatch
