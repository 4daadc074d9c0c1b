#include "api/channel_rules.hpp"

#include <algorithm>
#include <string_view>

#include "api/base64.hpp"
#include "api/name_rules.hpp"
#include "core/error.hpp"

namespace raywatch {
namespace {

bool is_graphic(char c) { return c > 0x20 && c < 0x7F; }
bool is_alphanumeric(char c) { return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }
bool has(std::string_view set, char c) { return set.find(c) != std::string_view::npos; }

void require(bool holds, const char* otherwise) {
  if (!holds) throw InvalidInput(otherwise);
}

}  // namespace

std::string checked_webhook_url(const std::string& url) {
  const std::size_t scheme = url.starts_with("https://") ? 8 : url.starts_with("http://") ? 7 : 0;
  require(scheme > 0, "must begin with https:// or http://");
  require(url.size() <= 2000 && std::ranges::all_of(url, is_graphic),
          "must be at most 2000 ASCII characters, no blanks");
  const std::string authority = url.substr(scheme, url.find_first_of("/?#", scheme) - scheme);
  require(!authority.empty() && authority.front() != ':', "must name a host");
  require(!has(authority, '@'), "must not have a user or password in it");
  return url;
}

std::string checked_webhook_secret(const std::string& secret) {
  constexpr std::string_view kPrefix = "whsec_";
  const auto key =
      secret.starts_with(kPrefix) ? from_base64(std::string_view(secret).substr(kPrefix.size())) : std::nullopt;
  require(key && key->size() >= 24 && key->size() <= 64, "must be whsec_ and the base64 of 24 to 64 bytes");
  return secret;
}

std::string checked_host(const std::string& host) {
  const auto fits = [](char c) { return is_alphanumeric(c) || has(".-_:", c); };
  require(!host.empty() && host.size() <= 253 && host.front() != '-' && std::ranges::all_of(host, fits),
          "must be a host's name or address, without a port");
  return host;
}

std::string checked_mail_address(const std::string& address) {
  const auto fits = [](char c) { return is_graphic(c) && !has("<>()[],;:\\\"", c); };
  const std::size_t at = address.find('@');
  require(address.size() <= 254 && std::ranges::all_of(address, fits) && at != std::string::npos && at > 0 &&
              at + 1 < address.size() && address.rfind('@') == at && address.front() != '-',
          "must be a plain address, such as guard@example.com");
  return address;
}

std::string checked_topic_prefix(const std::string& prefix) {
  const auto is_wrong = [](char c) { return has("#+", c) || is_control(c); };
  require(!prefix.empty() && prefix.size() <= 100 && prefix.front() != '/' && prefix.back() != '/' &&
              prefix.front() != '$' && std::ranges::none_of(prefix, is_wrong),
          "must be 1 to 100 bytes without '#' and '+', and with no slash at its ends");
  return prefix;
}

std::string checked_credential(const std::string& text) {
  require(text.size() <= 256 && std::ranges::none_of(text, is_control),
          "must have at most 256 bytes, and no control characters");
  return text;
}

std::string checked_event_pattern(const std::string& pattern) {
  const auto fits = [](char c) { return (c >= 'a' && c <= 'z') || has("._-", c); };
  const std::string_view name = std::string_view(pattern).substr(0, pattern.size() - (pattern.ends_with('*') ? 1 : 0));
  require(!pattern.empty() && pattern.size() <= 64 && std::ranges::all_of(name, fits),
          "must be a type of events such as alert.opened, or the beginning of some such as alert.*");
  return pattern;
}

}  // namespace raywatch
