#include "api/signature.hpp"

#include "api/name_rules.hpp"

namespace raywatch {

Signature parse_signature(JsonObject& body) {
  body.require("by");
  return {.by = body.parsed("by", checked_actor).value_or(""), .note = body.parsed("note", checked_note).value_or("")};
}

}  // namespace raywatch
