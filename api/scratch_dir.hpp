#pragma once

#include <filesystem>
#include <string>

namespace raywatch {

/// A directory of its own for the files of one answer, removed with this object in every case.
class ScratchDir {
 public:
  /// In `directory`, which is created when missing. @throws StorageError.
  explicit ScratchDir(const std::filesystem::path& directory);
  ~ScratchDir();
  ScratchDir(const ScratchDir&) = delete;
  ScratchDir& operator=(const ScratchDir&) = delete;

  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }

 private:
  std::filesystem::path path_;
};

/// All of a file. @throws StorageError.
std::string content_of(const std::filesystem::path& path);

}  // namespace raywatch
