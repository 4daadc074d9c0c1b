#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <unordered_map>
#include <vector>

#include "core/ids.hpp"
#include "core/time.hpp"
#include "storage/deletions.hpp"
#include "storage/payloads.hpp"
#include "storage/retention_limits.hpp"
#include "storage/store.hpp"

namespace raywatch {

/// Why a scan is not deleted, whatever the limits say.
enum class Protection : std::uint8_t {
  pinned,
  baseline,    ///< it is part of what is normal now
  alert,       ///< an alert that is not resolved came of it, or its track began or was last seen with it
  evidence,    ///< a prior in a comparison of such a scan
  unfinished,  ///< a comparison of it, or one that names it, is not finished
  survey,      ///< an accepted epoch has it, or a survey that is to come or not finished needs it
  anchor,      ///< the poses of later scans of its place are refined against it
};
std::string_view to_string(Protection protection);

/// The scans of a site that are protected, but for anchors, which are many where there are many places.
std::unordered_map<ScanId, Protection> protected_scans(const Snapshot& snapshot, SiteId site);
/// Whether the scan is the anchor of its vantage: see `Registration`.
bool is_anchor(const Snapshot& snapshot, const ScanRecord& scan);

/// What holds at a site, and how things are there.
struct RetentionState {
  RetentionLimits in_force;
  Time now;
  std::uint64_t used_bytes = 0;  ///< by the site's payload files
  std::uint64_t free_bytes = 0;  ///< on the disk, with what was freed and is not given back yet
};
/// How things are now.
RetentionState retention_state(Store& store, SiteId site, const RetentionLimits& in_force, Time now);

/// A scan that is to go.
struct ExpiredScan {
  ScanId scan;
  Time received_at;
  /// Of its points and of the classes in its comparisons. The disk gets back a little more, as pages are not full.
  std::uint64_t bytes = 0;
  DeletionReason reason = DeletionReason::age;
};

/// What would be deleted, and what would not be.
struct RetentionPlan {
  std::vector<ExpiredScan> expired;                 ///< by receipt, at most as many as asked for
  std::uint64_t bytes = 0;                          ///< of all of them
  std::map<DeletionReason, std::uint64_t> reasons;  ///< how many go because of what
  std::optional<Time> oldest_received_at, newest_received_at;
  std::map<Protection, std::uint64_t> kept;  ///< scans that were as old and stay
  bool reached =
      true;  ///< the limits of bytes and free disk hold then, or there is more to take; else all is protected
};

/// Goes through the scans of a site by their receipt, oldest first, until the limits hold or there are
/// `most_scans` to delete.
RetentionPlan plan_retention(const Snapshot& snapshot, SiteId site, const RetentionState& state,
                             std::size_t most_scans);

/// Deletes those of a plan that are still there and not protected by now, each with its comparisons and their changes,
/// and records it. What other comparisons, tracks and alerts say about them stays.
struct DeletedScans {
  std::vector<ScanId> scans;
  std::vector<PayloadRef> payloads;  ///< to be removed after the commit
  std::uint64_t bytes = 0;
};
DeletedScans delete_expired(Transaction& transaction, SiteId site, const std::vector<ExpiredScan>& expired, Time now);

}  // namespace raywatch
