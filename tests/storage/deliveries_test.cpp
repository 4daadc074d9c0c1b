#include "storage/deliveries.hpp"

#include <doctest/doctest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>

#include "core/error.hpp"
#include "storage/alerts.hpp"
#include "storage/events.hpp"
#include "tests/storage/store_fixture.hpp"

namespace raywatch {
namespace {

ChannelRecord webhook(const std::string& name, std::vector<std::string> events = {"alert.*"}) {
  return {.name = name,
          .settings = WebhookSettings{.url = "https://example.com/hook", .secrets = {"whsec_x"}},
          .events = std::move(events),
          .by = "anna"};
}

ChannelId add(Store& store, const ChannelRecord& channel) {
  return store.write([&](Transaction& t) { return insert_channel(t, channel, at_second(0)).id; });
}

AlertRecord alert_at(SiteId site, Severity severity, const std::string& subject = "one") {
  return {.site = site,
          .subject = subject,
          .title = "Something was added.",
          .severity = severity,
          .opened_at = at_second(1)};
}

AlertId open_in(Store& store, SiteId site, const std::string& subject = "one") {
  return store.write([&](Transaction& t) { return open_alert(t, alert_at(site, Severity::warning, subject), "").id; });
}

std::vector<DeliveryRecord> deliveries(Store& store, const DeliveryFilter& filter = {}) {
  return store.read([&](const Snapshot& s) { return list_deliveries(s, filter, {}).items; });
}

TEST_CASE("what a channel was made with comes back, of every kind") {
  StoreFixture f;
  ChannelRecord mail = webhook("mail");
  mail.settings = MailSettings{.host = "mx", .port = 587, .user = "u", .password = "p", .from = "a@b", .to = {"c@d"}};
  mail.site = f.site.id;
  mail.per_minute = 7;
  ChannelRecord mqtt = webhook("mqtt");
  mqtt.settings = MqttSettings{.host = "broker", .port = 8883, .tls = true, .topic_prefix = "r"};
  add(f.store, webhook("hook"));
  const ChannelId second = add(f.store, mail), third = add(f.store, mqtt);
  f.store.read([&](const Snapshot& s) {
    const ChannelRecord read = find_channel(s, second).value();
    CHECK(std::get<MailSettings>(read.settings).password == "p");
    CHECK(std::get<MailSettings>(read.settings).security == MailSecurity::starttls);
    CHECK(read.site == f.site.id);
    CHECK(read.per_minute == 7);
    CHECK(read.revision == 1);
    CHECK(std::get<MqttSettings>(find_channel(s, third)->settings).tls);
    CHECK(list_channels(s, std::nullopt, {}).items.size() == 3);
    CHECK(enabled_channels(s).size() == 3);
  });
  CHECK_THROWS_AS(add(f.store, webhook("hook")), Conflict);
  CHECK_THROWS_AS(f.store.write([&](Transaction& t) { delete_sensor(t, f.sensor.id), delete_site(t, f.site.id); }),
                  Conflict);
}

TEST_CASE("a step of an alert is queued in its own transaction, for each channel that it concerns") {
  StoreFixture f;
  const Site other = add_site(f.store, "cellar");
  ChannelRecord of_other = webhook("of the cellar");
  of_other.site = other.id;
  ChannelRecord critical = webhook("critical only");
  critical.min_severity = Severity::critical;
  ChannelRecord off = webhook("off");
  off.enabled = false;
  const ChannelId all = add(f.store, webhook("all"));
  for (const ChannelRecord& channel : {of_other, critical, off, webhook("resolutions", {"alert.resolved"})}) {
    add(f.store, channel);
  }
  const AlertId alert = open_in(f.store, f.site.id);
  REQUIRE(deliveries(f.store).size() == 1);
  const DeliveryRecord queued = deliveries(f.store)[0];
  CHECK(queued.channel == all);
  CHECK(queued.type == "alert.opened");
  CHECK(queued.alert == alert);
  CHECK(queued.step == 0);
  CHECK(queued.state == DeliveryState::pending);
  CHECK(queued.message_id.size() == 36);
  const auto change = [&](const char* action, AlertState state) {
    f.store.write([&](Transaction& t) {
      change_alert(t, alert, {.action = action, .by = "anna", .at = at_second(2), .state = state});
    });
  };
  change("acknowledged", AlertState::acknowledged);
  change("resolved", AlertState::resolved);
  CHECK(deliveries(f.store, {.alert = alert}).size() == 4);
  CHECK(deliveries(f.store, {.channel = all}).size() == 3);
  CHECK(deliveries(f.store, {.state = DeliveryState::failed}).empty());

  CHECK_THROWS_AS(f.store.write([&](Transaction& t) {
    open_alert(t, alert_at(f.site.id, Severity::critical), "");
    throw Conflict("it is rolled back");
  }),
                  Conflict);
  CHECK(deliveries(f.store).size() == 4);
}

TEST_CASE("a channel hears of the events that its patterns cover") {
  CHECK(covers({"alert.*"}, "alert.opened"));
  CHECK_FALSE(covers({"alert.*"}, "track.started"));
  CHECK(covers({"scan.stored", "track.*"}, "track.started"));
  CHECK_FALSE(covers({"scan.stored"}, "scan.stored.twice"));
  CHECK(covers({"*"}, "anything"));
  StoreFixture f;
  const ChannelId channel = add(f.store, webhook("tracks", {"track.*"}));
  f.store.write([&](Transaction& t) {
    insert_event(t, {.at = at_second(1), .type = "scan.stored", .site = f.site.id});
    insert_event(t, {.at = at_second(2), .type = "track.started", .site = f.site.id});
  });
  REQUIRE(deliveries(f.store, {.channel = channel}).size() == 1);
  CHECK_FALSE(deliveries(f.store)[0].step);
}

TEST_CASE("deliveries are taken in order when they are due, and wait for their next attempt") {
  StoreFixture f;
  const ChannelId channel = add(f.store, webhook("all"));
  open_in(f.store, f.site.id);
  open_in(f.store, f.site.id, "another");
  const auto start = [&](int second) {
    return f.store.write([&](Transaction& t) { return start_delivery(t, channel, at_second(second)); });
  };
  CHECK_FALSE(start(0));  // they were made at second 1
  const DeliveryRecord first = start(1).value();
  CHECK(first.attempts == 1);
  CHECK(first.state == DeliveryState::sending);
  f.store.write([&](Transaction& t) {
    end_attempt(t, first.id,
                {.state = DeliveryState::pending,
                 .at = at_second(2),
                 .next_attempt_at = at_second(60),
                 .response_code = 500,
                 .error = "no"});
  });
  const DeliveryRecord second = start(3).value();
  CHECK(second.id.value == first.id.value + 1);
  f.store.write([&](Transaction& t) { end_attempt(t, second.id, {.at = at_second(4)}); });
  CHECK_FALSE(start(5));
  CHECK(f.store.read([&](const Snapshot& s) { return next_attempt_of(s, channel); }) == at_second(60));
  f.store.write([&](Transaction& t) { hasten_deliveries(t, channel, at_second(6)); });
  CHECK(start(6)->attempts == 2);
  f.store.write([&](Transaction& t) { requeue_started_deliveries(t, channel); });
  CHECK(start(6)->attempts == 3);
}

TEST_CASE("only what failed or was dropped is sent again by hand, and only while its channel is there") {
  StoreFixture f;
  const ChannelId channel = add(f.store, webhook("all"));
  open_in(f.store, f.site.id);
  const DeliveryId id = deliveries(f.store)[0].id;
  const auto retry = [&] { f.store.write([&](Transaction& t) { retry_delivery(t, id, at_second(9)); }); };
  CHECK_THROWS_AS(retry(), Conflict);
  f.store.write([&](Transaction& t) {
    start_delivery(t, channel, at_second(1));
    end_attempt(t, id, {.state = DeliveryState::failed, .at = at_second(2), .error = "no"});
  });
  retry();
  CHECK(deliveries(f.store)[0].state == DeliveryState::pending);
  CHECK(deliveries(f.store)[0].queued_at == at_second(9));
  f.store.write([&](Transaction& t) { delete_channel(t, channel, at_second(10)); });
  CHECK(deliveries(f.store)[0].state == DeliveryState::dropped);
  CHECK_THROWS_AS(retry(), Conflict);
  CHECK(f.store.write([&](Transaction& t) { return prune_deliveries(t, at_second(10), 100); }) == 0);
  CHECK(f.store.write([&](Transaction& t) { return prune_deliveries(t, at_second(11), 100); }) == 1);
}

TEST_CASE("a kill between the commit of an alert and its delivery loses neither, and the message keeps its id") {
  const TempDir directory;
  ChannelId channel;
  {
    Store store(options_for(directory.path()));
    add_site(store, "hall");
    channel = add(store, webhook("all"));
  }
  const pid_t child = fork();
  REQUIRE(child >= 0);
  if (child == 0) {
    Store store(options_for(directory.path()));
    open_in(store, store.read([](const Snapshot& s) { return find_site(s, "hall")->id; }));
    store.write([&](Transaction& t) {
      const auto started = start_delivery(t, channel, at_second(5));
      set_body(t, started->id, started->message_id);
    });
    kill(getpid(), SIGKILL);
  }
  int status = 0;
  REQUIRE(waitpid(child, &status, 0) == child);
  REQUIRE(WIFSIGNALED(status));
  Store store(options_for(directory.path()));
  REQUIRE(deliveries(store).size() == 1);
  CHECK(deliveries(store)[0].state == DeliveryState::sending);
  store.write([&](Transaction& t) { requeue_started_deliveries(t, channel); });
  const auto again = store.write([&](Transaction& t) { return start_delivery(t, channel, at_second(6)); });
  REQUIRE(again);
  CHECK(again->attempts == 2);
  CHECK(again->body == again->message_id);
}

}  // namespace
}  // namespace raywatch
