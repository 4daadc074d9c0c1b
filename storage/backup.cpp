#include "storage/backup.hpp"

#include <unistd.h>

#include <algorithm>
#include <string>

#include "core/error.hpp"
#include "storage/data_dir.hpp"

namespace raywatch {
namespace {

/// Links and detours on the way are followed.
bool is_within(const std::filesystem::path& inner, const std::filesystem::path& outer) {
  const auto real = [](const std::filesystem::path& path) {
    return std::filesystem::weakly_canonical(std::filesystem::absolute(path));
  };
  const std::filesystem::path in = real(inner), out = real(outer);
  return std::ranges::mismatch(out, in).in1 == out.end();
}

void require_usable(const std::filesystem::path& directory, const std::filesystem::path& data_dir) {
  if (directory.empty())
    throw InvalidInput("no directory for the backup is given", {{"directory", "must not be empty"}});
  if (is_within(directory, data_dir)) {
    throw InvalidInput("the backup must not lie in the data directory " + data_dir.string(),
                       {{"directory", "must not lie in the data directory"}});
  }
  if (!std::filesystem::exists(directory)) return;
  if (!std::filesystem::is_directory(directory) || !std::filesystem::is_empty(directory)) {
    throw InvalidInput("the backup needs a directory of its own: " + directory.string() + " exists and is not empty",
                       {{"directory", "must not exist or be empty"}});
  }
}

/// Who asks for the backup chose where it lies.
void make_target(const std::filesystem::path& directory) {
  try {
    make_directories_durably(directory);
  } catch (const DiskFull&) {
    throw;
  } catch (const StorageError& error) {
    throw InvalidInput(error.what(), {{"directory", "cannot be made: " + std::string(error.what())}});
  }
  if (access(directory.c_str(), W_OK | X_OK) == 0) return;
  throw InvalidInput("nothing may be written to " + directory.string(), {{"directory", "must be writable"}});
}

std::uint64_t bytes_with_log(const std::filesystem::path& file) {
  std::uint64_t bytes = 0;
  for (const char* suffix : {"", "-wal"}) {
    std::error_code absent;
    const std::uintmax_t size = std::filesystem::file_size(file.string() + suffix, absent);
    if (!absent) bytes += size;
  }
  return bytes;
}

std::uint64_t bytes_to_copy(const Database& metadata, const PayloadFiles& files) {
  std::uint64_t bytes = bytes_with_log(metadata.file());
  for (const std::string& file : files.on_disk()) bytes += bytes_with_log(files.data_dir() / file);
  return bytes;
}

void copy_payload_file(PayloadFiles& files, const std::string& file, const std::filesystem::path& directory) {
  const std::filesystem::path target = directory / file;
  make_directories_durably(target.parent_path());
  files.read(file, [&](Database* database) {
    if (database) database->copy_to(target);
  });
  sync_directory(target.parent_path());
}

void copy_all(Database& metadata, PayloadFiles& files, const std::filesystem::path& directory) {
  const std::filesystem::path target = directory / metadata.file().filename();
  const std::filesystem::path partial = target.string() + ".partial";
  metadata.copy_to(partial);
  for (const std::string& file : files.on_disk()) copy_payload_file(files, file, directory);
  std::filesystem::rename(partial, target);
  sync_directory(directory);
}

void remove_content(const std::filesystem::path& directory) noexcept {
  std::error_code ignored;
  for (const auto& entry : std::filesystem::directory_iterator(directory, ignored)) {
    std::filesystem::remove_all(entry.path(), ignored);
  }
}

}  // namespace

void copy_store(Database& metadata, PayloadFiles& files, const std::filesystem::path& directory,
                std::uint64_t min_free_bytes) {
  require_usable(directory, files.data_dir());
  const std::filesystem::path target = std::filesystem::absolute(directory).lexically_normal();
  make_target(target);
  require_room(target, {.bytes = bytes_to_copy(metadata, files), .reserve_bytes = min_free_bytes});
  try {
    copy_all(metadata, files, target);
  } catch (...) {
    remove_content(target);
    throw;
  }
}

}  // namespace raywatch
