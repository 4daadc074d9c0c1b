#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <mutex>

namespace raywatch {

/// Says that something happened to whoever waits for it: jobs that were queued or ended, commits. Whoever waits reads
/// the generation first, looks, and then waits for a later one, so that nothing is missed. Thread-safe.
class Signal {
 public:
  using Clock = std::chrono::steady_clock;

  std::uint64_t generation() const;
  void notify();
  /// Waits for a generation later than `seen`. @returns false when the time was over first, or it is closed.
  bool wait_past(std::uint64_t seen, Clock::time_point deadline);
  /// Nobody waits from now on.
  void close();
  bool is_closed() const;

 private:
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::uint64_t generation_ = 0;
  bool closed_ = false;
};

}  // namespace raywatch
