#include "tests/delivery/child_process.hpp"

#include <arpa/inet.h>
#include <fcntl.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <stdexcept>

extern char** environ;

namespace raywatch::test {
namespace {

constexpr std::chrono::seconds kPatience{20};

sockaddr_in loopback(int port) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<std::uint16_t>(port));
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  return address;
}

}  // namespace

ChildProcess::ChildProcess(std::vector<std::string> command) {
  std::array<int, 2> pipe{};
  if (::pipe2(pipe.data(), O_CLOEXEC) != 0) throw std::runtime_error("no pipe");
  std::vector<char*> argv;
  for (std::string& word : command) argv.push_back(word.data());
  argv.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, pipe[1], STDOUT_FILENO);
  const int failed = posix_spawn(&process_, argv[0], &actions, nullptr, argv.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  ::close(pipe[1]);
  if (failed != 0) {
    ::close(pipe[0]);
    throw std::runtime_error("cannot start " + command[0] + ": see scripts/packages.txt");
  }
  reader_ = std::jthread([this, descriptor = pipe[0]] { read_lines(descriptor); });
}

ChildProcess::~ChildProcess() {
  ::kill(process_, SIGKILL);
  int status = 0;
  ::waitpid(process_, &status, 0);
}

void ChildProcess::read_lines(int descriptor) {
  std::FILE* file = ::fdopen(descriptor, "r");
  char* line = nullptr;
  std::size_t room = 0;
  for (ssize_t size = 0; (size = ::getline(&line, &room, file)) > 0;) {
    const std::lock_guard lock(mutex_);
    lines_.emplace_back(line, static_cast<std::size_t>(size));
    if (lines_.back().ends_with('\n')) lines_.back().pop_back();
    grown_.notify_all();
  }
  std::free(line);
  std::fclose(file);
  const std::lock_guard lock(mutex_);
  has_ended_ = true;
  grown_.notify_all();
}

std::string ChildProcess::next_line() {
  std::unique_lock lock(mutex_);
  grown_.wait_for(lock, kPatience, [this] { return has_ended_ || !lines_.empty(); });
  if (lines_.empty()) throw std::runtime_error("a program said nothing");
  std::string line = std::move(lines_.front());
  lines_.pop_front();
  return line;
}

int free_port() {
  const int socket = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  sockaddr_in address = loopback(0);
  socklen_t size = sizeof address;
  if (::bind(socket, reinterpret_cast<sockaddr*>(&address), size) != 0 ||
      ::getsockname(socket, reinterpret_cast<sockaddr*>(&address), &size) != 0) {
    throw std::runtime_error("no free port");
  }
  ::close(socket);
  return ntohs(address.sin_port);
}

void wait_for_listener(int port) {
  const auto deadline = std::chrono::steady_clock::now() + kPatience;
  while (std::chrono::steady_clock::now() < deadline) {
    const int socket = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    const sockaddr_in address = loopback(port);
    const bool there = ::connect(socket, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0;
    ::close(socket);
    if (there) return;
    std::this_thread::yield();
  }
  throw std::runtime_error("nobody listens");
}

}  // namespace raywatch::test
