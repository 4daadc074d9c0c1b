#include "server/survey_thread.hpp"

#include <spdlog/spdlog.h>

#include "core/error.hpp"

namespace raywatch {

SurveyThread::SurveyThread(ScheduleClock& clock, SurveyRunner& runner, unsigned threads, std::function<Time()> now)
    : clock_(clock),
      runner_(runner),
      threads_(threads),
      now_(std::move(now)),
      thread_([this](const std::stop_token& stop) { work(stop); }) {}

void SurveyThread::request_stop() { thread_.request_stop(); }

bool SurveyThread::wait_stopped(std::chrono::steady_clock::time_point deadline) {
  std::unique_lock lock(mutex_);
  return changed_.wait_until(lock, deadline, [&] { return ended_; });
}

void SurveyThread::work(const std::stop_token& stop) {
  tbb::task_arena arena(static_cast<int>(threads_));
  while (!stop.stop_requested()) {
    if (turn(arena, stop)) continue;
    std::unique_lock lock(mutex_);
    changed_.wait_for(lock, stop, std::chrono::seconds(1), [] { return false; });
  }
  const std::lock_guard lock(mutex_);
  ended_ = true;
  changed_.notify_all();
}

/// Whether there may be more to do at once.
bool SurveyThread::turn(tbb::task_arena& arena, const std::stop_token& stop) {
  try {
    clock_.look(now_());
    const bool did = runner_.run_next(arena, stop);
    trouble_.clear();
    return did;
  } catch (const std::exception& error) {
    if (trouble_ != error.what()) spdlog::error("surveys cannot go on: {}", error.what());
    trouble_ = error.what();
    return false;
  }
}

}  // namespace raywatch
