#pragma once

#include <chrono>
#include <cstdint>
#include <string>
#include <string_view>

namespace raywatch::testing {

/// A client that sends bytes as they are, for what no HTTP library would send.
class RawClient {
 public:
  explicit RawClient(std::uint16_t port);
  ~RawClient();
  RawClient(const RawClient&) = delete;
  RawClient& operator=(const RawClient&) = delete;

  /// @returns false when the server has closed the connection.
  bool send(std::string_view bytes) const;
  void end_sending() const;
  /// Ends the connection at once, with a reset.
  void vanish();
  /// All that comes until the server closes the connection, or `patience` is over.
  std::string receive_all(std::chrono::seconds patience = std::chrono::seconds(20)) const;
  /// What comes until `end` has come.
  std::string receive_until(std::string_view end) const;

 private:
  int socket_;
};

/// The status of an HTTP answer; 0 when it is none.
int status_of(std::string_view answer);

}  // namespace raywatch::testing
