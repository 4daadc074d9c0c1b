#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "api/answer.hpp"

namespace raywatch {

/// A strong entity tag of what a representation is made of.
std::string entity_tag(std::string_view content);

/// True if an `If-None-Match` or `If-Match` header names `tag` ("*" names any).
bool names_tag(std::string_view header, std::string_view tag);

/// True if the client has this version already: answer with `not_modified`.
bool is_cached(const std::optional<std::string>& if_none_match, std::string_view tag);
HttpAnswer not_modified(const std::string& tag);

/// @throws PreconditionFailed when an `If-Match` header is there and does not name `tag`.
void check_if_match(const std::optional<std::string>& if_match, std::string_view tag);

/// A tag computed from the answer's own body, and 304 when the client has it.
HttpAnswer with_body_tag(HttpAnswer answer, const std::optional<std::string>& if_none_match);

}  // namespace raywatch
