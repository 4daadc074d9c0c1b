#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "core/ids.hpp"
#include "core/time.hpp"
#include "storage/page.hpp"
#include "storage/scans.hpp"
#include "storage/store.hpp"

namespace raywatch {

/// Why something was deleted.
enum class DeletionReason : std::uint8_t {
  by_operator,
  age,        ///< it was older than what is kept
  bytes,      ///< its site had more than what is kept
  free_disk,  ///< the disk had less room than what is kept free
};
std::string_view to_string(DeletionReason reason);

/// What was deleted, when and why.
struct DeletionRecord {
  std::int64_t id = 0;
  Time at;
  std::string what;  ///< scan, events, deletions
  DeletionReason reason = DeletionReason::by_operator;
  std::optional<SiteId> site;
  std::optional<SensorId> sensor;
  std::optional<ScanId> scan;
  std::optional<Time> captured_at, received_at;
  std::uint64_t records = 1;  ///< how many it were; of a scan, 1
  std::uint64_t bytes = 0;    ///< of points and point classes
};

/// The record's id is ignored.
void insert_deletion(Transaction& transaction, const DeletionRecord& deletion);
/// Records that a scan is deleted, with an event. To be called in the transaction that deletes it.
void record_deleted_scan(Transaction& transaction, const ScanRecord& scan, std::uint64_t bytes, DeletionReason reason,
                         Time now);
/// Newest first.
Page<DeletionRecord> list_deletions(const Snapshot& snapshot, std::optional<SiteId> site, const PageRequest& page);

/// What can be deleted of a log at once, so that nobody waits for it.
inline constexpr std::size_t kLogRowsAtOnce = 2000;
/// Deletes the oldest events, or records of deletions, that are older than `horizon`: at most `kLogRowsAtOnce` of each,
/// and never the latest. Records it. @returns how many are gone.
std::uint64_t prune_logs(Transaction& transaction, Time horizon, Time now);
/// Whether `prune_logs` would find something.
bool has_old_logs(const Snapshot& snapshot, Time horizon);

}  // namespace raywatch
