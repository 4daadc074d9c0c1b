#include "tests/api/event_listener.hpp"

#include <arpa/inet.h>
#include <doctest/doctest.h>
#include <netinet/in.h>
#include <unistd.h>

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
    received_.append(piece.data(), static_cast<std::size_t>(size));
  }
  const std::size_t end = received_.find('\n');
  std::string line = received_.substr(0, end);
  received_.erase(0, end + 1);
  return line;
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
