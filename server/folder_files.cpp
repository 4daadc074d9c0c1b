#include "server/folder_files.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <regex>

#include "api/sha256.hpp"
#include "core/error.hpp"

namespace raywatch {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const fs::path& file, const char* doing, int error) {
  throw StorageError(file.string() + ": " + doing + ": " + std::strerror(error));
}

}  // namespace

std::optional<FileState> state_of(const fs::path& file) {
  struct stat found = {};
  if (::lstat(file.c_str(), &found) != 0 || !S_ISREG(found.st_mode)) return std::nullopt;
  return FileState{.bytes = static_cast<std::uint64_t>(found.st_size),
                   .modified_ns = std::int64_t{found.st_mtim.tv_sec} * 1'000'000'000 + found.st_mtim.tv_nsec,
                   .inode = found.st_ino};
}

bool has_scan_ending(const fs::path& file) {
  constexpr std::array<std::string_view, 9> kEndings = {".pcd", ".ply", ".las", ".ptx", ".xyz",
                                                        ".csv", ".txt", ".asc", ".bin"};
  std::string ending = file.extension().string();
  std::ranges::transform(ending, ending.begin(), [](char c) { return c >= 'A' && c <= 'Z' ? char(c + 32) : c; });
  return std::ranges::find(kEndings, ending) != kEndings.end();
}

std::vector<fs::path> scan_files_in(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code failed;
  for (fs::directory_iterator entry(folder, failed), end; !failed && entry != end; entry.increment(failed)) {
    const fs::path& file = entry->path();
    if (file.filename().string().starts_with('.') || !has_scan_ending(file) || !state_of(file)) continue;
    files.push_back(file);
  }
  std::ranges::sort(files);
  return files;
}

std::optional<Time> time_in_name(std::string_view name) {
  static const std::regex pattern(
      R"((?:^|[^0-9])(\d{4})[-_:]?(\d\d)[-_:]?(\d\d)[T_-](\d\d)[-_:]?(\d\d)[-_:]?(\d\d)(?:[.,](\d{1,9}))?(?![0-9]))");
  std::match_results<std::string_view::const_iterator> found;
  if (!std::regex_search(name.begin(), name.end(), found, pattern)) return std::nullopt;
  const auto part = [&](std::size_t i) { return found[i].str(); };
  const std::string fraction = found[7].matched ? "." + part(7) : "";
  try {
    return parse_rfc3339(part(1) + "-" + part(2) + "-" + part(3) + "T" + part(4) + ":" + part(5) + ":" + part(6) +
                         fraction + "Z");
  } catch (const InvalidInput&) {
    return std::nullopt;  // a number of another kind
  }
}

fs::path free_place(const fs::path& directory, const fs::path& name) {
  fs::path place = directory / name.filename();
  std::error_code ignored;
  for (int number = 2; fs::exists(fs::symlink_status(place, ignored)); ++number) {
    place = directory / (name.stem().string() + "-" + std::to_string(number) + name.extension().string());
  }
  return place;
}

void move_file(const fs::path& from, const fs::path& to) {
  if (::renameat2(AT_FDCWD, from.c_str(), AT_FDCWD, to.c_str(), RENAME_NOREPLACE) == 0) return;
  if (errno != EINVAL && errno != ENOSYS) fail(from, ("cannot move to " + to.string()).c_str(), errno);
  // A file system without that, such as NFS: nobody else writes where files are put away.
  std::error_code ignored;
  if (fs::exists(fs::symlink_status(to, ignored))) fail(from, ("cannot move to " + to.string()).c_str(), EEXIST);
  if (::rename(from.c_str(), to.c_str()) != 0) fail(from, ("cannot move to " + to.string()).c_str(), errno);
}

fs::path side_car_of(const fs::path& scan_file) {
  fs::path path = scan_file;
  path += ".json";
  return path;
}

std::string sha256_of_file(const fs::path& file) {
  const int descriptor = ::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK);
  if (descriptor < 0) fail(file, "cannot be read", errno);
  Sha256 hash;
  std::vector<char> buffer(1 << 18);
  ssize_t size = 0;
  while ((size = ::read(descriptor, buffer.data(), buffer.size())) > 0 || (size < 0 && errno == EINTR)) {
    if (size > 0) hash.add({buffer.data(), static_cast<std::size_t>(size)});
  }
  const int error = errno;
  ::close(descriptor);
  if (size < 0) fail(file, "cannot be read", error);
  return hash.hex();
}

}  // namespace raywatch
