#include "storage/data_dir.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/statvfs.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <string>
#include <string_view>

#include "core/error.hpp"

namespace raywatch {
namespace {

[[noreturn]] void fail(const std::filesystem::path& path, std::string_view doing) {
  const int error = errno;
  const std::string message = path.string() + ": " + std::string(doing) + ": " + std::strerror(error);
  if (error == ENOSPC || error == EDQUOT) throw DiskFull(message);
  throw StorageError(message);
}

void sync_path(const std::filesystem::path& path, int flags) {
  const int descriptor = open(path.c_str(), flags | O_CLOEXEC);
  if (descriptor < 0) fail(path, "cannot open");
  const bool synced = fsync(descriptor) == 0;
  const int error = errno;
  close(descriptor);
  errno = error;
  if (!synced) fail(path, "cannot flush");
}

std::string holder_of(int descriptor) {
  std::array<char, 32> text{};
  const ssize_t size = pread(descriptor, text.data(), text.size(), 0);
  return size > 0 ? std::string(text.data(), static_cast<std::size_t>(size)) : std::string("unknown");
}

}  // namespace

DataDirLock::DataDirLock(const std::filesystem::path& data_dir) {
  const std::filesystem::path file = data_dir / "raywatch.lock";
  descriptor_ = open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644);
  if (descriptor_ < 0) fail(file, "cannot open");
  if (flock(descriptor_, LOCK_EX | LOCK_NB) != 0) {
    const std::string holder = holder_of(descriptor_);
    close(descriptor_);
    throw StorageError("the data directory " + data_dir.string() + " is in use by process " + holder +
                       "; stop that one, or talk to it over HTTP");
  }
  const std::string pid = std::to_string(getpid());
  if (ftruncate(descriptor_, 0) != 0 || pwrite(descriptor_, pid.data(), pid.size(), 0) < 0) {
    close(descriptor_);
    fail(file, "cannot write");
  }
}

DataDirLock::~DataDirLock() { close(descriptor_); }

RunningMarker::RunningMarker(const std::filesystem::path& data_dir)
    : file_(data_dir / "raywatch.running"), found_(std::filesystem::exists(file_)) {}

void RunningMarker::set() {
  const int descriptor = open(file_.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0644);
  if (descriptor < 0) fail(file_, "cannot create");
  close(descriptor);
  sync_directory(file_.parent_path());
}

void RunningMarker::remove() {
  std::filesystem::remove(file_);
  sync_directory(file_.parent_path());
}

void make_directories_durably(const std::filesystem::path& directory) {
  if (directory.empty() || std::filesystem::exists(directory)) return;
  const std::filesystem::path parent = directory.parent_path();
  make_directories_durably(parent);
  std::error_code error;
  std::filesystem::create_directory(directory, error);
  if (error) {
    errno = error.value();
    fail(directory, "cannot create");
  }
  sync_directory(parent.empty() ? "." : parent);
}

void sync_directory(const std::filesystem::path& directory) { sync_path(directory, O_RDONLY | O_DIRECTORY); }

void sync_file(const std::filesystem::path& file) { sync_path(file, O_RDONLY); }

void require_room(const std::filesystem::path& directory, const RoomNeeded& needed) {
  struct statvfs disk = {};
  if (statvfs(directory.c_str(), &disk) != 0) fail(directory, "cannot ask for free space");
  const std::uint64_t free_bytes = static_cast<std::uint64_t>(disk.f_bavail) * disk.f_frsize;
  if (free_bytes >= needed.reserve_bytes && free_bytes - needed.reserve_bytes >= needed.bytes) return;
  constexpr std::uint64_t kMebibyte = 1u << 20;
  throw DiskFull("the disk of " + directory.string() + " has " + std::to_string(free_bytes / kMebibyte) +
                 " MiB free; " + std::to_string(needed.reserve_bytes / kMebibyte) + " MiB are kept free, and " +
                 std::to_string(needed.bytes / kMebibyte) + " MiB more are needed");
}

}  // namespace raywatch
