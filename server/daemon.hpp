#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <vector>

#include "api/http_server.hpp"
#include "core/choose_priors.hpp"
#include "core/time.hpp"
#include "server/delivery/delivery_config.hpp"
#include "server/folder_intake.hpp"
#include "server/retention_keeper.hpp"
#include "server/watcher.hpp"

namespace raywatch {

struct DaemonConfig {
  std::filesystem::path data_dir = "raywatch-data";
  HttpConfig http;
  unsigned workers = 0;          ///< sites compared at once; 0: one a core
  unsigned compare_threads = 0;  ///< threads of one comparison; 0: one a core, which is also the most
  std::uint64_t index_cache_bytes = std::uint64_t{1} << 30;
  std::uint64_t queue_limit = 1000;  ///< unfinished jobs above which uploads get 503
  std::uint64_t min_free_disk_bytes = 256u << 20;
  RetentionConfig retention;
  std::vector<FolderConfig> folders;
  std::chrono::seconds future_tolerance{60};    ///< a capture time later than now by more than this is refused
  std::chrono::hours previous_limit{24 * 365};  ///< scans older than this are no `previous` reference
  ChoiceParameters choice;
  WatchConfig watch;
  DeliveryConfig delivery;
};

/// How a stop went.
enum class StopOutcome : std::uint8_t {
  clean,                  ///< nothing runs any more
  comparisons_abandoned,  ///< a comparison still runs; it starts again at the next start
  deliveries_abandoned,   ///< a message is still on its way; it is sent again at the next start
};

/// The running program: store, workers and HTTP server. Everything is running when the constructor returns; the
/// destructor stops it and waits for the running comparisons.
class Daemon {
 public:
  explicit Daemon(const DaemonConfig& config, std::function<Time()> now = {});
  ~Daemon();
  Daemon(const Daemon&) = delete;
  Daemon& operator=(const Daemon&) = delete;

  std::uint16_t port() const;
  /// Takes no new request and begins no new comparison, and gives those that run a few seconds to end. Idempotent.
  StopOutcome stop();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace raywatch
