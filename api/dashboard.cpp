#include "api/dashboard.hpp"

#include <algorithm>
#include <array>
#include <fstream>
#include <iterator>
#include <system_error>
#include <utility>

#include "api/conditional.hpp"
#include "api/text_values.hpp"
#include "core/error.hpp"

namespace raywatch {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kPage = "/index.html";
/// Files with the hash of their content in their name, as the build makes them.
constexpr std::string_view kHashedFiles = "/assets/";
/// A built dashboard has some hundred kilobytes; what is much larger is another directory.
constexpr std::uintmax_t kMaxBytes = std::uintmax_t{64} << 20;
/// The encodings that the build makes, the best first; "" is the file itself.
constexpr std::array<std::string_view, 3> kEncodings = {"br", "gzip", ""};

constexpr std::string_view kContentSecurityPolicy =
    "default-src 'self'; img-src 'self' blob: data:; base-uri 'none'; form-action 'none'; frame-ancestors 'none'; "
    "object-src 'none'";

constexpr std::string_view kBuiltWithout = R"(<!doctype html>
<html lang="en">
<meta charset="utf-8">
<title>raywatch: no dashboard</title>
<h1>raywatch runs, but its dashboard was not built</h1>
<p>Build it with <code>scripts/build</code>, which puts it beside the program, or name the directory of a built one in
the configuration (<code>[dashboard] directory</code>); then start the daemon again.</p>
<p>Everything else works: the API is described at <a href="/openapi.json">/openapi.json</a>.</p>
</html>
)";

std::string content_type_of(const fs::path& file) {
  static const std::map<std::string, std::string, std::less<>> kTypes = {
      {".css", "text/css; charset=utf-8"},
      {".html", "text/html; charset=utf-8"},
      {".ico", "image/x-icon"},
      {".js", "text/javascript; charset=utf-8"},
      {".json", "application/json"},
      {".png", "image/png"},
      {".svg", "image/svg+xml"},
      {".txt", "text/plain; charset=utf-8"},
      {".webmanifest", "application/manifest+json"},
      {".woff2", "font/woff2"},
  };
  const auto type = kTypes.find(file.extension().string());
  return type == kTypes.end() ? "application/octet-stream" : type->second;
}

/// Which encoding a file's name ends in, and the name without that ending.
std::pair<std::string, fs::path> without_encoding(fs::path file) {
  const std::string ending = file.extension().string();
  if (ending != ".br" && ending != ".gz") return {"", std::move(file)};
  return {ending == ".br" ? "br" : "gzip", file.replace_extension()};
}

std::string read_whole(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::string bytes{std::istreambuf_iterator<char>(in), {}};
  if (!in) throw InvalidInput("The dashboard's file " + file.string() + " cannot be read.");
  return bytes;
}

/// Whether an `Accept` or `Accept-Encoding` header names `wanted` and does not forbid it ("br;q=0").
bool accepts(const std::optional<std::string>& header, std::string_view wanted) {
  const std::string text = lower(header.value_or(""));
  return std::ranges::any_of(split(text, ','), [&](std::string_view item) {
    const auto parts = split(item, ';');
    if (without_blanks(parts.front()) != wanted) return false;
    return std::none_of(parts.begin() + 1, parts.end(), [](std::string_view parameter) {
      const std::string_view quality = without_blanks(parameter);
      return quality.starts_with("q=0") && quality.find_first_of("123456789") == std::string_view::npos;
    });
  });
}

HttpAnswer with_security_headers(HttpAnswer answer) {
  answer.set_header("Content-Security-Policy", std::string(kContentSecurityPolicy));
  answer.set_header("Referrer-Policy", "no-referrer");
  answer.set_header("Cross-Origin-Opener-Policy", "same-origin");
  return answer;
}

HttpAnswer built_without() {
  HttpAnswer answer;
  answer.status = 404;
  answer.content_type = "text/html; charset=utf-8";
  answer.body = kBuiltWithout;
  return with_security_headers(std::move(answer));
}

}  // namespace

Dashboard Dashboard::read(const fs::path& directory) {
  if (!fs::is_regular_file(directory / "index.html")) {
    throw InvalidInput(directory.string() +
                       " holds no built dashboard: there is no index.html; scripts/build makes one");
  }
  Dashboard dashboard;
  std::uintmax_t size = 0;
  try {
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(directory)) {
      if (!entry.is_regular_file()) continue;
      size += entry.file_size();
      if (size > kMaxBytes) throw InvalidInput(directory.string() + " is too large to be a built dashboard.");
      auto [encoding, name] = without_encoding(entry.path());
      File& file = dashboard.files_["/" + name.lexically_relative(directory).generic_string()];
      file.content_type = content_type_of(name);
      std::string bytes = read_whole(entry.path());
      std::string tag = entity_tag(bytes);
      file.by_encoding[std::move(encoding)] = {std::move(bytes), std::move(tag)};
    }
  } catch (const fs::filesystem_error& error) {
    throw InvalidInput("The dashboard cannot be read: " + std::string(error.what()));
  }
  return dashboard;
}

std::optional<HttpAnswer> Dashboard::answer(const FileRequest& request) const {
  const std::string_view address = request.path == "/" ? kPage : request.path;
  if (const auto file = files_.find(address); file != files_.end()) {
    return answer_with(file->first, file->second, request);
  }
  // A link into the dashboard: its own scripts know what it means.
  if (address.starts_with(kHashedFiles) || !accepts(request.accept, "text/html")) return std::nullopt;
  const auto page = files_.find(kPage);
  return page == files_.end() ? built_without() : answer_with(page->first, page->second, request);
}

HttpAnswer Dashboard::answer_with(const std::string& address, const File& file, const FileRequest& request) const {
  HttpAnswer answer;
  for (const std::string_view encoding : kEncodings) {
    const auto content = file.by_encoding.find(encoding);
    if (content == file.by_encoding.end()) continue;
    if (!encoding.empty() && !accepts(request.accept_encoding, encoding)) continue;
    const auto& [bytes, tag] = content->second;
    if (is_cached(request.if_none_match, tag)) {
      answer = not_modified(tag);
    } else {
      answer.content_type = file.content_type;
      answer.body = bytes;
      answer.set_header("ETag", tag);
      if (!encoding.empty()) answer.set_header("Content-Encoding", std::string(encoding));
    }
    break;
  }
  answer.set_header("Vary", "Accept-Encoding");
  const bool hashed = address.starts_with(kHashedFiles);
  answer.set_header("Cache-Control", hashed ? "public, max-age=31536000, immutable" : "no-cache");
  return with_security_headers(std::move(answer));
}

}  // namespace raywatch
