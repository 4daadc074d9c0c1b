#pragma once

#include <string>

#include "api/json_object.hpp"

namespace raywatch {

/// Who acts, and what they say of it.
struct Signature {
  std::string by;
  std::string note;  ///< may be empty
};

/// Reads the members `by`, which is required, and `note` of a body; what is wrong with them goes to its errors.
Signature parse_signature(JsonObject& body);

}  // namespace raywatch
