#pragma once

#include <string>

#include "storage/channels.hpp"

namespace raywatch {

/// How the settings of a channel stand in a column, with their secrets.
std::string settings_json(const ChannelSettings& settings);
/// @throws CorruptData when the text is not what was written.
ChannelSettings settings_from_json(ChannelKind kind, const std::string& text);

}  // namespace raywatch
