#pragma once

// Internal: only .cpp files of api/ include this.
#include <nlohmann/json.hpp>

#include "api/call.hpp"

namespace raywatch {

/// The request's content as JSON, at most 1 MiB.
/// @throws HttpError (415) when it is said to be something else; TooLarge; InvalidInput when it is no JSON.
nlohmann::json json_body(Call& call);

}  // namespace raywatch
