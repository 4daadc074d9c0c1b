#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "api/services.hpp"

namespace raywatch {

struct HttpConfig {
  std::string host = "127.0.0.1";
  std::uint16_t port = 8420;  ///< 0: any free one
  bool allow_remote = false;  ///< without it only loopback addresses are listened on
  std::size_t threads = 16;
  std::uint64_t max_body_bytes = std::uint64_t{1} << 30;
  std::filesystem::path spool_dir;                  ///< where bodies are received
  std::size_t max_wait_s = 60;                      ///< upper bound for `Prefer: wait=N`
  std::chrono::milliseconds idle_timeout{5'000};    ///< a connection without a request is kept this long
  std::chrono::milliseconds stall_timeout{10'000};  ///< a client that sends or takes nothing for this long is dropped
  std::uint64_t min_client_bytes_per_s = 4096;      ///< and so is one that is slower than this, after that time
  std::string public_url = {};                      ///< under which people reach the daemon; empty: as it listens
  std::filesystem::path dashboard_dir = {};         ///< the built dashboard; empty: there is none
};

/// What is wrong with `config.host`: it is no host, or not loopback without `allow_remote`; nothing when it is good.
std::optional<std::string> complaint_about_host(const HttpConfig& config);

/// The REST API over HTTP. Listens from construction on; serves from `start` until `stop` or destruction.
class HttpServer {
 public:
  /// @throws InvalidInput for a host that is not loopback without `allow_remote`, an address that cannot be bound, or a
  ///         `dashboard_dir` without a built dashboard.
  HttpServer(const HttpConfig& config, const Services& services);
  ~HttpServer();
  HttpServer(const HttpServer&) = delete;
  HttpServer& operator=(const HttpServer&) = delete;

  std::uint16_t port() const;  ///< the bound one
  void start();                ///< returns at once; serves on its own threads
  void stop();                 ///< finishes requests in progress (at most a few seconds), then returns

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace raywatch
