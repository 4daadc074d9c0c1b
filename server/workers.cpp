#include "server/workers.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <exception>
#include <string>
#include <utility>

#include "core/error.hpp"

namespace raywatch {
namespace {

using Clock = std::chrono::steady_clock;

/// How long a site rests after passing trouble.
constexpr std::chrono::seconds kSiteRest{5};

}  // namespace

/// How a job ended.
struct Workers::Outcome {
  enum class Kind { done, failed, again } kind = Kind::done;
  std::string why = {};
};

Workers::Workers(Store& store, ComparisonRunner& runner, Signal& signal, const WorkersConfig& config,
                 std::function<Time()> now)
    : store_(store), runner_(runner), signal_(signal), config_(config), now_(std::move(now)), alive_(config.workers) {
  for (unsigned i = 0; i < config_.workers; ++i) {
    threads_.emplace_back([this](const std::stop_token& stop) { work(stop); });
  }
}

Workers::~Workers() { request_stop(); }

WorkersStatus Workers::status() const {
  const std::lock_guard lock(alive_mutex_);
  return {.alive = alive_, .expected = config_.workers, .finished = finished_, .failed = failed_};
}

void Workers::request_stop() {
  for (std::jthread& thread : threads_) thread.request_stop();
  signal_.notify();
}

bool Workers::wait_stopped(Clock::time_point deadline) {
  std::unique_lock lock(alive_mutex_);
  return ended_.wait_until(lock, deadline, [&] { return alive_ == 0; });
}

void Workers::work(const std::stop_token& stop) {
  tbb::task_arena arena(static_cast<int>(config_.compare_threads));
  while (!stop.stop_requested()) {
    const std::uint64_t seen = signal_.generation();
    const std::optional<Job> job = take_job();
    if (job) {
      run_to_the_end(*job, arena, stop);
    } else if (!stop.stop_requested()) {
      signal_.wait_past(seen, Clock::now() + kSiteRest);
    }
  }
  const std::lock_guard lock(alive_mutex_);
  --alive_;
  ended_.notify_all();
}

std::optional<Job> Workers::take_job() {
  const std::lock_guard lock(sites_mutex_);
  try {
    std::vector<SiteId> sites = store_.read([](const Snapshot& snapshot) { return sites_with_jobs(snapshot); });
    std::ranges::sort(sites);
    const auto after_last = std::ranges::upper_bound(sites, last_taken_);
    std::rotate(sites.begin(), after_last, sites.end());
    for (const SiteId site : sites) {
      if (Clock::now() < resting_until_[site]) continue;
      std::optional<Job> job = store_.write([&](Transaction& transaction) { return start_job(transaction, site); });
      if (!job) continue;
      last_taken_ = site;
      return job;
    }
  } catch (const Error& error) {
    spdlog::error("no comparison can be started: {}", error.what());
  }
  return std::nullopt;
}

void Workers::run_to_the_end(const Job& job, tbb::task_arena& arena, const std::stop_token& stop) {
  const Outcome outcome = run(job, arena);
  settle(job, outcome, stop);
  signal_.notify();
}

Workers::Outcome Workers::run(const Job& job, tbb::task_arena& arena) {
  using enum Outcome::Kind;
  if (job.attempts > kMaxAttempts)
    return {failed, "it was started " + std::to_string(kMaxAttempts) + " times without an end"};
  try {
    runner_.run(job, arena);
    return {done};
  } catch (const CorruptData& error) {
    return {failed, error.what()};
  } catch (const StorageError& error) {  // a full disk, an I/O error
    return {again, error.what()};
  } catch (const NotFound& error) {  // what it was to use was deleted meanwhile; what is left may do
    return {again, error.what()};
  } catch (const std::exception& error) {
    return {failed, error.what()};
  }
}

/// Writes down how the job ended. That the disk is full is no reason to forget it: it is tried until it works.
void Workers::settle(const Job& job, const Outcome& outcome, const std::stop_token& stop) {
  if (outcome.kind == Outcome::Kind::done) {
    ++finished_;
    return;
  }
  const bool again = outcome.kind == Outcome::Kind::again;
  spdlog::warn("comparison {} of scan {} {}: {}", job.comparison.value, job.scan.value,
               again ? "is put back" : "failed", outcome.why);
  if (again) {
    const std::lock_guard lock(sites_mutex_);
    resting_until_[job.site] = Clock::now() + kSiteRest;
  } else {
    ++failed_;
  }
  const Time now = now_();
  while (!stop.stop_requested()) {
    try {
      return store_.write([&](Transaction& transaction) {
        again ? requeue_job(transaction, job) : fail_job(transaction, job, outcome.why, now);
      });
    } catch (const Error& error) {
      spdlog::error("the end of comparison {} cannot be stored yet: {}", job.comparison.value, error.what());
      signal_.wait_past(signal_.generation(), Clock::now() + kSiteRest);
    }
  }
}

}  // namespace raywatch
