#include "api/spool_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <system_error>
#include <vector>

#include "api/sha256.hpp"
#include "core/error.hpp"

namespace raywatch {
namespace {

[[noreturn]] void throw_spool_error(const std::filesystem::path& path, int error) {
  const std::string message = "cannot receive into " + path.string() + ": " + std::strerror(error);
  if (error == ENOSPC || error == EDQUOT) throw DiskFull(message);
  throw StorageError(message);
}

class OpenFile {
 public:
  explicit OpenFile(int file) : file_(file) {}
  ~OpenFile() { ::close(file_); }
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;

 private:
  int file_;
};

/// Gathers small pieces into large writes.
class SpoolWriter {
 public:
  SpoolWriter(int file, const std::filesystem::path& path) : file_(file), path_(path) { buffer_.reserve(kBufferBytes); }

  void add(std::span<const char> bytes) {
    if (buffer_.size() + bytes.size() > kBufferBytes) flush();
    buffer_.insert(buffer_.end(), bytes.begin(), bytes.end());
  }

  void flush() {
    for (std::size_t done = 0; done < buffer_.size();) {
      const ssize_t written = ::write(file_, buffer_.data() + done, buffer_.size() - done);
      if (written < 0 && errno == EINTR) continue;
      if (written < 0) throw_spool_error(path_, errno);
      done += static_cast<std::size_t>(written);
    }
    buffer_.clear();
  }

 private:
  static constexpr std::size_t kBufferBytes = 256 << 10;
  int file_;
  const std::filesystem::path& path_;
  std::vector<char> buffer_;
};

}  // namespace

SpoolFile::SpoolFile(const std::filesystem::path& directory, RequestBody& body, std::uint64_t max_bytes) {
  std::error_code error;
  std::filesystem::create_directories(directory, error);
  std::string name = (directory / "upload-XXXXXX").string();
  const int file = ::mkostemp(name.data(), O_CLOEXEC);
  if (file < 0) throw_spool_error(directory, errno);
  const OpenFile closed_at_the_end(file);
  path_ = name;
  try {
    receive(file, body, max_bytes);
  } catch (...) {
    std::filesystem::remove(path_, error);
    throw;
  }
}

SpoolFile::~SpoolFile() {
  std::error_code ignored;  // what is left is swept when the daemon starts
  std::filesystem::remove(path_, ignored);
}

void SpoolFile::receive(int file, RequestBody& body, std::uint64_t max_bytes) {
  Sha256 hash;
  SpoolWriter writer(file, path_);
  body.read(max_bytes, [&](std::span<const char> bytes) {
    hash.add(bytes);
    writer.add(bytes);
    size_ += bytes.size();
  });
  writer.flush();
  sha256_ = hash.hex();
}

}  // namespace raywatch
