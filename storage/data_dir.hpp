#pragma once

#include <cstdint>
#include <filesystem>

namespace raywatch {

/// Holds the lock file of a data directory, `raywatch.lock`, so that one process at a time uses it.
class DataDirLock {
 public:
  /// @throws StorageError naming the process that holds it.
  explicit DataDirLock(const std::filesystem::path& data_dir);
  ~DataDirLock();
  DataDirLock(const DataDirLock&) = delete;
  DataDirLock& operator=(const DataDirLock&) = delete;

 private:
  int descriptor_ = -1;
};

/// A file that exists while a store is open, `raywatch.running`. Found at the start, it tells of an unclean stop.
class RunningMarker {
 public:
  explicit RunningMarker(const std::filesystem::path& data_dir);
  /// True if the store before this one was not closed.
  bool found() const { return found_; }
  void set();
  void remove();

 private:
  std::filesystem::path file_;
  bool found_ = false;
};

/// Makes a directory with its parents, and flushes the entries that were made.
void make_directories_durably(const std::filesystem::path& directory);
/// Flushes the names in a directory.
void sync_directory(const std::filesystem::path& directory);
void sync_file(const std::filesystem::path& file);

/// @throws DiskFull when writing `bytes` would leave less than `reserve_bytes` free.
struct RoomNeeded {
  std::uint64_t bytes = 0;
  std::uint64_t reserve_bytes = 0;
};
void require_room(const std::filesystem::path& directory, const RoomNeeded& needed);

}  // namespace raywatch
