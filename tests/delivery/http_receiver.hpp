#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace raywatch::test {

/// A request that a receiver got.
struct ReceivedRequest {
  std::string id, timestamp, signature, body;
};

struct GivenAnswer {
  int status = 200;
  std::map<std::string, std::string> headers;
  std::string content;
};

/// A real receiver of webhooks on loopback.
class HttpReceiver {
 public:
  /// @param answer to the request of this number, from 0; when not given, all are taken
  explicit HttpReceiver(std::function<GivenAnswer(int)> answer = {}, int port = 0);
  ~HttpReceiver();

  std::string url() const;
  int port() const;
  /// From now on it takes requests and does not answer them, until it ends.
  void hang();
  /// Waits until it got so many. @throws std::runtime_error when they do not come.
  std::vector<ReceivedRequest> wait_for(std::size_t count);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace raywatch::test
