#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <list>
#include <memory>
#include <mutex>
#include <string>

#include "core/ids.hpp"
#include "core/time.hpp"
#include "storage/sqlite.hpp"

namespace raywatch {

/// The file of a site and a month (UTC), relative to the data directory: "payload/3/2026-11.db". After a file was
/// damaged the month goes on in another `part`: "payload/3/2026-11.2.db".
std::string payload_file_name(SiteId site, Time captured_at, int part = 1);

/// The connections to the payload files. Months accumulate, so only the last used ones stay open.
class PayloadFiles {
 public:
  explicit PayloadFiles(std::filesystem::path data_dir) : data_dir_(std::move(data_dir)) {}

  /// The writing connection of a file, which is made if it does not exist. Only on the writer thread; valid until the
  /// next call.
  Database& writer(const std::string& file);
  /// Runs `f` on a read-only connection inside one read transaction; `f` is given nothing if there is no such file.
  /// Thread-safe.
  void read(const std::string& file, const std::function<void(Database*)>& f);

  /// All payload files on the disk, relative to the data directory, sorted.
  std::vector<std::string> on_disk() const;
  /// Those of one site.
  std::vector<std::string> on_disk_of(SiteId site) const;
  /// Closes what is open. Only on the writer thread, and while nobody reads.
  void close();
  /// Deletes a file. As `close`.
  void remove(const std::string& file);

  const std::filesystem::path& data_dir() const { return data_dir_; }

 private:
  struct Connection {
    std::string file;
    std::unique_ptr<Database> database;
  };
  std::unique_ptr<Database> take_reader(const std::string& file);
  void give_reader(const std::string& file, std::unique_ptr<Database> database);
  std::vector<std::string> files_below(const std::filesystem::path& root) const;

  std::filesystem::path data_dir_;
  std::list<Connection> writers_;  // the last used first
  std::mutex mutex_;
  std::list<Connection> readers_;  // idle ones, the last used first
};

}  // namespace raywatch
