#include "server/delivery/mqtt_connection.hpp"

#include <mosquitto.h>

#include <functional>

#include "core/error.hpp"
#include "server/delivery/transfer.hpp"

namespace raywatch {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int kKeepalive_s = 60, kSlice_ms = 100, kQos = 1;
constexpr const char* kOffline = "offline";

struct Free {
  void operator()(mosquitto* client) const { mosquitto_destroy(client); }
};

}  // namespace

struct MqttConnection::Impl {
  Impl(const MqttSettings& settings_, const SenderConfig& config_) : settings(settings_), config(config_) {}

  void prepare(const std::string& will_topic);
  std::string wait_for(const std::function<bool()>& done, const std::stop_token& stop, const char* what);
  void loop(int timeout_ms) {
    const int code = mosquitto_loop(client.get(), timeout_ms, 1);
    if (code != MOSQ_ERR_SUCCESS) lose(mosquitto_strerror(code));
  }
  void lose(const char* why) {
    open = false;
    lost = true;
    if (trouble.empty()) trouble = why;
  }

  MqttSettings settings;
  SenderConfig config;
  std::unique_ptr<mosquitto, Free> client;
  std::optional<int> answer;
  bool open = false, lost = false;
  std::string trouble;
  int acknowledged = 0;  ///< the last message
};

void MqttConnection::Impl::prepare(const std::string& will_topic) {
  // Without a name the broker gives it one, so that two of the same settings do not throw each other out.
  client.reset(mosquitto_new(nullptr, true, this));
  if (!client) throw Error("libmosquitto cannot be used");
  if (!settings.user.empty()) {
    mosquitto_username_pw_set(client.get(), settings.user.c_str(), settings.password.c_str());
  }
  if (settings.tls) {
    const bool own = !config.ca_file.empty();
    const int code = mosquitto_tls_set(client.get(), own ? config.ca_file.c_str() : nullptr,
                                       own ? nullptr : "/etc/ssl/certs", nullptr, nullptr, nullptr);
    if (code != MOSQ_ERR_SUCCESS) throw Error(std::string("MQTT cannot use TLS: ") + mosquitto_strerror(code));
  }
  if (!will_topic.empty()) {
    mosquitto_will_set(client.get(), will_topic.c_str(), static_cast<int>(std::string_view(kOffline).size()), kOffline,
                       kQos, true);
  }
  mosquitto_connect_callback_set(client.get(), [](mosquitto*, void* self, int code) {
    Impl& impl = *static_cast<Impl*>(self);
    impl.answer = code;
    impl.open = code == 0;
    if (code != 0) impl.lose(mosquitto_connack_string(code));
  });
  mosquitto_publish_callback_set(
      client.get(), [](mosquitto*, void* self, int message) { static_cast<Impl*>(self)->acknowledged = message; });
  mosquitto_disconnect_callback_set(client.get(), [](mosquitto*, void* self, int) {
    static_cast<Impl*>(self)->lose("the broker closed the connection");
  });
}

std::string MqttConnection::Impl::wait_for(const std::function<bool()>& done, const std::stop_token& stop,
                                           const char* what) {
  const auto deadline = Clock::now() + config.timeout;
  while (!done()) {
    if (lost) return trouble;
    if (stop.stop_requested()) return "interrupted";
    if (Clock::now() >= deadline) return std::string("the broker did not ") + what + " in time";
    loop(kSlice_ms);
  }
  return {};
}

MqttConnection::MqttConnection(const MqttSettings& settings, const SenderConfig& config, const std::string& will_topic)
    : impl_(std::make_unique<Impl>(settings, config)) {
  impl_->prepare(will_topic);
}

MqttConnection::~MqttConnection() {
  if (!impl_->open) return;
  mosquitto_disconnect(impl_->client.get());
  impl_->loop(0);
}

std::string MqttConnection::open(const std::stop_token& stop) {
  const MqttSettings& settings = impl_->settings;
  // libmosquitto waits for as long as the system does when nobody answers: see first, with our own timeout.
  const std::string host = settings.host.find(':') == std::string::npos ? settings.host : "[" + settings.host + "]";
  SenderConfig direct = impl_->config;
  direct.proxy.clear();
  Transfer probe("http://" + host + ":" + std::to_string(settings.port), "http", direct);
  probe.only_connect();
  if (const TransferEnd end = probe.run(stop); !end.complete) return end.interrupted ? "interrupted" : end.error;
  const int code = mosquitto_connect(impl_->client.get(), settings.host.c_str(), settings.port, kKeepalive_s);
  if (code != MOSQ_ERR_SUCCESS) return mosquitto_strerror(code);
  return impl_->wait_for([this] { return impl_->open; }, stop, "answer");
}

std::string MqttConnection::publish(const std::string& topic, const std::string& payload, bool retained,
                                    const std::stop_token& stop) {
  int message = 0;
  const int code = mosquitto_publish(impl_->client.get(), &message, topic.c_str(), static_cast<int>(payload.size()),
                                     payload.data(), kQos, retained);
  if (code != MOSQ_ERR_SUCCESS) return mosquitto_strerror(code);
  return impl_->wait_for([this, message] { return impl_->acknowledged == message; }, stop, "acknowledge the message");
}

void MqttConnection::tend() { impl_->loop(0); }
bool MqttConnection::is_open() const { return impl_->open; }
std::optional<int> MqttConnection::answer() const { return impl_->answer; }

MqttLibrary::MqttLibrary() {
  if (mosquitto_lib_init() != MOSQ_ERR_SUCCESS) throw Error("libmosquitto cannot be used");
}
MqttLibrary::~MqttLibrary() { mosquitto_lib_cleanup(); }

}  // namespace raywatch
