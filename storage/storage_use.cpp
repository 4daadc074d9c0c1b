#include "storage/storage_use.hpp"

#include <chrono>
#include <filesystem>
#include <string>
#include <string_view>
#include <system_error>

#include "storage/payloads.hpp"
#include "storage/snapshot.hpp"

namespace raywatch {
namespace {

namespace fs = std::filesystem;

/// Files come and go meanwhile: what is not there any more has no bytes.
std::uint64_t bytes_of_file(const fs::directory_entry& entry) {
  std::error_code gone;
  const std::uintmax_t bytes = entry.is_regular_file(gone) ? entry.file_size(gone) : 0;
  return gone ? 0 : bytes;
}

std::uint64_t bytes_below(const fs::path& directory) {
  std::error_code absent;
  std::uint64_t bytes = 0;
  for (fs::recursive_directory_iterator entry(directory, absent), end; !absent && entry != end;
       entry.increment(absent)) {
    bytes += bytes_of_file(*entry);
  }
  return bytes;
}

/// The names begin with this and go on with nothing, "-wal" or "-shm"; or with ".before-v3", for a copy.
constexpr std::string_view kMetadata = "raywatch.db", kCopy = "raywatch.db.";

}  // namespace

StorageUse storage_use(const Store& store) {
  StorageUse use;
  std::error_code failed;
  for (fs::directory_iterator entry(store.data_dir(), failed), end; !failed && entry != end; entry.increment(failed)) {
    const std::string name = entry->path().filename().string();
    if (!name.starts_with(kMetadata)) continue;
    (name.starts_with(kCopy) ? use.metadata_copies_bytes : use.metadata_bytes) += bytes_of_file(*entry);
  }
  use.spool_bytes = bytes_below(store.data_dir() / "spool");
  const fs::space_info disk = fs::space(store.data_dir(), failed);
  if (!failed) use.disk_bytes = disk.capacity, use.free_bytes = disk.available;
  return use;
}

std::uint64_t payload_bytes_on_disk(const Store& store, SiteId site) {
  return bytes_below(store.data_dir() / "payload" / std::to_string(site.value));
}

EventsUse events_use(const Snapshot& snapshot) {
  constexpr std::int64_t kSample = 1000;
  Database& database = database_of(snapshot);
  const auto first = database.find<std::optional<std::int64_t>>("SELECT min(id) FROM events").value();
  const auto last = database.find<std::optional<std::int64_t>>("SELECT max(id) FROM events").value();
  if (!first) return {};
  // Beside its two texts a row has about a dozen small numbers.
  const auto mean_bytes =
      database.find<double>("SELECT avg(length(type) + length(text) + 40) FROM events WHERE id > ?", *last - kSample);
  const auto events = static_cast<std::uint64_t>(*last - *first + 1);
  return {.events = events,
          .bytes = static_cast<std::uint64_t>(static_cast<double>(events) * mean_bytes.value_or(0.0)),
          .oldest_at = database.find<Time>("SELECT at FROM events WHERE id = ?", *first)};
}

std::optional<Growth> growth_of(const Snapshot& snapshot, SiteId site, Time now) {
  constexpr std::chrono::days kWindow{7};
  constexpr std::uint64_t kMostScans = 10'000;
  // Scans often come in turns of the day, or many at once when somebody begins. Where even an hour brings thousands, it
  // tells.
  constexpr std::chrono::hours kShortest{24}, kShortestOfMany{1};
  Statement rows(database_of(snapshot),
                 "SELECT received_at, stored_bytes + (SELECT ifnull(sum(c.stored_bytes), 0) FROM comparisons AS c "
                 "INDEXED BY comparisons_by_scan WHERE c.scan = scans.id) FROM scans INDEXED BY scans_by_receipt "
                 "WHERE site = ? AND received_at >= ? ORDER BY received_at DESC, id DESC LIMIT ?");
  rows.bind(site, now - kWindow, kMostScans);
  Growth growth{.since = now};
  for (; rows.next(); ++growth.scans) {
    growth.since = rows.take<Time>();
    growth.bytes += rows.take<std::uint64_t>();
  }
  const auto shortest = growth.scans == kMostScans ? kShortestOfMany : kShortest;
  if (growth.scans < 2 || now - growth.since < shortest) return std::nullopt;
  return growth;
}

}  // namespace raywatch
