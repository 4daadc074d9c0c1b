#include "api/guard.hpp"

#include <doctest/doctest.h>

#include "api/problem.hpp"

namespace raywatch {
namespace {

TEST_CASE("loopback has few names") {
  for (const char* host : {"localhost", "LocalHost", "127.0.0.1", "127.255.0.3", "::1", "[::1]"})
    CHECK(is_loopback_host(host));
  for (const char* host : {"", "0.0.0.0", "::", "128.0.0.1", "127.0.0", "127.0.0.1.", "127.0.0.256", "127.0.0.x",
                           "localhost.", "evil.localhost"}) {
    CAPTURE(host);
    CHECK_FALSE(is_loopback_host(host));
  }
}

TEST_CASE("writes come from the server's own pages or from no page at all") {
  const auto check = [](const char* method, const char* origin) {
    check_source({.method = method, .http_version = "HTTP/1.1", .host = "raywatch.example:8420", .origin = origin},
                 false);
  };
  CHECK_NOTHROW(check("POST", "http://raywatch.example:8420"));
  CHECK_NOTHROW(check("POST", "https://RAYWATCH.example:8420"));
  CHECK_NOTHROW(check("GET", "http://evil.example"));
  for (const char* origin :
       {"http://evil.example", "null", "http://raywatch.example", "raywatch.example:8420", "file://"}) {
    CAPTURE(origin);
    CHECK_THROWS_AS(check("POST", origin), HttpError);
  }
}

}  // namespace
}  // namespace raywatch
