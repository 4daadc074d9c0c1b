#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <stop_token>
#include <thread>

namespace raywatch {

/// The one thread that does every commit and every checkpoint of a store. It owns all connections that write.
///
/// Why one: SQLite releases before 3.51 can lose committed pages when two connections of one file commit and checkpoint
/// at the same moment (the WAL-reset race). With one thread that cannot happen.
class WriterThread {
 public:
  WriterThread();
  /// Finishes the work that was handed over.
  ~WriterThread();

  /// Runs `work` on the thread and waits for its end; what it throws comes out here. Work runs in the order in which it
  /// was handed over. Must not be called from inside `work` (std::logic_error).
  void run(const std::function<void()>& work);

 private:
  struct Item;
  void serve(const std::stop_token& stop);

  std::mutex mutex_;
  std::condition_variable_any arrived_;
  std::condition_variable finished_;
  std::deque<Item*> queue_;
  std::jthread thread_;  // last: it uses all of the above
};

}  // namespace raywatch
