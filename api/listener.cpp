#include "api/listener.hpp"

#include <sys/eventfd.h>
#include <sys/socket.h>
#include <unistd.h>

#include <utility>

#include "api/problem.hpp"

namespace raywatch {
namespace {

constexpr int kBacklog = 128;
constexpr std::size_t kMaxRequestsPerConnection = 10'000;

/// The library's pool of threads, which also knows how many connections wait for one.
class CountingPool final : public httplib::TaskQueue {
 public:
  CountingPool(std::size_t threads, std::atomic<int>& waiting) : pool_(threads), waiting_(waiting) {}

  void enqueue(std::function<void()> task) override {
    ++waiting_;
    pool_.enqueue([this, work = std::move(task)] {
      --waiting_;
      work();
    });
  }
  void shutdown() override { pool_.shutdown(); }

 private:
  httplib::ThreadPool pool_;
  std::atomic<int>& waiting_;
};

// The library's default is SO_REUSEPORT, with which two daemons would share one port without a word.
void set_socket_options(socket_t socket) {
  const int yes = 1;
  ::setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof(yes));
}

}  // namespace

/// A connection while a thread serves it.
class Listener::Served {
 public:
  Served(Listener& listener, socket_t socket)
      : connection(socket, listener.stop_event_, listener.limits_), listener_(listener) {
    const std::lock_guard lock(listener_.mutex_);
    listener_.served_[std::this_thread::get_id()] = this;
  }
  ~Served() {
    const std::lock_guard lock(listener_.mutex_);
    listener_.served_.erase(std::this_thread::get_id());
    listener_.changed_.notify_all();
  }
  Served(const Served&) = delete;
  Served& operator=(const Served&) = delete;

  Connection connection;
  bool keep = true;  ///< the last request was read to its end

 private:
  Listener& listener_;
};

Listener::Listener(std::size_t threads, const ClientLimits& limits, Handlers handlers)
    : threads_(threads), limits_(limits), handlers_(std::move(handlers)), stop_event_(::eventfd(0, EFD_CLOEXEC)) {
  // The library asks for its queue when it is about to accept connections.
  new_task_queue = [this] {
    serving_.count_down();
    return new CountingPool(threads_, waiting_);
  };
  set_tcp_nodelay(true);
  set_socket_options(raywatch::set_socket_options);
  install_handlers();
}

Listener::~Listener() {
  if (bound_) {
    const socket_t socket = svr_sock_.exchange(INVALID_SOCKET);
    if (socket != INVALID_SOCKET) ::close(socket);
  }
  ::close(stop_event_);
}

// The library matches routes with regular expressions, whose recursion a long path could exhaust, so `prepare` gives
// every request the same path and `handle` looks at the target itself.
void Listener::install_handlers() {
  const auto without_content = [this](const httplib::Request& request, httplib::Response& response) {
    handlers_.handle(request, response, nullptr);
  };
  const auto with_content = [this](const httplib::Request& request, httplib::Response& response,
                                   const httplib::ContentReader& reader) {
    handlers_.handle(request, response, &reader);
  };
  Get("/", without_content);
  Options("/", without_content);
  Post("/", with_content);
  Put("/", with_content);
  Patch("/", with_content);
  Delete("/", with_content);
  set_pre_routing_handler([without_content](const httplib::Request& request, httplib::Response& response) {
    const bool has_route = request.method != "CONNECT" && request.method != "TRACE" && request.method != "PRI";
    if (has_route) return HandlerResponse::Unhandled;
    without_content(request, response);
    return HandlerResponse::Handled;
  });
  set_expect_100_continue_handler([this](const httplib::Request& request, httplib::Response& response) {
    handlers_.refuse_early(request, response);
    return response.status < 0 ? 100 : response.status;
  });
  // Called for every answer from 400 up; those without content are the library's own.
  const HandlerWithResponse explain = [](const httplib::Request&, httplib::Response& response) {
    if (response.has_header("Content-Type")) return HandlerResponse::Unhandled;
    const HttpAnswer answer = to_answer(problem_of_status(response.status));
    response.set_content(answer.body, answer.content_type);
    return HandlerResponse::Handled;
  };
  set_error_handler(explain);
}

std::optional<std::uint16_t> Listener::bind(const std::string& host, std::uint16_t port) {
  const int bound_port = port == 0 ? bind_to_any_port(host) : (bind_to_port(host, port) ? port : -1);
  if (bound_port <= 0) return std::nullopt;
  bound_ = true;
  ::listen(svr_sock_, kBacklog);  // the library asks for 5
  return static_cast<std::uint16_t>(bound_port);
}

void Listener::serve() { listen_after_bind(); }

void Listener::wait_until_serving() { serving_.wait(); }

void Listener::shut_down() {
  stopping_ = true;
  const std::uint64_t one = 1;
  if (::write(stop_event_, &one, sizeof(one)) < 0) return;  // cannot happen: the counter is far from its limit
  stop();
  std::unique_lock lock(mutex_);
  changed_.wait_for(lock, kGrace, [this] { return served_.empty(); });
  for (const auto& [thread, served] : served_) served->connection.abort();
}

Connection& Listener::current_connection() {
  const std::lock_guard lock(mutex_);
  return served_.at(std::this_thread::get_id())->connection;
}

void Listener::keep_current_connection() {
  const std::lock_guard lock(mutex_);
  served_.at(std::this_thread::get_id())->keep = true;
}

bool Listener::process_and_close_socket(socket_t socket) {
  Served served(*this, socket);
  for (std::size_t count = 1; served.connection.wait_for_request(); ++count) {
    const bool last = stopping_ || waiting_ > 0 || count == kMaxRequestsPerConnection;
    if (!serve_request(served, last)) break;
  }
  if (!served.keep) served.connection.discard_rest();
  return true;
}

/// @returns whether the connection can take another request.
bool Listener::serve_request(Served& served, bool last) {
  served.keep = false;
  served.connection.begin_head();
  bool closed_by_client = false;
  const bool answered = process_request(served.connection, last, closed_by_client,
                                        [&](httplib::Request& request) { prepare(request, served.connection); });
  return answered && served.keep && !closed_by_client && !last;
}

void Listener::prepare(httplib::Request& request, Connection& connection) const {
  connection.begin_body();
  request.path = "/";
  request.params.clear();
  // Ranges and compressing are left out: both may be, and the library would hold and compress a large answer as a whole
  // before its first byte. What lies there compressed already can still be asked for.
  request.ranges.clear();
  request.headers.erase("Range");
  request.headers.erase(kAcceptEncoding);
  if (request.has_header("Accept-Encoding")) {
    request.headers.emplace(kAcceptEncoding, request.get_header_value("Accept-Encoding"));
    request.headers.erase("Accept-Encoding");
  }
}

}  // namespace raywatch
