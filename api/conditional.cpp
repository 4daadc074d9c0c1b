#include "api/conditional.hpp"

#include "api/sha256.hpp"
#include "api/text_values.hpp"
#include "core/error.hpp"

namespace raywatch {

std::string entity_tag(std::string_view content) { return '"' + sha256_hex(content).substr(0, 32) + '"'; }

bool names_tag(std::string_view header, std::string_view tag) {
  for (std::string_view part : split(header, ',')) {
    part = without_blanks(part);
    if (part.starts_with("W/")) part.remove_prefix(2);
    if (part == "*" || part == tag) return true;
  }
  return false;
}

bool is_cached(const std::optional<std::string>& if_none_match, std::string_view tag) {
  return if_none_match && names_tag(*if_none_match, tag);
}

HttpAnswer not_modified(const std::string& tag) {
  HttpAnswer answer;
  answer.status = 304;
  answer.set_header("ETag", tag);
  return answer;
}

void check_if_match(const std::optional<std::string>& if_match, std::string_view tag) {
  if (if_match && !names_tag(*if_match, tag)) {
    throw PreconditionFailed("If-Match names another version than the stored one, which is " + std::string(tag) +
                             "; read it again and repeat the edit.");
  }
}

HttpAnswer with_body_tag(HttpAnswer answer, const std::optional<std::string>& if_none_match) {
  const std::string tag = entity_tag(answer.body);
  if (is_cached(if_none_match, tag)) return not_modified(tag);
  answer.set_header("ETag", tag);
  return answer;
}

}  // namespace raywatch
