// Mail, by a real mail server on loopback.

#include <doctest/doctest.h>

#include <cstdlib>
#include <nlohmann/json.hpp>

#include "server/delivery/mail_message.hpp"
#include "storage/zones.hpp"
#include "tests/delivery/child_process.hpp"
#include "tests/delivery/told_place.hpp"

namespace raywatch::test {
namespace {

using nlohmann::json;

/// Debian's own Python: others do not know its packages.
std::vector<std::string> sink_command(const std::vector<std::string>& arguments = {}) {
  std::vector<std::string> command = {"/usr/bin/python3", RAYWATCH_SOURCE_DIR "/tests/delivery/smtp_sink.py"};
  command.insert(command.end(), arguments.begin(), arguments.end());
  return command;
}

MailSettings mail_to(int port) {
  return {.host = "127.0.0.1",
          .port = static_cast<std::uint16_t>(port),
          .security = MailSecurity::none,
          .from = "raywatch@example.com",
          .to = {"guard@example.com", "chief@example.com"}};
}

TEST_CASE("a guard reads in a mail what happened, where, when and how large, whatever the names are") {
  ChildProcess server(sink_command());
  ToldPlace place;
  const ChannelId channel = place.add("guards", mail_to(std::stoi(server.next_line())));
  const AlertId alert = place.open_alert(
      "Größe: Something of 1 x 1 x 1 m was added\r\nBcc: thief@example.com\r\n\r\nin zone "
      "Tor, which has a long name so that the subject must be folded.");
  const json mail = json::parse(server.next_line());
  CHECK(mail["from"] == "raywatch@example.com");
  CHECK(mail["to"] == json({"guard@example.com", "chief@example.com"}));
  CHECK(mail["defects"].empty());
  CHECK(mail["bare_newlines"] == 0);
  CHECK(mail["longest_line"] <= 78);
  CHECK_FALSE(mail["headers"].contains("Bcc"));
  CHECK(mail["headers"]["Subject"] ==
        "[raywatch Höfe] warning: Größe: Something of 1 x 1 x 1 m was added  Bcc: thief@example.com    in zone Tor, "
        "which has a long name so that the subject must be folded.");
  const DeliveryRecord delivery = place.wait_until_ended(channel, 1)[0];
  CHECK(delivery.state == DeliveryState::delivered);
  CHECK(delivery.response_code == 250);
  CHECK(mail["headers"]["Message-ID"] == "<" + delivery.message_id + "@example.com>");
  const std::string text = mail["text"];
  CHECK(text.find("Where:    site Höfe") != std::string::npos);
  CHECK(text.find("State:    opened by raywatch; open, warning") != std::string::npos);
  CHECK(text.find("https://watch.example.com/alerts/" + std::to_string(alert.value)) != std::string::npos);
  CHECK((text.find(" CET\n") != std::string::npos || text.find(" CEST\n") != std::string::npos));
}

TEST_CASE("a subject of any text is one header of short lines") {
  CHECK(encoded_header("plain") == "plain");
  CHECK(encoded_header("a\r\nb") == "a  b");
  const std::string folded = encoded_header(std::string(200, 'x') + "äöü€");
  CHECK(folded.find('x') == std::string::npos);
  for (std::size_t at = 0; at < folded.size();) {
    const std::size_t end = std::min(folded.find("\r\n ", at), folded.size());
    CHECK(end - at <= 76);
    at = end + 3;
  }
}

TEST_CASE("the figures of a change stand in the mail") {
  const std::string mail =
      mail_message(mail_to(25), {.id = "msg_1",
                                 .type = "alert.opened",
                                 .body = json{{"type", "alert.opened"},
                                              {"timestamp", "2026-03-01T02:10:00Z"},
                                              {"data",
                                               {{"site", "yard"},
                                                {"title", "T"},
                                                {"state", "open"},
                                                {"severity", "critical"},
                                                {"zone_name", "gate"},
                                                {"step", {{"action", "opened"}, {"by", "raywatch"}}},
                                                {"change",
                                                 {{"kind", "added"},
                                                  {"size_m", {1.0, 2.0, 0.5}},
                                                  {"volume_m3", 1.0},
                                                  {"points", 42},
                                                  {"centroid_m", {3.0, 4.0, 5.0}}}}}}}
                                             .dump(),
                                 .sent_at = {}});
  CHECK(mail.starts_with("Date: Sun, 01 Mar 2026 02:10:00 +0000\r\n"));
  CHECK(mail.find("Subject: [raywatch yard] critical: T\r\n") != std::string::npos);
}

TEST_CASE("a mail server that wants STARTTLS and a log-in gets both; with a wrong password the mail waits") {
  const TempDir folder;
  const std::string certificate = folder / "cert.pem", key = folder / "key.pem";
  const std::string make =
      "/usr/bin/openssl req -x509 -newkey ec -pkeyopt ec_paramgen_curve:prime256v1 -nodes -days 2 "
      "-subj /CN=localhost -addext subjectAltName=IP:127.0.0.1 -keyout " +
      key + " -out " + certificate + " 2>/dev/null";
  REQUIRE(std::system(make.c_str()) == 0);
  ChildProcess server(sink_command({certificate, key, "raywatch", "right"}));
  DeliveryConfig config = ToldPlace::quick();
  config.sender.ca_file = certificate;
  ToldPlace place(config);
  MailSettings settings = mail_to(std::stoi(server.next_line()));
  settings.security = MailSecurity::starttls;
  settings.user = "raywatch";
  settings.password = "wrong";
  const ChannelId channel = place.add("guards", settings, {.enabled = false});
  const ChannelTest refused = place.deliverer().test(channel);
  CHECK_FALSE(refused.delivered);
  CHECK(refused.response_code == 535);
  ChannelRecord right = place.channel(channel);
  std::get<MailSettings>(right.settings).password = "right";
  place.store().write([&](Transaction& t) { replace_channel(t, right, ToldPlace::now()); });
  CHECK(place.deliverer().test(channel).delivered);
  const json mail = json::parse(server.next_line());
  CHECK(mail["tls"] == true);
  CHECK(mail["headers"]["Subject"] == "[raywatch] This is a test of channel guards.");
}

}  // namespace
}  // namespace raywatch::test
