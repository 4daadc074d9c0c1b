#pragma once

// Internal: only .cpp files of api/ include this.
#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <latch>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "api/connection.hpp"
#include "api/httplib.hpp"

namespace raywatch {

/// The HTTP library's server, with connections and an end of its own.
///
/// What is different: every request goes to one handler, which reads its content itself; clients have limits (see
/// `Connection`); idle connections give way when others wait for a thread; `shut_down` does not wait for idle ones.
class Listener final : public httplib::Server {
 public:
  using Handle = std::function<void(const httplib::Request&, httplib::Response&, const httplib::ContentReader*)>;

  /// Decides about a client that asks for leave to send its content ("Expect: 100-continue"): gives an answer, or
  /// leaves `response.status` as it is.
  using Refuse = std::function<void(const httplib::Request&, httplib::Response&)>;

  struct Handlers {
    Handle handle;
    Refuse refuse_early;
  };
  Listener(std::size_t threads, const ClientLimits& limits, Handlers handlers);
  ~Listener() override;

  /// @returns the bound port; nothing when the address cannot be bound. `port` 0 is any free one.
  std::optional<std::uint16_t> bind(const std::string& host, std::uint16_t port);
  void serve();               ///< until `shut_down`
  void wait_until_serving();  ///< for a `serve` on another thread; before that `shut_down` would not be heard
  void shut_down();           ///< from another thread than `serve`'s; requests in progress have `kGrace` to end
  bool is_stopping() const { return stopping_; }

  /// The connection of the request that the calling thread serves.
  Connection& current_connection();
  /// After the request of the calling thread the connection can take another one.
  void keep_current_connection();

  static constexpr std::chrono::milliseconds kGrace{3000};
  /// Under this name requests have what the client sent as Accept-Encoding, which the library must not see.
  static constexpr const char* kAcceptEncoding = ":accept-encoding";

 private:
  class Served;
  bool process_and_close_socket(socket_t socket) override;
  bool serve_request(Served& served, bool last);
  void prepare(httplib::Request& request, Connection& connection) const;
  void install_handlers();

  const std::size_t threads_;
  const ClientLimits limits_;
  const Handlers handlers_;
  const int stop_event_;
  std::atomic<bool> stopping_ = false;
  std::latch serving_{1};
  std::atomic<int> waiting_ = 0;  ///< accepted connections without a thread
  std::mutex mutex_;
  std::condition_variable changed_;
  std::map<std::thread::id, Served*> served_;
  bool bound_ = false;
};

}  // namespace raywatch
