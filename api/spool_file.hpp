#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "api/request_body.hpp"

namespace raywatch {

/// A received body on the disk, removed with this object in every case.
class SpoolFile {
 public:
  /// Receives `body` into a new file in `directory`, which is created when missing, and hashes it on the way.
  /// @throws what `RequestBody::read` throws; DiskFull, StorageError.
  SpoolFile(const std::filesystem::path& directory, RequestBody& body, std::uint64_t max_bytes);
  ~SpoolFile();
  SpoolFile(const SpoolFile&) = delete;
  SpoolFile& operator=(const SpoolFile&) = delete;

  const std::filesystem::path& path() const { return path_; }
  const std::string& sha256() const { return sha256_; }  ///< lower-case hex
  std::uint64_t size() const { return size_; }

 private:
  void receive(int file, RequestBody& body, std::uint64_t max_bytes);

  std::filesystem::path path_;
  std::string sha256_;
  std::uint64_t size_ = 0;
};

}  // namespace raywatch
