#include "api/http_server.hpp"

#include <algorithm>
#include <cctype>
#include <string_view>
#include <thread>

#include "api/call.hpp"
#include "api/dashboard.hpp"
#include "api/exchange.hpp"
#include "api/guard.hpp"
#include "api/listener.hpp"
#include "api/stream_slots.hpp"
#include "core/error.hpp"

namespace raywatch {

struct HttpServer::Impl {
  Impl(const HttpConfig& given_config, const Services& given_services)
      : config(given_config),
        services(given_services),
        dashboard(config.dashboard_dir.empty() ? Dashboard{} : Dashboard::read(config.dashboard_dir)),
        streams(std::max<std::size_t>(1, config.threads / 2)),
        listener(
            config.threads, {config.idle_timeout, config.stall_timeout, config.min_client_bytes_per_s},
            {.handle =
                 [this](const httplib::Request& request, httplib::Response& response,
                        const httplib::ContentReader* reader) {
                   answer_request({services, config, dashboard, statistics, streams, listener}, request, response,
                                  reader);
                 },
             .refuse_early = [this](const httplib::Request& request,
                                    httplib::Response& response) { refuse_too_large(config, request, response); }}) {}

  const HttpConfig config;
  const Services services;
  const Dashboard dashboard;
  HttpStatistics statistics;
  StreamSlots streams;
  Listener listener;
  std::uint16_t port = 0;
  std::jthread thread;  // last: it uses all the others
};

std::optional<std::string> complaint_about_host(const HttpConfig& config) {
  const auto fits = [](unsigned char c) {
    return std::isalnum(c) != 0 || std::string_view(".-_:%").find(static_cast<char>(c)) != std::string_view::npos;
  };
  if (config.host.empty() || !std::ranges::all_of(config.host, fits)) return "must be a host's name or address";
  if (config.allow_remote || is_loopback_host(config.host)) return std::nullopt;
  return "is not a loopback address. There are no accounts, so that others are listened on only with "
         "--allow-remote, or allow_remote = true in [http]";
}

HttpServer::HttpServer(const HttpConfig& config, const Services& services)
    : impl_(std::make_unique<Impl>(config, services)) {
  if (const auto complaint = complaint_about_host(config)) {
    throw InvalidInput("The address to listen on, \"" + config.host + "\", " + *complaint + ".",
                       {{"host", *complaint}});
  }
  const auto port = impl_->listener.bind(config.host, config.port);
  if (!port) {
    throw InvalidInput("Cannot listen on " + config.host + ":" + std::to_string(config.port) +
                           ": the address is in use or not this machine's.",
                       {{"host", "cannot be listened on"}});
  }
  impl_->port = *port;
}

HttpServer::~HttpServer() { stop(); }

std::uint16_t HttpServer::port() const { return impl_->port; }

void HttpServer::start() {
  if (impl_->thread.joinable()) return;
  impl_->thread = std::jthread([this] { impl_->listener.serve(); });
  impl_->listener.wait_until_serving();
}

void HttpServer::stop() {
  if (!impl_->thread.joinable()) return;
  impl_->listener.shut_down();
  impl_->thread.join();
}

}  // namespace raywatch
