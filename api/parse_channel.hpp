#pragma once

// Heavy: only .cpp files include this.
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "storage/channels.hpp"

namespace raywatch {

/// A channel as given in a request.
struct GivenChannel {
  ChannelRecord record;  ///< without its site
  std::optional<std::string> site;
};

/// @param before the channel that it replaces, whose secrets stay when none are given; null: it is new
/// @throws InvalidInput naming all that is wrong.
GivenChannel parse_channel(const nlohmann::json& json, const ChannelRecord* before);

}  // namespace raywatch
