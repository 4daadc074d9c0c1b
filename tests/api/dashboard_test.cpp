#include "api/dashboard.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <fstream>

#include "core/error.hpp"
#include "tests/support/temp_dir.hpp"

namespace raywatch {
namespace {

namespace fs = std::filesystem;

void write(const fs::path& file, const std::string& text) {
  fs::create_directories(file.parent_path());
  std::ofstream(file) << text;
}

/// What a build makes: a page, and a script with its compressed forms.
class Built {
 public:
  Built() {
    write(root_ / "index.html", "<p>the page</p>");
    write(root_ / "assets/app-1a2b.js", "the script");
    write(root_ / "assets/app-1a2b.js.br", "as br");
    write(root_ / "assets/app-1a2b.js.gz", "as gzip");
    write(folder_.path() / "secret", "not for anybody");
  }
  const fs::path& root() const { return root_; }
  Dashboard read() const { return Dashboard::read(root_); }

 private:
  TempDir folder_;
  fs::path root_ = folder_.path() / "web";
};

std::string header(const HttpAnswer& answer, const std::string& name) {
  const auto found = std::ranges::find(answer.headers, name, &std::pair<std::string, std::string>::first);
  return found == answer.headers.end() ? "" : found->second;
}

TEST_CASE("the page is served at / and wherever else a page is asked for") {
  const Dashboard dashboard = Built().read();
  for (const char* path : {"/", "/index.html"}) CHECK_EQ(dashboard.answer({.path = path})->body, "<p>the page</p>");
  for (const char* path : {"/alerts/7", "/scans", "/../secret", "/sensors/a%2Fb"}) {
    CAPTURE(path);
    CHECK_FALSE(dashboard.answer({.path = path, .accept = "application/json"}));
    const auto page = dashboard.answer({.path = path, .accept = "text/html,application/xhtml+xml;q=0.9"});
    CHECK_EQ(page.value().body, "<p>the page</p>");
    CHECK_EQ(page->content_type, "text/html; charset=utf-8");
  }
  // A script that is gone is no page.
  CHECK_FALSE(dashboard.answer({.path = "/assets/app-old.js", .accept = "text/html"}));
}

TEST_CASE("nothing but what the directory held is served") {
  const Dashboard dashboard = Built().read();
  for (const char* path : {"/../secret", "/assets/../../secret", "/%2e%2e/secret", "//secret", "/assets/", "/assets",
                           "/assets/app-1a2b.js.br", "secret", "", "/etc/passwd", "/./index.html"}) {
    CAPTURE(path);
    CHECK_FALSE(dashboard.answer({.path = path, .accept = "*/*"}));
  }
}

TEST_CASE("a file goes out in the best encoding that the client takes") {
  const Dashboard dashboard = Built().read();
  const auto served = [&](const char* accept_encoding) {
    return *dashboard.answer({.path = "/assets/app-1a2b.js", .accept_encoding = accept_encoding});
  };
  CHECK_EQ(served("gzip, deflate, br").body, "as br");
  CHECK_EQ(header(served("gzip, deflate, br"), "Content-Encoding"), "br");
  CHECK_EQ(served("gzip;q=0.5, br;q=0").body, "as gzip");
  CHECK_EQ(served("BR;q=0.001").body, "as br");
  for (const char* plain : {"", "identity", "gzip;q=0, br; q=0.0", "bro"}) {
    CAPTURE(plain);
    CHECK_EQ(served(plain).body, "the script");
    CHECK_EQ(header(served(plain), "Content-Encoding"), "");
  }
  CHECK_EQ(header(served("br"), "Vary"), "Accept-Encoding");
}

TEST_CASE("what the client has already is not sent again, each encoding by itself") {
  const Dashboard dashboard = Built().read();
  const HttpAnswer page = *dashboard.answer({.path = "/"});
  CHECK_EQ(header(page, "Cache-Control"), "no-cache");
  CHECK_EQ(dashboard.answer({.path = "/", .if_none_match = header(page, "ETag")})->status, 304);
  CHECK_EQ(dashboard.answer({.path = "/", .if_none_match = "\"other\""})->status, 200);
  const HttpAnswer script = *dashboard.answer({.path = "/assets/app-1a2b.js"});
  CHECK_EQ(header(script, "Cache-Control"), "public, max-age=31536000, immutable");
  const HttpAnswer compressed = *dashboard.answer({.path = "/assets/app-1a2b.js", .accept_encoding = "br"});
  CHECK_NE(header(script, "ETag"), header(compressed, "ETag"));
}

TEST_CASE("nothing from elsewhere may run in the page") {
  const std::string policy = header(*Built().read().answer({.path = "/"}), "Content-Security-Policy");
  CHECK(policy.starts_with("default-src 'self';"));
  CHECK_EQ(policy.find("unsafe"), std::string::npos);
  CHECK_NE(policy.find("frame-ancestors 'none'"), std::string::npos);
}

TEST_CASE("a daemon that was built without a dashboard says so, and what would be right") {
  const Dashboard without;
  const auto answer = without.answer({.path = "/", .accept = "text/html"});
  CHECK_EQ(answer.value().status, 404);
  CHECK_NE(answer->body.find("scripts/build"), std::string::npos);
  CHECK_NE(answer->body.find("[dashboard] directory"), std::string::npos);
  CHECK_FALSE(without.answer({.path = "/", .accept = "*/*"}));
}

TEST_CASE("a directory without a built dashboard is refused") {
  const TempDir empty;
  CHECK_THROWS_AS(Dashboard::read(empty.path()), InvalidInput);
  CHECK_THROWS_AS(Dashboard::read(empty.path() / "nowhere"), InvalidInput);
}

}  // namespace
}  // namespace raywatch
