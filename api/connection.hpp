#pragma once

// Internal: only .cpp files of api/ include this.
#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <string>

#include "api/httplib.hpp"

namespace raywatch {

/// What a client may cost.
struct ClientLimits {
  std::chrono::milliseconds idle{5'000};    ///< an open connection without a request is kept this long
  std::chrono::milliseconds stall{10'000};  ///< a client that sends or takes nothing for this long is dropped; the head
                                            ///< of a request must have come in this time altogether
  std::uint64_t min_bytes_per_s = 4096;     ///< a client that is slower, after `stall`, is dropped
  std::size_t max_head_bytes = 64 << 10;    ///< request line and headers
};

/// A client's connection, which the HTTP library reads and writes through this class.
///
/// The library's own stream has a time limit for each read, so a client that sends one byte now and then holds a thread
/// for ever; and it closes a connection with unread data at once, which destroys an answer that is on its way.
class Connection final : public httplib::Stream {
 public:
  /// Takes the socket over. `stop_event` becomes readable when the server stops.
  Connection(socket_t socket, int stop_event, const ClientLimits& limits);
  ~Connection() override;
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;

  /// False when no request comes: the client is silent or gone, or the server stops.
  bool wait_for_request();
  void begin_head();  ///< from here the limits of the head apply,
  void begin_body();  ///< and from here those of the content.
  bool peer_is_gone() const;
  /// Ends the sending side, then takes what the client still sends and throws it away, within bounds. A socket that is
  /// closed with unread data resets the connection, and the client may lose the answer.
  void discard_rest();
  /// Ends both directions, for a thread that waits in a read or write; any thread may call it.
  void abort() const;

  bool is_readable() const override;
  bool is_writable() const override;
  ssize_t read(char* bytes, size_t size) override;
  ssize_t write(const char* bytes, size_t size) override;
  void get_remote_ip_and_port(std::string& ip, int& port) const override;
  void get_local_ip_and_port(std::string& ip, int& port) const override;
  socket_t socket() const override { return socket_; }

 private:
  using Clock = std::chrono::steady_clock;
  /// How long the client let this side wait, and for how much.
  struct Meter {
    Clock::duration waited{};
    std::uint64_t bytes = 0;
  };
  bool wait_for(short event, Meter& meter) const;
  std::chrono::milliseconds patience(const Meter& meter) const;
  bool fill();

  socket_t socket_;
  int stop_event_;
  ClientLimits limits_;
  bool in_head_ = true;
  mutable Meter received_;  ///< `is_readable` waits, too
  Meter sent_;
  std::array<char, 64 << 10> buffer_;
  std::size_t begin_ = 0, end_ = 0;
};

}  // namespace raywatch
