#pragma once

#include <sys/socket.h>

#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>

namespace raywatch::testing {

/// A client of the stream of events, as a browser is one. The stream stands when the constructor returns.
class EventListener {
 public:
  EventListener(std::uint16_t port, const std::string& query, const std::string& last_event_id = "");
  ~EventListener();
  EventListener(const EventListener&) = delete;
  EventListener& operator=(const EventListener&) = delete;

  /// Waits for so many events. @returns what they say, each checked to be of the id and type that stand beside it.
  nlohmann::json take(std::size_t count);

 private:
  /// The next line of the stream.
  std::string line();
  /// HTTP sends the stream in chunks, which end anywhere.
  void take_out_of_chunks();

  int socket_ = -1;
  std::string raw_;
  bool in_head_ = true;
  std::size_t left_in_chunk_ = 0;
  std::string received_;
};

}  // namespace raywatch::testing
