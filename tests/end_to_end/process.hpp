#pragma once

#include <sys/types.h>

#include <string>
#include <vector>

namespace raywatch::test {

/// How a program ended, and what it said.
struct Ended {
  int exit_code = -1;  ///< 128 + the signal, when it was killed by one
  std::string out, err;
};

/// Starts the program with the given arguments; its output goes to these file descriptors.
/// @throws std::runtime_error when it cannot be started.
pid_t spawn_raywatch(const std::vector<std::string>& arguments, int out, int err);

/// Waits for the end of a process. @returns its exit code, or 128 + the signal that ended it.
int wait_for_end(pid_t process);

/// Runs the program to its end.
Ended run_raywatch(const std::vector<std::string>& arguments);

}  // namespace raywatch::test
