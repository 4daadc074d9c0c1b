#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <map>
#include <mutex>
#include <optional>
#include <stop_token>
#include <thread>
#include <vector>

#include "core/ids.hpp"
#include "server/comparison_runner.hpp"
#include "storage/comparisons.hpp"
#include "storage/signal.hpp"
#include "storage/store.hpp"

namespace raywatch {

struct WorkersConfig {
  unsigned workers = 1;          ///< jobs at once
  unsigned compare_threads = 1;  ///< threads of one comparison
};

struct WorkersStatus {
  unsigned alive = 0, expected = 0;
  std::uint64_t finished = 0, failed = 0;
};

/// The threads that take jobs from the durable queue: those of a site as `start_job` lets them follow one another,
/// sites in parallel and in turn. A job that cannot succeed ends as failed; one that met passing trouble (a full disk)
/// is put back and its site rests for a while.
class Workers {
 public:
  /// A job that was started this often without an end takes the process down with it: it ends as failed.
  static constexpr int kMaxAttempts = 10;

  Workers(Store& store, ComparisonRunner& runner, Signal& signal, const WorkersConfig& config,
          std::function<Time()> now);
  /// Waits for the running comparisons.
  ~Workers();

  WorkersStatus status() const;
  /// No new job is begun from now on.
  void request_stop();
  /// After `request_stop`: true when all ended before the deadline.
  bool wait_stopped(std::chrono::steady_clock::time_point deadline);

 private:
  struct Outcome;

  void work(const std::stop_token& stop);
  std::optional<Job> take_job();
  void run_to_the_end(const Job& job, tbb::task_arena& arena, const std::stop_token& stop);
  Outcome run(const Job& job, tbb::task_arena& arena);
  void settle(const Job& job, const Outcome& outcome, const std::stop_token& stop);

  Store& store_;
  ComparisonRunner& runner_;
  Signal& signal_;
  const WorkersConfig config_;
  const std::function<Time()> now_;

  std::mutex sites_mutex_;
  std::map<SiteId, std::chrono::steady_clock::time_point> resting_until_;
  SiteId last_taken_;

  std::atomic<std::uint64_t> finished_{0}, failed_{0};
  mutable std::mutex alive_mutex_;
  std::condition_variable ended_;
  unsigned alive_ = 0;
  std::vector<std::jthread> threads_;  // last: they use all of the above
};

}  // namespace raywatch
