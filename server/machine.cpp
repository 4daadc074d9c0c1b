#include "server/machine.hpp"

#include <malloc.h>
#include <unistd.h>

#include <fstream>
#include <system_error>

namespace raywatch {

std::uint64_t resident_memory_bytes() {
  std::ifstream statm("/proc/self/statm");
  std::uint64_t all_pages = 0, resident_pages = 0;
  if (!(statm >> all_pages >> resident_pages)) return 0;
  return resident_pages * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
}

void return_large_blocks() {
#ifdef __GLIBC__
  constexpr int kLarge_bytes = 1 << 19;  // given, it stays; by itself it rises up to 32 MiB
  ::mallopt(M_MMAP_THRESHOLD, kLarge_bytes);
#endif
}

std::uint64_t free_disk_bytes(const std::filesystem::path& directory) {
  std::error_code failed;
  const std::filesystem::space_info space = std::filesystem::space(directory, failed);
  return failed ? 0 : space.available;
}

bool is_writable(const std::filesystem::path& directory) { return ::access(directory.c_str(), W_OK | X_OK) == 0; }

std::filesystem::path program_dir() {
  std::error_code failed;
  return std::filesystem::read_symlink("/proc/self/exe", failed).parent_path();
}

}  // namespace raywatch
