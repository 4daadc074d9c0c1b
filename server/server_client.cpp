#include "server/server_client.hpp"

#include <httplib.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <fstream>
#include <nlohmann/json.hpp>
#include <regex>

namespace raywatch {
namespace {

std::optional<std::chrono::seconds> retry_after_of(const httplib::Response& response) {
  const std::string text = response.get_header_value("Retry-After");
  int seconds = 0;
  const auto read = std::from_chars(text.data(), text.data() + text.size(), seconds);
  if (read.ec != std::errc{} || read.ptr != text.data() + text.size() || seconds < 0) return std::nullopt;
  return std::chrono::seconds(seconds);
}

/// Hands out the file piece by piece as the connection takes it.
httplib::ContentProvider provider_of(std::ifstream& in) {
  return [&in](std::size_t offset, std::size_t length, httplib::DataSink& sink) {
    std::array<char, 1 << 16> piece;
    in.seekg(static_cast<std::streamoff>(offset));
    in.read(piece.data(), static_cast<std::streamsize>(std::min(length, piece.size())));
    const auto count = static_cast<std::size_t>(in.gcount());
    return count > 0 && sink.write(piece.data(), count);
  };
}

}  // namespace

std::string ServerReply::problem() const {
  const std::string status_text = "the server answered " + std::to_string(status);
  const nlohmann::json json = nlohmann::json::parse(body, nullptr, false);
  if (!json.is_object()) return status_text;
  std::string text = json.value("detail", json.value("title", status_text));
  if (!json.contains("errors") || !json["errors"].is_array()) return text;
  for (const nlohmann::json& error : json["errors"]) {
    if (!error.is_object()) continue;
    const std::string message = error.value("message", error.value("detail", ""));
    if (text.find(message) == std::string::npos) text += "; " + error.value("field", "") + ": " + message;
  }
  return text;
}

struct ServerClient::Impl {
  explicit Impl(const std::string& server_url) : url(server_url), client(server_url) {
    client.set_connection_timeout(std::chrono::seconds(5));
    client.set_read_timeout(std::chrono::minutes(10));
    client.set_write_timeout(std::chrono::minutes(1));
  }

  ServerReply reply_of(const httplib::Result& result) const {
    if (!result) fail(result.error());
    return {result->status, result->body, retry_after_of(*result)};
  }

  [[noreturn]] void fail(httplib::Error error) const {
    const std::string question = "; is the daemon running there? --server names another address";
    if (error == httplib::Error::Connection || error == httplib::Error::ConnectionTimeout) {
      throw Unreachable(url + ": cannot connect" + question);
    }
    throw Error(url + ": the connection broke off before the answer (" + httplib::to_string(error) + ")" + question);
  }

  std::string url;
  httplib::Client client;
};

ServerClient::ServerClient(const std::string& url) {
  static const std::regex kUrl(R"(https?://(\[[0-9a-fA-F:]+\]|[^/:\[\]]+)(:[0-9]{1,5})?/?)");
  if (!std::regex_match(url, kUrl)) {
    throw InvalidInput("\"" + url + "\" is no server; give something like http://127.0.0.1:8420");
  }
  impl_ = std::make_unique<Impl>(url.ends_with('/') ? url.substr(0, url.size() - 1) : url);
}

ServerClient::~ServerClient() = default;

ServerReply ServerClient::get(const std::string& path) { return impl_->reply_of(impl_->client.Get(path)); }

ServerReply ServerClient::post_json(const std::string& path, const std::string& json) {
  return impl_->reply_of(impl_->client.Post(path, json, "application/json"));
}

ServerReply ServerClient::post_file(const std::string& path, const Query& query, const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) throw Error(file.string() + ": cannot be read");
  const std::string target = httplib::append_query_params(path, httplib::Params(query.begin(), query.end()));
  return impl_->reply_of(impl_->client.Post(target, static_cast<std::size_t>(std::filesystem::file_size(file)),
                                            provider_of(in), "application/octet-stream"));
}

std::string path_segment(const std::string& name) {
  constexpr char kHex[] = "0123456789ABCDEF";
  std::string segment;
  for (const char c : name) {
    const auto byte = static_cast<unsigned char>(c);
    if (std::isalnum(byte) != 0 || c == '-' || c == '_' || c == '.' || c == '~') {
      segment += c;
    } else {
      segment += {'%', kHex[byte >> 4], kHex[byte & 15]};
    }
  }
  return segment;
}

}  // namespace raywatch
