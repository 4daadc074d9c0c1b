#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>

#include "api/http_server.hpp"
#include "core/choose_priors.hpp"
#include "core/time.hpp"

namespace raywatch {

struct DaemonConfig {
  std::filesystem::path data_dir = "raywatch-data";
  HttpConfig http;
  unsigned workers = 0;                          ///< sites compared at once; 0: one a core
  unsigned compare_threads = 0;                  ///< threads of one comparison; 0: one a core
  std::uint64_t index_cache_bytes = std::uint64_t{1} << 30;
  std::uint64_t queue_limit = 1000;              ///< unfinished jobs above which uploads get 503
  std::uint64_t min_free_disk_bytes = 256u << 20;
  std::chrono::seconds future_tolerance{60};     ///< a capture time later than now by more than this is refused
  std::chrono::hours previous_limit{24 * 365};   ///< scans older than this are no `previous` reference
  ChoiceParameters choice;
};

/// The running program: store, workers and HTTP server. Everything is running when the constructor returns; the
/// destructor stops cleanly: no new requests, running comparisons are put back, all is on the disk.
class Daemon {
 public:
  explicit Daemon(const DaemonConfig& config, std::function<Time()> now = {});
  ~Daemon();
  Daemon(const Daemon&) = delete;
  Daemon& operator=(const Daemon&) = delete;

  std::uint16_t port() const;
  void stop();  ///< idempotent

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace raywatch
