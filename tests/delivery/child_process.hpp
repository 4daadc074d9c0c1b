#pragma once

#include <sys/types.h>

#include <condition_variable>
#include <deque>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

namespace raywatch::test {

/// A program that runs beside a test, and is killed when this ends.
class ChildProcess {
 public:
  /// @param command the program's path and its arguments. @throws std::runtime_error when it cannot be started.
  explicit ChildProcess(std::vector<std::string> command);
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  /// Waits for the next line of its output. @throws std::runtime_error when it ends, or says nothing for too long.
  std::string next_line();

 private:
  void read_lines(int descriptor);

  pid_t process_ = -1;
  std::mutex mutex_;
  std::condition_variable grown_;
  std::deque<std::string> lines_;
  bool has_ended_ = false;
  std::jthread reader_;  // last: it uses all of the above
};

/// A port of loopback on which nobody listens.
int free_port();
/// Waits until somebody listens on a port of loopback. @throws std::runtime_error when nobody does for too long.
void wait_for_listener(int port);

}  // namespace raywatch::test
