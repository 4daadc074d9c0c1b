#include "storage/formats/file_bytes.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <string>
#include <system_error>

#include "core/error.hpp"
#include "storage/formats/huge_pages.hpp"

namespace raywatch {
namespace {

[[noreturn]] void throw_errno(const std::filesystem::path& path, const char* what) {
  throw StorageError(path.string() + ": " + what + ": " + std::generic_category().message(errno));
}

class Descriptor {
 public:
  explicit Descriptor(const std::filesystem::path& path) : value_(::open(path.c_str(), O_RDONLY | O_CLOEXEC)) {
    if (value_ < 0) throw_errno(path, "cannot be opened");
  }
  ~Descriptor() { ::close(value_); }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int value() const { return value_; }

 private:
  int value_;
};

std::size_t regular_file_size(const std::filesystem::path& path, int descriptor) {
  struct stat status {};
  if (::fstat(descriptor, &status) != 0) throw_errno(path, "cannot be examined");
  if (!S_ISREG(status.st_mode)) throw StorageError(path.string() + " is not a regular file");
  return static_cast<std::size_t>(status.st_size);
}

/// @returns how many bytes were read: fewer than `size` when the file became shorter meanwhile.
std::size_t read_up_to(const std::filesystem::path& path, int descriptor, std::byte* data, std::size_t size) {
  std::size_t done = 0;
  while (done < size) {
    const ssize_t n = ::read(descriptor, data + done, size - done);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) throw_errno(path, "cannot be read");
    if (n == 0) break;
    done += static_cast<std::size_t>(n);
  }
  return done;
}

}  // namespace

FileBytes::FileBytes(const std::filesystem::path& path, std::uint64_t max_bytes) {
  const Descriptor file(path);
  const std::size_t size = regular_file_size(path, file.value());
  if (size > max_bytes) {
    throw TooLarge("the file has " + std::to_string(size) + " bytes; the limit is " + std::to_string(max_bytes));
  }
  if (size == 0) return;
  // Fresh pages from the system, huge ones where it has them: nothing is zeroed twice and few faults are taken.
  void* pages = ::mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (pages == MAP_FAILED) throw_errno(path, "no memory to read it");
  prefer_huge_pages(pages, size);
  try {
    size_ = read_up_to(path, file.value(), static_cast<std::byte*>(pages), size);
  } catch (...) {
    ::munmap(pages, size);
    throw;
  }
  data_ = static_cast<std::byte*>(pages);
  reserved_ = size;
}

FileBytes::~FileBytes() {
  if (data_ != nullptr) ::munmap(data_, reserved_);
}

}  // namespace raywatch
