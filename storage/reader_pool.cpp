#include "storage/reader_pool.hpp"

#include <algorithm>

namespace raywatch {

ReaderPool::ReaderPool(const std::filesystem::path& file, unsigned connections) {
  for (unsigned i = 0; i < std::max(connections, 1u); ++i) {
    idle_.push_back(std::make_unique<Database>(file, Database::Access::read_only));
  }
}

void ReaderPool::read(const std::function<void(Database&)>& f) {
  std::unique_ptr<Database> connection = take();
  try {
    connection->read_consistently([&] { f(*connection); });
  } catch (...) {
    give_back(std::move(connection));
    throw;
  }
  give_back(std::move(connection));
}

std::unique_ptr<Database> ReaderPool::take() {
  std::unique_lock lock(mutex_);
  returned_.wait(lock, [&] { return !idle_.empty(); });
  std::unique_ptr<Database> connection = std::move(idle_.back());
  idle_.pop_back();
  return connection;
}

void ReaderPool::give_back(std::unique_ptr<Database> connection) {
  {
    const std::lock_guard lock(mutex_);
    idle_.push_back(std::move(connection));
  }
  returned_.notify_one();
}

}  // namespace raywatch
