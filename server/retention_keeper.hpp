#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>

#include "core/time.hpp"
#include "storage/retention.hpp"
#include "storage/sites.hpp"
#include "storage/store.hpp"

namespace raywatch {

struct RetentionConfig {
  RetentionLimits defaults;                     ///< of sites that say nothing else
  std::chrono::days events_max_age{400};        ///< also of the records of deletions
  std::size_t scans_at_once = 16;               ///< deleted in one transaction, which uploads wait for
  std::chrono::milliseconds longest_turn{500};  ///< a turn ends after the step in which this time is over
};

/// What was deleted since the start.
struct RetentionStatus {
  std::uint64_t scans_deleted = 0, bytes_deleted = 0, events_deleted = 0;
};

/// Deletes what is older, or more, than what is kept, in small steps, so that uploads are not held up. A crash at any
/// point leaves what a crash of an upload leaves: payloads without an owner, which the next start sweeps.
class RetentionKeeper {
 public:
  /// @param forget is called with each scan that is gone.
  RetentionKeeper(Store& store, const RetentionConfig& config, std::function<void(ScanId)> forget)
      : store_(store), config_(config), forget_(std::move(forget)) {}

  /// Does what is due, for a bounded time. One thread at a time.
  /// @returns whether there is more to do. @throws core/error.hpp.
  bool keep(Time now);
  /// Thread-safe.
  RetentionStatus status() const { return {scans_deleted_, bytes_deleted_, events_deleted_}; }

 private:
  bool step(const Site& site, Time now);
  bool prune_logs(Time now);
  void remove(const DeletedScans& deleted);

  Store& store_;
  RetentionConfig config_;
  std::function<void(ScanId)> forget_;
  bool pruning_ = false;
  std::atomic<std::uint64_t> scans_deleted_{0}, bytes_deleted_{0}, events_deleted_{0};
};

}  // namespace raywatch
