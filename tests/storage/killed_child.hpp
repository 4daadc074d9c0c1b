#pragma once

#include <doctest/doctest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <cstdint>
#include <vector>

namespace raywatch {

/// When a child is killed: after so many reports and, as a busy wait, somewhere before the next.
struct KillMoment {
  int reports = 0;
  std::uint64_t spins = 0;
};

/// Runs `work(pipe)` in a child, which writes a `Report` into the pipe after each durable step and never returns, and
/// kills it. @returns all that it reported.
template <class Report, class Work>
std::vector<Report> reports_until_killed(const Work& work, KillMoment moment) {
  int pipe_ends[2] = {};
  REQUIRE(pipe(pipe_ends) == 0);
  const pid_t child = fork();
  REQUIRE(child >= 0);
  if (child == 0) {
    close(pipe_ends[0]);
    try {
      work(pipe_ends[1]);
    } catch (...) {
    }
    _exit(2);
  }
  close(pipe_ends[1]);
  std::vector<Report> all;
  Report one{};
  const auto read_one = [&] { return read(pipe_ends[0], &one, sizeof one) == sizeof one; };
  while (moment.reports-- > 0 && read_one()) all.push_back(one);
  for (std::uint64_t spin = 0; spin < moment.spins; ++spin) std::atomic_signal_fence(std::memory_order_seq_cst);
  kill(child, SIGKILL);
  while (read_one()) all.push_back(one);
  close(pipe_ends[0]);
  int status = 0;
  REQUIRE(waitpid(child, &status, 0) == child);
  REQUIRE(WIFSIGNALED(status));
  return all;
}

}  // namespace raywatch
