#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/time.hpp"

namespace raywatch {

/// The header `webhook-signature`: for each secret "v1," and the base64 of HMAC-SHA256 over "id.timestamp.body", with
/// the timestamp in seconds; separated by blanks (https://www.standardwebhooks.com).
/// @param secrets "whsec_" and base64. @throws InvalidInput when one is not.
std::string webhook_signature(const std::vector<std::string>& secrets, std::string_view id, Time sent_at,
                              std::string_view body);
std::int64_t unix_seconds(Time time);

}  // namespace raywatch
