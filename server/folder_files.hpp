#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/time.hpp"

namespace raywatch {

/// Where the capture time of a file comes from when its side-car does not say it.
enum class TimeFrom : std::uint8_t {
  name,   ///< a time in the file's name
  mtime,  ///< that, else when the file was written last
};

/// What tells whether a file changed.
struct FileState {
  std::uint64_t bytes = 0;
  std::int64_t modified_ns = 0;  ///< since 1970
  std::uint64_t inode = 0;
  friend bool operator==(const FileState&, const FileState&) = default;
};

/// Nothing when it is not there, or is no plain file: links, pipes and devices are not followed.
std::optional<FileState> state_of(const std::filesystem::path& file);

/// Whether the name ends as those of scan files do.
bool has_scan_ending(const std::filesystem::path& file);

/// The plain files with such an ending in a folder, not below it, by name. Hidden ones, whose names begin with a dot,
/// are left out: many programs write into such a file and rename it.
std::vector<std::filesystem::path> scan_files_in(const std::filesystem::path& folder);

/// The time in a name such as "gate_2026-11-22T10-00-00Z.pcd", "20261122T100000.25Z.las" or "2026-11-22_10-00-00.ply":
/// year, month, day, hour, minute and second, with or without '-', ':' or '_' between them, a 'T', '_' or '-' between
/// the two halves, a fraction, and always UTC.
std::optional<Time> time_in_name(std::string_view name);

/// Where a file can be put in a directory without touching another: the name gets "-2", "-3", ... before its ending
/// when it is taken.
std::filesystem::path free_place(const std::filesystem::path& directory, const std::filesystem::path& name);

/// Renames a file on the same disk, and never over another. @throws StorageError.
void move_file(const std::filesystem::path& from, const std::filesystem::path& to);

/// The side-car of a scan file.
std::filesystem::path side_car_of(const std::filesystem::path& scan_file);

/// SHA-256 of what a file holds, in lower-case hex. @throws StorageError when it cannot be read.
std::string sha256_of_file(const std::filesystem::path& file);

}  // namespace raywatch
