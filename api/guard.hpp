#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace raywatch {

/// True for "localhost", 127.0.0.0/8 and ::1 (also in brackets).
bool is_loopback_host(std::string_view host);

/// Which hosts and origins are the daemon's own.
struct OwnAddress {
  bool loopback_only = true;  ///< names of loopback only, beside the public one
  std::string public_url;     ///< under which people reach it, through a proxy perhaps; empty: not known
};

/// What a browser says about where a request comes from.
struct RequestSource {
  std::string_view method;
  std::string_view http_version;
  std::optional<std::string> host;    ///< the Host header
  std::optional<std::string> origin;  ///< the Origin header
};

/// Keeps web pages of other origins from writing, and, when only loopback is listened on, from reading through a name
/// of their own that they let point here (DNS rebinding).
/// @throws HttpError: 403, or 400 without a Host header.
void check_source(const RequestSource& source, const OwnAddress& own);

}  // namespace raywatch
