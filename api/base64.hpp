#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace raywatch {

/// RFC 4648, with padding.
std::string base64(std::span<const std::uint8_t> bytes);
/// Nothing when the text is no base64 with padding.
std::optional<std::vector<std::uint8_t>> from_base64(std::string_view text);

}  // namespace raywatch
