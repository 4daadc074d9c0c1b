#pragma once

#include <condition_variable>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <vector>

#include "storage/sqlite.hpp"

namespace raywatch {

/// A fixed number of read-only connections to one file. Thread-safe.
class ReaderPool {
 public:
  ReaderPool(const std::filesystem::path& file, unsigned connections);

  /// Runs `f` on a connection, inside one read transaction; waits while all are in use.
  void read(const std::function<void(Database&)>& f);

 private:
  std::unique_ptr<Database> take();
  void give_back(std::unique_ptr<Database> connection);

  std::mutex mutex_;
  std::condition_variable returned_;
  std::vector<std::unique_ptr<Database>> idle_;
};

}  // namespace raywatch
