#include "api/connection.hpp"

#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

namespace raywatch {
namespace {

using std::chrono::milliseconds;

bool is_temporary(int error) { return error == EINTR || error == EAGAIN || error == EWOULDBLOCK; }

void address_of(const sockaddr_storage& address, socklen_t length, std::string& ip, int& port) {
  std::array<char, NI_MAXHOST> host{};
  std::array<char, NI_MAXSERV> service{};
  const auto* generic = reinterpret_cast<const sockaddr*>(&address);
  if (::getnameinfo(generic, length, host.data(), host.size(), service.data(), service.size(),
                    NI_NUMERICHOST | NI_NUMERICSERV) == 0) {
    ip = host.data();
    port = std::atoi(service.data());
  }
}

}  // namespace

Connection::Connection(socket_t socket, int stop_event, const ClientLimits& limits)
    : socket_(socket), stop_event_(stop_event), limits_(limits) {}

Connection::~Connection() { ::close(socket_); }

void Connection::discard_rest() {
  ::shutdown(socket_, SHUT_WR);
  constexpr std::size_t max_bytes = 16 << 20;
  const Clock::time_point give_up = Clock::now() + milliseconds(1000);
  for (std::size_t discarded = 0; discarded < max_bytes;) {
    const auto left = std::chrono::duration_cast<milliseconds>(give_up - Clock::now());
    std::array<pollfd, 2> events{pollfd{socket_, POLLIN, 0}, pollfd{stop_event_, POLLIN, 0}};
    if (left.count() <= 0 || ::poll(events.data(), events.size(), static_cast<int>(left.count())) <= 0) return;
    if (events[1].revents != 0) return;
    const ssize_t count = ::recv(socket_, buffer_.data(), buffer_.size(), MSG_DONTWAIT);
    if (count <= 0) return;
    discarded += static_cast<std::size_t>(count);
  }
}

bool Connection::wait_for_request() {
  if (begin_ < end_) return true;  // the client sent the next request behind the last one
  std::array<pollfd, 2> events{pollfd{socket_, POLLIN, 0}, pollfd{stop_event_, POLLIN, 0}};
  const int ready = ::poll(events.data(), events.size(), static_cast<int>(limits_.idle.count()));
  return ready > 0 && events[1].revents == 0 && !peer_is_gone();
}

void Connection::begin_head() {
  in_head_ = true;
  received_ = {};
}

void Connection::begin_body() {
  in_head_ = false;
  received_ = {};
  sent_ = {};
}

bool Connection::peer_is_gone() const {
  char byte = 0;
  const ssize_t count = ::recv(socket_, &byte, 1, MSG_PEEK | MSG_DONTWAIT);
  return count == 0 || (count < 0 && !is_temporary(errno));
}

void Connection::abort() const { ::shutdown(socket_, SHUT_RDWR); }

milliseconds Connection::patience(const Meter& meter) const {
  const auto waited = std::chrono::duration_cast<milliseconds>(meter.waited);
  if (in_head_) return limits_.stall - waited;
  const auto earned = milliseconds(1000 * meter.bytes / std::max<std::uint64_t>(1, limits_.min_bytes_per_s));
  return std::min(limits_.stall, limits_.stall + earned - waited);
}

bool Connection::wait_for(short event, Meter& meter) const {
  for (;;) {
    const milliseconds left = patience(meter);
    if (left.count() <= 0) return false;
    pollfd events{socket_, event, 0};
    const Clock::time_point start = Clock::now();
    const int ready = ::poll(&events, 1, static_cast<int>(left.count()));
    meter.waited += Clock::now() - start;
    if (ready > 0) return true;
    // That was all the patience there is: what a client earned by being quick is none for taking nothing at all.
    if (ready == 0 || errno != EINTR) return false;
  }
}

bool Connection::is_readable() const { return begin_ < end_ || wait_for(POLLIN, received_); }

// The library asks this before each piece of a streamed answer.
bool Connection::is_writable() const { return true; }

bool Connection::fill() {
  for (;;) {
    if (in_head_ && received_.bytes > limits_.max_head_bytes) return false;
    if (!wait_for(POLLIN, received_)) return false;
    const ssize_t count = ::recv(socket_, buffer_.data(), buffer_.size(), MSG_DONTWAIT);
    if (count < 0 && is_temporary(errno)) continue;
    if (count <= 0) return false;
    begin_ = 0;
    end_ = static_cast<std::size_t>(count);
    return true;
  }
}

ssize_t Connection::read(char* bytes, size_t size) {
  if (begin_ == end_ && !fill()) return -1;
  if (in_head_ && received_.bytes > limits_.max_head_bytes) return -1;
  const std::size_t count = std::min(size, end_ - begin_);
  std::memcpy(bytes, buffer_.data() + begin_, count);
  begin_ += count;
  received_.bytes += count;
  return static_cast<ssize_t>(count);
}

ssize_t Connection::write(const char* bytes, size_t size) {
  for (;;) {
    const ssize_t count = ::send(socket_, bytes, size, MSG_DONTWAIT | MSG_NOSIGNAL);
    if (count >= 0) {
      sent_.bytes += static_cast<std::uint64_t>(count);
      return count;
    }
    if (!is_temporary(errno) || !wait_for(POLLOUT, sent_)) return -1;
  }
}

void Connection::get_remote_ip_and_port(std::string& ip, int& port) const {
  sockaddr_storage address{};
  socklen_t length = sizeof(address);
  if (::getpeername(socket_, reinterpret_cast<sockaddr*>(&address), &length) == 0)
    address_of(address, length, ip, port);
}

void Connection::get_local_ip_and_port(std::string& ip, int& port) const {
  sockaddr_storage address{};
  socklen_t length = sizeof(address);
  if (::getsockname(socket_, reinterpret_cast<sockaddr*>(&address), &length) == 0)
    address_of(address, length, ip, port);
}

}  // namespace raywatch
