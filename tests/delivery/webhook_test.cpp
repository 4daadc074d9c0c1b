// Webhooks, by a real receiver on loopback.

#include <doctest/doctest.h>

#include <nlohmann/json.hpp>

#include "server/delivery/webhook_signature.hpp"
#include "tests/delivery/http_receiver.hpp"
#include "tests/delivery/told_place.hpp"

namespace raywatch::test {
namespace {

using nlohmann::json;

WebhookSettings hook(const HttpReceiver& receiver) { return {.url = receiver.url(), .secrets = {kSecret}}; }

/// Answers by the number of the request; the last answer stands for all that follow.
std::function<GivenAnswer(int)> statuses(std::vector<int> list) {
  return [list](int number) {
    return GivenAnswer{.status = list[std::min(static_cast<std::size_t>(number), list.size() - 1)]};
  };
}

TEST_CASE("a signature is that of the Standard Webhooks scheme, one for each secret") {
  const Time sent_at{std::chrono::seconds(1614265330)};
  const std::string body = R"({"test": 2432232314})", id = "msg_p5jXN8AQM9LWM0D4loKWxJek";
  const std::string expected = "v1,g0hM9SsE+OTPJTGt/tmIKtSyZlE3uFJELVlNIOLJ1OE=";  // HMAC-SHA256, by another program
  CHECK(webhook_signature({kSecret}, id, sent_at, body) == expected);
  const std::string both = webhook_signature({"whsec_" + std::string(32, 'A'), kSecret}, id, sent_at, body);
  CHECK(both.starts_with("v1,"));
  CHECK(both.ends_with(" " + expected));
}

TEST_CASE("an alert is told with what a guard needs, signed, and each of its steps by a message of its own") {
  ToldPlace place;
  HttpReceiver receiver;
  const ChannelId channel = place.add("ops", hook(receiver));
  const AlertId alert = place.open_alert("Something was added.");
  const ReceivedRequest opened = receiver.wait_for(1)[0];
  place.acknowledge(alert);
  const ReceivedRequest acknowledged = receiver.wait_for(2)[1];

  CHECK(opened.id.starts_with("msg_"));
  CHECK(opened.id != acknowledged.id);
  const Time sent_at{std::chrono::seconds(std::stoll(opened.timestamp))};
  CHECK(opened.signature == webhook_signature({kSecret}, opened.id, sent_at, opened.body));
  const json body = json::parse(opened.body);
  CHECK(body["type"] == "alert.opened");
  CHECK(body["timestamp"] == body["data"]["opened_at"]);
  CHECK(body["data"]["id"] == alert.value);
  CHECK(body["data"]["site"] == "Höfe");
  CHECK(body["data"]["state"] == "open");
  CHECK(body["data"]["step"]["note"] == "as a test");
  CHECK(body["data"]["link"] == "https://watch.example.com/alerts/" + std::to_string(alert.value));
  CHECK(json::parse(acknowledged.body)["data"]["state"] == "acknowledged");
  for (const DeliveryRecord& delivery : place.wait_until_ended(channel, 2)) {
    CHECK(delivery.state == DeliveryState::delivered);
    CHECK(delivery.attempts == 1);
    CHECK(delivery.response_code == 200);
    CHECK(delivery.alert == alert);
  }
}

TEST_CASE("what fails is sent again with the same id and content, until it arrives") {
  ToldPlace place;
  HttpReceiver receiver(statuses({500, 503, 302, 200}));
  const ChannelId channel = place.add("ops", hook(receiver));
  const AlertId alert = place.open_alert("Something was added.");
  receiver.wait_for(1);
  place.acknowledge(alert);  // later steps change nothing in what is told of this one
  const auto deliveries = place.wait_until_ended(channel, 2);
  CHECK(deliveries[0].state == DeliveryState::delivered);
  CHECK(deliveries[0].error.empty());
  std::vector<ReceivedRequest> of_first;
  for (const ReceivedRequest& request : receiver.wait_for(5)) {
    if (request.id == deliveries[0].message_id) of_first.push_back(request);
  }
  REQUIRE(of_first.size() >= 2);
  CHECK(of_first.front().body == of_first.back().body);
  CHECK(deliveries[0].attempts == of_first.size());
  CHECK(place.channel(channel).trouble.empty());
}

TEST_CASE("what is given up is told to the other channels, stays in the log, and can be sent again") {
  DeliveryConfig config = ToldPlace::quick();
  config.attempts = 3;
  ToldPlace place(config);
  HttpReceiver broken(statuses({500, 500, 500, 200})), sound;
  // The broken one hears of this one alert alone: of the system's alert, too, it would hear in the end.
  const ChannelId first = place.add("broken", hook(broken), {.min_severity = Severity::critical});
  place.add("sound", hook(sound));
  place.open_alert("Something was removed.", Severity::critical);
  const DeliveryRecord failed = place.wait_until_ended(first, 1)[0];
  CHECK(failed.state == DeliveryState::failed);
  CHECK(failed.attempts == 3);
  CHECK(failed.error == "the receiver answered with 500");
  CHECK(place.channel(first).trouble == failed.error);
  REQUIRE(place.failing_alerts().size() == 1);
  CHECK(place.failing_alerts()[0].state == AlertState::open);
  CHECK(json::parse(sound.wait_for(2)[1].body)["data"]["cause"] == "delivery-failing");

  place.store().write([&](Transaction& t) { retry_delivery(t, failed.id, ToldPlace::now()); });
  const DeliveryRecord delivered = place.wait_until_ended(first, 1)[0];
  CHECK(delivered.state == DeliveryState::delivered);
  CHECK(delivered.message_id == failed.message_id);
  CHECK(place.failing_alerts()[0].state == AlertState::resolved);
  CHECK(place.channel(first).trouble.empty());
}

TEST_CASE("a channel that fails for long is told of, although it is not given up yet") {
  DeliveryConfig config = ToldPlace::quick();
  config.retry_delays = {std::chrono::hours(1)};
  config.alarm_after = std::chrono::seconds(1);
  ToldPlace place(config);
  HttpReceiver broken(statuses({500}));
  const ChannelId channel = place.add("ops", hook(broken));
  place.open_alert("Something was added.");
  place.wait_until([&] { return !place.failing_alerts().empty(); });
  CHECK(place.failing_alerts()[0].title == "Channel ops (webhook) does not deliver: the receiver answered with 500.");
  CHECK(place.deliveries(channel)[0].state == DeliveryState::pending);

  ChannelRecord disabled = place.channel(channel);
  disabled.enabled = false;
  place.store().write([&](Transaction& t) { replace_channel(t, disabled, ToldPlace::now()); });
  place.wait_until([&] { return place.failing_alerts()[0].state == AlertState::resolved; });
  CHECK_FALSE(place.channel(channel).failing_since.has_value());
}

TEST_CASE("deleting a channel that fails settles what was told of it") {
  DeliveryConfig config = ToldPlace::quick();
  config.attempts = 1;
  ToldPlace place(config);
  HttpReceiver broken(statuses({500}));
  const ChannelId channel = place.add("ops", hook(broken), {.min_severity = Severity::critical});
  place.open_alert("Something was added.", Severity::critical);
  place.wait_until([&] { return !place.failing_alerts().empty(); });
  place.deliverer().delete_channel(channel);
  CHECK(place.failing_alerts()[0].state == AlertState::resolved);
}

TEST_CASE("410 says that the receiver wants no more: the channel is disabled, and that is told") {
  ToldPlace place;
  HttpReceiver receiver(statuses({410}));
  const ChannelId channel = place.add("ops", hook(receiver), {.min_severity = Severity::critical});
  place.open_alert("Something was added.", Severity::critical);
  CHECK(place.wait_until_ended(channel, 1)[0].state == DeliveryState::failed);
  CHECK_FALSE(place.channel(channel).enabled);
  CHECK(place.failing_alerts().size() == 1);
  place.open_alert("Something else was added.", Severity::critical);
  CHECK(place.deliveries(channel).size() == 1);
}

TEST_CASE("a receiver that asks for time gets it, and one that redirects or answers at length does no harm") {
  ToldPlace place;
  HttpReceiver busy([](int) { return GivenAnswer{.status = 429, .headers = {{"Retry-After", "3600"}}}; });
  HttpReceiver elsewhere;
  HttpReceiver talkative([&](int number) {
    if (number == 0) return GivenAnswer{.status = 307, .headers = {{"Location", elsewhere.url()}}};
    return GivenAnswer{.content = std::string(5'000'000, 'x')};
  });
  const ChannelId first = place.add("busy", hook(busy));
  const ChannelId second = place.add("talkative", hook(talkative));
  place.open_alert("Something was added.");
  place.wait_until([&] { return !place.deliveries(first)[0].error.empty(); });
  const DeliveryRecord asked = place.deliveries(first)[0];
  CHECK(asked.state == DeliveryState::pending);
  CHECK(asked.next_attempt_at >= *asked.last_attempt_at + std::chrono::seconds(3600));
  const DeliveryRecord taken = place.wait_until_ended(second, 1)[0];
  CHECK(taken.state == DeliveryState::delivered);
  CHECK(taken.attempts == 2);
}

TEST_CASE("a receiver that hangs delays nobody else, and no stop") {
  ToldPlace place;
  HttpReceiver hanging, sound;
  hanging.hang();
  const ChannelId stuck = place.add("hanging", hook(hanging));
  const ChannelId other = place.add("sound", hook(sound));
  place.open_alert("Something was added.");
  hanging.wait_for(1);
  place.open_alert("Something else was added.");
  sound.wait_for(2);
  CHECK(place.wait_until_ended(other, 2)[1].state == DeliveryState::delivered);
  CHECK(place.deliveries(stuck)[0].state == DeliveryState::sending);

  place.deliverer().request_stop();
  CHECK(place.deliverer().wait_stopped(std::chrono::steady_clock::now() + std::chrono::seconds(3)));
  CHECK(place.deliveries(stuck)[0].state == DeliveryState::pending);  // nobody knows whether it arrived
}

TEST_CASE("more than a channel takes in a minute waits, and nothing is lost") {
  ToldPlace place;
  HttpReceiver receiver;
  const ChannelId channel = place.add("slow", hook(receiver), {.per_minute = 2});
  for (int i = 0; i < 4; ++i) place.open_alert("Thing " + std::to_string(i));
  receiver.wait_for(2);
  place.wait_until([&] { return place.deliveries(channel)[1].state == DeliveryState::delivered; });
  CHECK(place.deliveries(channel)[2].state == DeliveryState::pending);
  CHECK(place.deliveries(channel)[3].state == DeliveryState::pending);
}

TEST_CASE("an edited channel sends what waits to where it points now; a deleted one drops it") {
  DeliveryConfig config = ToldPlace::quick();
  config.retry_delays = {std::chrono::hours(1)};
  ToldPlace place(config);
  HttpReceiver wrong(statuses({404})), right;
  const ChannelId channel = place.add("ops", hook(wrong));
  place.open_alert("Something was added.");
  place.wait_until([&] { return !place.deliveries(channel)[0].error.empty(); });
  ChannelRecord edited = place.channel(channel);
  edited.settings = hook(right);
  place.store().write([&](Transaction& t) { replace_channel(t, edited, ToldPlace::now()); });
  CHECK(right.wait_for(1)[0].id == place.deliveries(channel)[0].message_id);
  place.wait_until_ended(channel, 1);

  edited.settings = hook(wrong);
  place.store().write([&](Transaction& t) { replace_channel(t, edited, ToldPlace::now()); });
  place.open_alert("Something else was added.");
  place.wait_until([&] { return !place.deliveries(channel)[1].error.empty(); });
  place.deliverer().delete_channel(channel);
  CHECK(place.deliveries(channel)[1].state == DeliveryState::dropped);
}

TEST_CASE("a test of a channel says at once what happened") {
  ToldPlace place;
  HttpReceiver receiver(statuses({200, 401}));
  const ChannelId channel = place.add("ops", hook(receiver), {.enabled = false});
  const ChannelTest fine = place.deliverer().test(channel);
  CHECK(fine.delivered);
  CHECK(fine.response_code == 200);
  CHECK(json::parse(receiver.wait_for(1)[0].body)["type"] == "test");
  const ChannelTest refused = place.deliverer().test(channel);
  CHECK_FALSE(refused.delivered);
  CHECK(refused.error == "the receiver answered with 401");
  CHECK(place.deliveries(channel).empty());
}

}  // namespace
}  // namespace raywatch::test
