#pragma once

#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <thread>

#include "server/schedule_clock.hpp"
#include "server/survey_runner.hpp"

namespace raywatch {

/// The thread that makes runs when they are due, and carries them out. What lasts of what they throw is logged once,
/// and tried again.
class SurveyThread {
 public:
  /// @param threads of one survey
  SurveyThread(ScheduleClock& clock, SurveyRunner& runner, unsigned threads, std::function<Time()> now);

  /// No new run is begun from now on; the one that is under way is put back after its present step.
  void request_stop();
  /// After `request_stop`: true when it ended before the deadline.
  bool wait_stopped(std::chrono::steady_clock::time_point deadline);

 private:
  void work(const std::stop_token& stop);
  bool turn(tbb::task_arena& arena, const std::stop_token& stop);

  ScheduleClock& clock_;
  SurveyRunner& runner_;
  const unsigned threads_;
  const std::function<Time()> now_;
  std::string trouble_;
  std::mutex mutex_;
  std::condition_variable_any changed_;
  bool ended_ = false;
  std::jthread thread_;  // last: it uses all of the above
};

}  // namespace raywatch
