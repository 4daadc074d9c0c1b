#include "tests/end_to_end/daemon_process.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <stdexcept>
#include <utility>

#include "tests/end_to_end/process.hpp"

namespace raywatch::test {

DaemonProcess::DaemonProcess(const std::filesystem::path& data_dir, const std::vector<std::string>& more_arguments,
                             const std::string& listen) {
  std::array<int, 2> pipe{};
  if (::pipe2(pipe.data(), O_CLOEXEC) != 0) throw std::runtime_error("no pipe");
  std::vector<std::string> arguments = {"serve", "--data-dir", data_dir.string(), "--listen", listen};
  arguments.insert(arguments.end(), more_arguments.begin(), more_arguments.end());
  process_ = spawn_raywatch(arguments, pipe[1], pipe[1]);
  ::close(pipe[1]);
  reader_ = std::jthread([this, descriptor = pipe[0]] { read_log(descriptor); });
  wait_until_it_listens();
}

DaemonProcess::~DaemonProcess() {
  if (process_ > 0) kill();
}

std::string DaemonProcess::log() const {
  const std::lock_guard lock(mutex_);
  return log_;
}

int DaemonProcess::stop() { return end_by(SIGTERM); }

void DaemonProcess::kill() { end_by(SIGKILL); }

int DaemonProcess::end_by(int signal) {
  ::kill(process_, signal);
  return wait_for_end(std::exchange(process_, -1));
}

void DaemonProcess::read_log(int descriptor) {
  std::array<char, 4096> piece{};
  for (ssize_t size = 0; (size = ::read(descriptor, piece.data(), piece.size())) > 0;) {
    const std::lock_guard lock(mutex_);
    log_.append(piece.data(), static_cast<std::size_t>(size));
    grown_.notify_all();
  }
  ::close(descriptor);
  const std::lock_guard lock(mutex_);
  log_ended_ = true;
  grown_.notify_all();
}

void DaemonProcess::wait_until_it_listens() {
  static const std::string kSaid = "listening on ";
  std::unique_lock lock(mutex_);
  const auto end_of_url = [&] {
    const std::size_t begin = log_.find(kSaid);
    return begin == std::string::npos ? begin : log_.find(',', begin);
  };
  grown_.wait(lock, [&] { return log_ended_ || end_of_url() != std::string::npos; });
  const std::size_t end = end_of_url();
  if (end == std::string::npos) {
    const std::string log = log_;
    lock.unlock();
    wait_for_end(std::exchange(process_, -1));
    throw std::runtime_error("the daemon did not start:\n" + log);
  }
  const std::size_t begin = log_.find(kSaid) + kSaid.size();
  url_ = log_.substr(begin, end - begin);
}

}  // namespace raywatch::test
