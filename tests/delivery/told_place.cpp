#include "tests/delivery/told_place.hpp"

#include <algorithm>
#include <stdexcept>

#include "storage/signal.hpp"

namespace raywatch::test {

DeliveryConfig ToldPlace::quick() {
  DeliveryConfig config;
  config.retry_delays = {std::chrono::milliseconds(20)};
  config.public_url = "https://watch.example.com";
  return config;
}

ToldPlace::ToldPlace(DeliveryConfig config)
    : store_({.data_dir = folder_ / "data", .min_free_bytes = 0}),
      site_(store_.write([](Transaction& transaction) {
        return insert_site(transaction, {.name = "Höfe", .time_zone = "Europe/Berlin"}, now());
      })),
      deliverer_(std::make_unique<Deliverer>(store_, config, now)) {}

/// In the order of the daemon: who waits for a commit hears that there will be none.
ToldPlace::~ToldPlace() {
  deliverer_->request_stop();
  store_.commits().close();
}

ChannelId ToldPlace::add(const std::string& name, const ChannelSettings& settings, ChannelRecord channel) {
  channel.name = name;
  channel.settings = settings;
  channel.by = "anna";
  if (channel.events.empty()) channel.events = {"alert.*"};
  return store_.write([&](Transaction& transaction) { return insert_channel(transaction, channel, now()).id; });
}

AlertId ToldPlace::open_alert(const std::string& title, Severity severity) {
  return store_.write([&](Transaction& transaction) {
    return raywatch::open_alert(
               transaction,
               {.site = site_.id, .subject = title, .title = title, .severity = severity, .opened_at = now()},
               "as a test")
        .id;
  });
}

void ToldPlace::acknowledge(AlertId alert) {
  store_.write([&](Transaction& transaction) {
    change_alert(
        transaction, alert,
        {.action = "acknowledged", .by = "ben", .note = "I go", .at = now(), .state = AlertState::acknowledged});
  });
}

ChannelRecord ToldPlace::channel(ChannelId id) const {
  return store_.read([&](const Snapshot& snapshot) { return find_channel(snapshot, id).value(); });
}

std::vector<DeliveryRecord> ToldPlace::deliveries(ChannelId channel) const {
  auto list = store_.read([&](const Snapshot& snapshot) {
    return list_deliveries(snapshot, {.channel = channel}, {.limit = 1000, .cursor = {}}).items;
  });
  std::ranges::reverse(list);
  return list;
}

std::vector<AlertRecord> ToldPlace::failing_alerts() const {
  auto alerts = store_.read(
      [](const Snapshot& snapshot) { return list_alerts(snapshot, {}, {.limit = 1000, .cursor = {}}).items; });
  std::erase_if(alerts, [](const AlertRecord& alert) { return alert.cause != "delivery-failing"; });
  std::ranges::reverse(alerts);
  return alerts;
}

void ToldPlace::wait_until(const std::function<bool()>& holds) {
  const auto deadline = Signal::Clock::now() + std::chrono::seconds(20);
  while (Signal::Clock::now() < deadline) {
    const std::uint64_t seen = store_.commits().generation();
    if (holds()) return;
    store_.commits().wait_past(seen, Signal::Clock::now() + std::chrono::milliseconds(100));
  }
  throw std::runtime_error("it does not come to that");
}

std::vector<DeliveryRecord> ToldPlace::wait_until_ended(ChannelId channel, std::size_t count) {
  wait_until([&] {
    const auto list = deliveries(channel);
    return list.size() >= count &&
           std::ranges::all_of(list, [](const DeliveryRecord& delivery) { return delivery.ended_at.has_value(); });
  });
  return deliveries(channel);
}

}  // namespace raywatch::test
