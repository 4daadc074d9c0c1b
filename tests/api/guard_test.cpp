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
                 {.loopback_only = false, .public_url = ""});
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

TEST_CASE("the public address is an own host and an own origin, as a whole") {
  const auto check = [](const char* host, const char* origin, const char* public_url) {
    check_source({.method = "POST", .http_version = "HTTP/1.1", .host = host, .origin = origin},
                 {.loopback_only = true, .public_url = public_url});
  };
  CHECK_NOTHROW(check("watch.example", "https://watch.example", "https://watch.example"));
  CHECK_NOTHROW(check("watch.example:443", "https://watch.example", "https://watch.example/raywatch"));
  CHECK_NOTHROW(check("localhost:8420", "https://watch.example:8443", "https://Watch.example:8443/"));
  CHECK_NOTHROW(check("localhost:8420", "http://localhost:8420", "https://watch.example"));
  CHECK_THROWS_AS(check("watch.example", "https://watch.example", ""), HttpError);
  CHECK_THROWS_AS(check("watch.example", "https://watch.example", "watch.example"), HttpError);
  CHECK_THROWS_AS(check("watch.example.evil", "https://watch.example", "https://watch.example"), HttpError);
  CHECK_THROWS_AS(check("localhost:8420", "http://watch.example", "https://watch.example"), HttpError);
  CHECK_THROWS_AS(check("localhost:8420", "", ""), HttpError);
  CHECK_THROWS_AS(check("", "http://", ""), HttpError);
}

}  // namespace
}  // namespace raywatch
