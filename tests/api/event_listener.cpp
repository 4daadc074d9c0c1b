#include "tests/api/event_listener.hpp"

#include <arpa/inet.h>
#include <doctest/doctest.h>
#include <netinet/in.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <stdexcept>

namespace raywatch::testing {

EventListener::EventListener(std::uint16_t port, const std::string& query, const std::string& last_event_id) {
  socket_ = ::socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(port);
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  if (::connect(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0) {
    throw std::runtime_error("no connection");
  }
  const timeval patience{.tv_sec = 20, .tv_usec = 0};
  ::setsockopt(socket_, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
  std::string request = "GET /api/v1/events" + query + " HTTP/1.1\r\nHost: localhost\r\nAccept: text/event-stream\r\n";
  if (!last_event_id.empty()) request += "Last-Event-ID: " + last_event_id + "\r\n";
  request += "\r\n";
  if (::send(socket_, request.data(), request.size(), 0) != static_cast<ssize_t>(request.size())) {
    throw std::runtime_error("nothing can be sent");
  }
  while (!line().starts_with(": from event")) {
  }
}

EventListener::~EventListener() { ::close(socket_); }

std::string EventListener::line() {
  for (std::size_t end = 0; (end = received_.find('\n')) == std::string::npos;) {
    std::array<char, 4096> piece{};
    const ssize_t size = ::recv(socket_, piece.data(), piece.size(), 0);
    if (size <= 0) throw std::runtime_error("the stream ended, or nothing came:\n" + received_);
    raw_.append(piece.data(), static_cast<std::size_t>(size));
    take_out_of_chunks();
  }
  const std::size_t end = received_.find('\n');
  std::string line = received_.substr(0, end);
  received_.erase(0, end + 1);
  return line;
}

void EventListener::take_out_of_chunks() {
  if (const std::size_t end = raw_.find("\r\n\r\n"); in_head_ && end != std::string::npos) {
    raw_.erase(0, end + 2);
    in_head_ = false;
  }
  while (!in_head_) {
    if (left_in_chunk_ == 0) {
      // The line break behind the last chunk, or the head, and the length of the next.
      const std::size_t end = raw_.find("\r\n", 2);
      if (end == std::string::npos) return;
      left_in_chunk_ = std::stoul(raw_.substr(2, end - 2), nullptr, 16);
      raw_.erase(0, end + 2);
      if (left_in_chunk_ == 0) return;
    }
    const std::size_t size = std::min(left_in_chunk_, raw_.size());
    received_.append(raw_, 0, size);
    raw_.erase(0, size);
    left_in_chunk_ -= size;
    if (left_in_chunk_ > 0) return;
  }
}

nlohmann::json EventListener::take(std::size_t count) {
  nlohmann::json events = nlohmann::json::array();
  std::string id, type;
  while (events.size() < count) {
    const std::string text = line();
    if (text.starts_with("id: ")) id = text.substr(4);
    if (text.starts_with("event: ")) type = text.substr(7);
    if (!text.starts_with("data: ")) continue;
    const nlohmann::json event = nlohmann::json::parse(text.substr(6));
    CHECK_EQ(event["id"].dump(), id);
    CHECK_EQ(event["type"], type);
    events.push_back(event);
  }
  return events;
}

}  // namespace raywatch::testing
