#pragma once

// Heavy: only .cpp files include this.
#include <concepts>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "api/answer.hpp"

namespace raywatch {

/// JSON that goes out keeps the order in which its members were written.
using Json = nlohmann::ordered_json;

/// The text of `json`. Bytes that are no UTF-8 are replaced, never thrown about.
std::string to_json_text(const Json& json);

/// JSON that is text already. Long lists are written item by item: a tree of all of them takes twice the time.
struct JsonText {
  std::string text;
};

/// An answer of type application/json.
HttpAnswer json_answer(const Json& json, int status = 200);
HttpAnswer json_text_answer(JsonText json);
/// The same of text; a template, so that braces are always a `Json`.
template <std::same_as<JsonText> Text>
HttpAnswer json_answer(Text json) {
  return json_text_answer(std::move(json));
}

/// Parses JSON strictly: one value, UTF-8, no repeated members, at most 32 levels deep.
/// @throws InvalidInput naming the place (byte, from 1).
nlohmann::json parse_json(std::string_view text);

/// `value` or null.
template <class T>
Json json_or_null(const std::optional<T>& value) {
  return value ? Json(*value) : Json(nullptr);
}

}  // namespace raywatch
