#pragma once

#include <sys/types.h>

#include <condition_variable>
#include <filesystem>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

namespace raywatch::test {

/// A running `raywatch serve`, on a free port unless told otherwise. It listens when the constructor returns.
class DaemonProcess {
 public:
  /// @throws std::runtime_error with its log when it ends before it listens.
  explicit DaemonProcess(const std::filesystem::path& data_dir, const std::vector<std::string>& more_arguments = {},
                         const std::string& listen = "127.0.0.1:0");
  /// Kills it if it still runs.
  ~DaemonProcess();
  DaemonProcess(const DaemonProcess&) = delete;
  DaemonProcess& operator=(const DaemonProcess&) = delete;

  const std::string& url() const { return url_; }
  std::string log() const;

  int stop();   ///< SIGTERM; waits. @returns the exit code
  void kill();  ///< SIGKILL; waits

 private:
  void read_log(int descriptor);
  void wait_until_it_listens();
  int end_by(int signal);

  pid_t process_ = -1;
  std::string url_;
  mutable std::mutex mutex_;
  std::condition_variable grown_;
  std::string log_;
  bool log_ended_ = false;
  std::jthread reader_;  // last: it uses the above
};

}  // namespace raywatch::test
