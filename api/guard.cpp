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

void check_source(const RequestSource& source, bool loopback_only) {
  if (!source.host && source.http_version != "HTTP/1.0") throw HttpError(bad_request("The Host header is missing."));
  const std::string host = lower(without_blanks(source.host.value_or("localhost")));
  if (loopback_only && !is_loopback_host(without_port(host))) {
    throw HttpError(foreign_host("This daemon listens on loopback only and is called localhost, 127.0.0.1 or [::1]."));
  }
  if (!source.origin || !is_write(source.method)) return;
  const std::string origin = lower(without_blanks(*source.origin));
  if (origin != "http://" + host && origin != "https://" + host) {
    throw HttpError(foreign_origin("The Origin header does not name this daemon's own address."));
  }
}

}  // namespace raywatch
