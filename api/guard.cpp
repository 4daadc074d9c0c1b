#include "api/guard.hpp"

#include "api/problem.hpp"
#include "api/text_values.hpp"

namespace raywatch {
namespace {

/// "host:port" or "[address]:port" without the port.
std::string_view without_port(std::string_view host) {
  if (host.starts_with('[')) return host.substr(0, host.find(']') + 1);
  return host.substr(0, host.find(':'));
}

/// The first part of an address, "https://host:port"; empty when there is none.
std::string_view origin_of(std::string_view url) {
  const std::size_t scheme_end = url.find("://");
  if (scheme_end == std::string_view::npos) return {};
  return url.substr(0, url.find('/', scheme_end + 3));
}

/// Whether a host is that of an origin, on any port.
bool is_host_of(std::string_view host, std::string_view origin) {
  return !origin.empty() && host == without_port(origin.substr(origin.find("://") + 3));
}

bool is_write(std::string_view method) { return method != "GET" && method != "HEAD" && method != "OPTIONS"; }

bool is_ipv4_loopback(std::string_view host) {
  const auto parts = split(host, '.');
  if (parts.size() != 4 || parts[0] != "127") return false;
  for (const std::string_view part : parts) {
    const auto number = parse_integer(part);
    if (!number || *number < 0 || *number > 255) return false;
  }
  return true;
}

}  // namespace

bool is_loopback_host(std::string_view host) {
  return lower(host) == "localhost" || host == "::1" || host == "[::1]" || is_ipv4_loopback(host);
}

void check_source(const RequestSource& source, const OwnAddress& own) {
  if (!source.host && source.http_version != "HTTP/1.0") throw HttpError(bad_request("The Host header is missing."));
  const std::string host = lower(without_blanks(source.host.value_or("localhost")));
  const std::string public_url = lower(own.public_url);
  const std::string_view public_origin = origin_of(public_url), name = without_port(host);
  if (own.loopback_only && !is_loopback_host(name) && !is_host_of(name, public_origin)) {
    throw HttpError(
        foreign_host("This daemon listens on loopback only and is called localhost, 127.0.0.1 or [::1]; behind a "
                     "proxy, also by the name in delivery.public_url of its configuration."));
  }
  if (!source.origin || !is_write(source.method)) return;
  const std::string origin = lower(without_blanks(*source.origin));
  const bool is_public = !public_origin.empty() && origin == public_origin;
  if (origin != "http://" + host && origin != "https://" + host && !is_public) {
    throw HttpError(foreign_origin(
        "The Origin header does not name this daemon's own address; behind a proxy, that is delivery.public_url of its "
        "configuration."));
  }
}

}  // namespace raywatch
