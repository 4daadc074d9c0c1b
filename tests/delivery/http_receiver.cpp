#include "tests/delivery/http_receiver.hpp"

#include <httplib.h>
#undef _res

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <stdexcept>
#include <thread>

namespace raywatch::test {

struct HttpReceiver::Impl {
  void handle(const httplib::Request& request, httplib::Response& response) {
    std::unique_lock lock(mutex);
    const int number = static_cast<int>(requests.size());
    requests.push_back({request.get_header_value("webhook-id"), request.get_header_value("webhook-timestamp"),
                        request.get_header_value("webhook-signature"), request.body});
    changed.notify_all();
    changed.wait(lock, [this] { return !hangs; });
    const GivenAnswer given = answer ? answer(number) : GivenAnswer{};
    response.status = given.status;
    for (const auto& [name, value] : given.headers) response.set_header(name, value);
    response.set_content(given.content, "text/plain");
  }

  std::function<GivenAnswer(int)> answer;
  std::mutex mutex;
  std::condition_variable changed;
  bool hangs = false;
  std::vector<ReceivedRequest> requests;
  int port = 0;
  httplib::Server server;
  std::jthread thread;  // last: it uses all of the above
};

HttpReceiver::HttpReceiver(std::function<GivenAnswer(int)> answer, int port) : impl_(std::make_unique<Impl>()) {
  impl_->answer = std::move(answer);
  impl_->server.Post(
      ".*", [this](const httplib::Request& request, httplib::Response& response) { impl_->handle(request, response); });
  impl_->port = port;
  if (port == 0) {
    impl_->port = impl_->server.bind_to_any_port("127.0.0.1");
  } else if (!impl_->server.bind_to_port("127.0.0.1", port)) {
    throw std::runtime_error("the port is taken");
  }
  impl_->thread = std::jthread([this] { impl_->server.listen_after_bind(); });
  while (!impl_->server.is_running()) std::this_thread::yield();
}

HttpReceiver::~HttpReceiver() {
  {
    const std::lock_guard lock(impl_->mutex);
    impl_->hangs = false;
    impl_->changed.notify_all();
  }
  impl_->server.stop();
}

std::string HttpReceiver::url() const { return "http://127.0.0.1:" + std::to_string(impl_->port) + "/hook"; }
int HttpReceiver::port() const { return impl_->port; }

void HttpReceiver::hang() {
  const std::lock_guard lock(impl_->mutex);
  impl_->hangs = true;
}

std::vector<ReceivedRequest> HttpReceiver::wait_for(std::size_t count) {
  std::unique_lock lock(impl_->mutex);
  if (!impl_->changed.wait_for(lock, std::chrono::seconds(20), [&] { return impl_->requests.size() >= count; })) {
    throw std::runtime_error("only " + std::to_string(impl_->requests.size()) + " requests came");
  }
  return impl_->requests;
}

}  // namespace raywatch::test
