#pragma once

#include <string_view>

namespace raywatch {

/// The text of `api/openapi.json`, which the build puts into the program.
std::string_view openapi_text();

}  // namespace raywatch
