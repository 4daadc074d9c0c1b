#include "storage/payload_files.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>

#include "storage/data_dir.hpp"
#include "storage/migrations.hpp"

namespace raywatch {
namespace {

constexpr std::size_t kOpenWriters = 8;
constexpr std::size_t kIdleReaders = 16;

std::unique_ptr<Database> open_for_writing(const std::filesystem::path& file) {
  make_directories_durably(file.parent_path());
  auto database = std::make_unique<Database>(file, Database::Access::create);
  migrate(*database, payload_migrations(), CopyBefore::no);
  // What is deleted here is only old measurements: there is nothing to overwrite. The log shrinks after a large scan.
  database->run_script("PRAGMA secure_delete = OFF; PRAGMA journal_size_limit = 67108864");
  return database;
}

}  // namespace

std::string payload_file_name(SiteId site, Time captured_at, int part) {
  const std::chrono::year_month_day day(std::chrono::floor<std::chrono::days>(captured_at));
  std::array<char, 64> name{};
  std::snprintf(name.data(), name.size(), "payload/%lld/%04d-%02u", static_cast<long long>(site.value),
                static_cast<int>(day.year()), static_cast<unsigned>(day.month()));
  return name.data() + (part > 1 ? "." + std::to_string(part) : std::string()) + ".db";
}

Database& PayloadFiles::writer(const std::string& file) {
  const auto open = std::find_if(writers_.begin(), writers_.end(), [&](const Connection& c) { return c.file == file; });
  if (open != writers_.end()) {
    writers_.splice(writers_.begin(), writers_, open);
  } else {
    writers_.push_front({file, open_for_writing(data_dir_ / file)});
    if (writers_.size() > kOpenWriters) writers_.pop_back();
  }
  return *writers_.front().database;
}

std::unique_ptr<Database> PayloadFiles::take_reader(const std::string& file) {
  {
    const std::lock_guard lock(mutex_);
    const auto idle =
        std::find_if(readers_.begin(), readers_.end(), [&](const Connection& c) { return c.file == file; });
    if (idle != readers_.end()) {
      std::unique_ptr<Database> database = std::move(idle->database);
      readers_.erase(idle);
      return database;
    }
  }
  if (file.empty() || !std::filesystem::exists(data_dir_ / file)) return nullptr;
  return std::make_unique<Database>(data_dir_ / file, Database::Access::read_only);
}

void PayloadFiles::give_reader(const std::string& file, std::unique_ptr<Database> database) {
  Connection surplus;
  const std::lock_guard lock(mutex_);
  readers_.push_front({file, std::move(database)});
  if (readers_.size() > kIdleReaders) {
    surplus = std::move(readers_.back());
    readers_.pop_back();
  }
}

void PayloadFiles::read(const std::string& file, const std::function<void(Database*)>& f) {
  std::unique_ptr<Database> database = take_reader(file);
  if (!database) return f(nullptr);
  // A connection on which something failed is not used again.
  database->read_consistently([&] { f(database.get()); });
  give_reader(file, std::move(database));
}

std::vector<std::string> PayloadFiles::on_disk() const { return files_below(data_dir_ / "payload"); }

std::vector<std::string> PayloadFiles::on_disk_of(SiteId site) const {
  return files_below(data_dir_ / "payload" / std::to_string(site.value));
}

std::vector<std::string> PayloadFiles::files_below(const std::filesystem::path& root) const {
  std::vector<std::string> files;
  if (!std::filesystem::exists(root)) return files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(root)) {
    if (entry.is_regular_file() && entry.path().extension() == ".db") {
      files.push_back(std::filesystem::relative(entry.path(), data_dir_).generic_string());
    }
  }
  std::sort(files.begin(), files.end());
  return files;
}

void PayloadFiles::close() {
  {
    const std::lock_guard lock(mutex_);
    readers_.clear();
  }
  writers_.clear();
}

void PayloadFiles::remove(const std::string& file) {
  close();
  for (const char* suffix : {"", "-wal", "-shm"}) std::filesystem::remove(data_dir_ / (file + suffix));
}

}  // namespace raywatch
