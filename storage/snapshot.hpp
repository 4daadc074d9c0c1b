#pragma once

#include <filesystem>

#include "storage/data_dir.hpp"
#include "storage/sqlite.hpp"
#include "storage/store.hpp"

namespace raywatch {

/// What a snapshot or a transaction works on.
struct Snapshot::Impl {
  Database& database;
  std::filesystem::path data_dir;
  std::uint64_t min_free_bytes = 0;

  /// Called by everything that adds records. What deletes or ends something may use the reserve.
  /// @throws DiskFull.
  void require_room_for_records() const {
    constexpr std::uint64_t kRecords_bytes = 1u << 20;
    require_room(data_dir, {.bytes = kRecords_bytes, .reserve_bytes = min_free_bytes});
  }
};

inline Database& database_of(const Snapshot& snapshot) { return snapshot.impl().database; }

}  // namespace raywatch
