#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>

namespace raywatch {

/// The whole content of a file, in memory.
///
/// The bytes are copied, not mapped: a mapped file that another process shortens meanwhile kills the reader with
/// SIGBUS, and files in a watched folder belong to others.
class FileBytes {
 public:
  /// @throws StorageError when the file cannot be read; TooLarge when it has more than `max_bytes`.
  FileBytes(const std::filesystem::path& path, std::uint64_t max_bytes);
  ~FileBytes();
  FileBytes(const FileBytes&) = delete;
  FileBytes& operator=(const FileBytes&) = delete;

  std::span<const std::byte> bytes() const { return {data_, size_}; }

 private:
  std::byte* data_ = nullptr;
  std::size_t size_ = 0;
  std::size_t reserved_ = 0;
};

}  // namespace raywatch
