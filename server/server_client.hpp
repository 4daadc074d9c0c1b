#pragma once

#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/error.hpp"

namespace raywatch {

/// What a daemon answered.
struct ServerReply {
  int status = 0;
  std::string body;
  std::optional<std::chrono::seconds> retry_after;

  bool ok() const { return status >= 200 && status < 300; }
  /// What is wrong, in words: from the problem document when the body is one.
  std::string problem() const;
};

/// Nobody answers at the address.
class Unreachable : public Error {
 public:
  using Error::Error;
};

/// Talks to a running daemon. Not thread-safe.
class ServerClient {
 public:
  /// @param url such as "http://127.0.0.1:8420". @throws InvalidInput when it is no such URL.
  explicit ServerClient(const std::string& url);
  ~ServerClient();

  using Query = std::vector<std::pair<std::string, std::string>>;

  /// @{ @throws Unreachable when there is no connection, another Error when it breaks off. Any status is a reply.
  ServerReply get(const std::string& path);
  ServerReply post_json(const std::string& path, const std::string& json);
  /// Streams the file; memory does not grow with its size.
  ServerReply post_file(const std::string& path, const Query& query, const std::filesystem::path& file);
  /// @}

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// A name as part of a path.
std::string path_segment(const std::string& name);

}  // namespace raywatch
