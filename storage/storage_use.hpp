#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/ids.hpp"
#include "core/time.hpp"
#include "storage/store.hpp"

namespace raywatch {

/// What lies on the disk, in bytes of files.
struct StorageUse {
  std::uint64_t metadata_bytes = 0;         ///< raywatch.db, events among it
  std::uint64_t metadata_copies_bytes = 0;  ///< copies made before migrations
  std::uint64_t spool_bytes = 0;            ///< uploads that are under way
  std::uint64_t disk_bytes = 0, free_bytes = 0;
};
StorageUse storage_use(const Store& store);

/// The files with points and point classes of a site.
std::uint64_t payload_bytes_on_disk(const Store& store, SiteId site);

/// The events that are kept.
struct EventsUse {
  std::uint64_t events = 0;
  std::uint64_t bytes = 0;  ///< estimated from the latest ones
  std::optional<Time> oldest_at;
};
EventsUse events_use(const Snapshot& snapshot);

/// What comes in at a site, by what was received lately.
struct Growth {
  std::uint64_t scans = 0;  ///< received since `since`
  std::uint64_t bytes = 0;  ///< of them and of their comparisons
  Time since;
};
/// Of the last days, or of the last scans when there are very many. Nothing when too little came to tell a rate.
std::optional<Growth> growth_of(const Snapshot& snapshot, SiteId site, Time now);

}  // namespace raywatch
