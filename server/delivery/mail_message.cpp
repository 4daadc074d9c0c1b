#include "server/delivery/mail_message.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>

#include "api/base64.hpp"
#include "api/json.hpp"

namespace raywatch {
namespace {

constexpr const char* kEnd = "\r\n";

std::span<const std::uint8_t> bytes_of(std::string_view text) {
  return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

std::string text_at(const Json& json, const char* name) {
  const auto member = json.find(name);
  return member != json.end() && member->is_string() ? member->get<std::string>() : "";
}

std::string numbers(const Json& vector, const char* between) {
  std::string text;
  for (const Json& number : vector) {
    char digits[32];
    std::snprintf(digits, sizeof digits, "%.2f", number.get<double>());
    text += (text.empty() ? "" : between) + std::string(digits);
  }
  return text;
}

/// One line of the text: "Where:    site yard".
std::string line(const char* name, const std::string& value) {
  if (value.empty()) return "";
  char head[16];
  std::snprintf(head, sizeof head, "%-10s", name);
  return head + value + "\n";
}

std::string what(const Json& change) {
  if (!change.is_object()) return "";
  char volume[48];
  std::snprintf(volume, sizeof volume, " m (box of %.3g m3), ", change["volume_m3"].get<double>());
  return text_at(change, "kind") + ", " + numbers(change["size_m"], " x ") + volume + change["points"].dump() +
         " points";
}

std::string where(const Json& data) {
  std::string text = text_at(data, "site").empty() ? "" : "site " + text_at(data, "site");
  if (!text_at(data, "zone_name").empty()) text += ", zone " + text_at(data, "zone_name");
  if (data.contains("change") && data["change"].is_object()) {
    text += ", at x, y, z = " + numbers(data["change"]["centroid_m"], ", ") + " m";
  }
  if (!text_at(data, "sensor").empty()) text += ", sensor " + text_at(data, "sensor");
  return text;
}

std::string state(const Json& data) {
  if (!data.contains("step")) return "";
  const Json& step = data["step"];
  return text_at(step, "action") + " by " + text_at(step, "by") + "; " + text_at(data, "state") + ", " +
         text_at(data, "severity");
}

/// What it is about, in one sentence.
std::string title(const Json& data) {
  const std::string alert = text_at(data, "title");
  return alert.empty() ? text_at(data, "text") : alert;
}

std::string subject(const Json& body) {
  const Json& data = body["data"];
  std::string head = "[raywatch";
  if (!text_at(data, "site").empty()) head += " " + text_at(data, "site");
  head += "] ";
  if (!data.contains("step")) return head + title(data);
  const std::string action = text_at(data["step"], "action");
  return head + (action == "opened" ? text_at(data, "severity") : action) + ": " + title(data);
}

std::string plain_text(const Json& body) {
  const Json& data = body["data"];
  std::string text = title(data) + "\n\n";
  text += line("What:", data.contains("change") ? what(data["change"]) : "");
  text += line("Where:", where(data));
  text += line("When:", text_at(data, "local_time").empty() ? text_at(body, "timestamp") : text_at(data, "local_time"));
  text += line("State:", state(data));
  if (data.contains("step")) text += line("Note:", text_at(data["step"], "note"));
  text += line("Link:", text_at(data, "link"));
  return text;
}

/// RFC 5322 knows English names only, and no time zone's name.
std::string mail_date(const std::string& rfc3339) {
  using namespace std::chrono;
  static constexpr std::array kDays{"Sun", "Mon", "Tue", "Wed", "Thu", "Fri", "Sat"};
  static constexpr std::array kMonths{"Jan", "Feb", "Mar", "Apr", "May", "Jun",
                                      "Jul", "Aug", "Sep", "Oct", "Nov", "Dec"};
  const Time time = parse_rfc3339(rfc3339);
  const auto day = floor<days>(time);
  const year_month_day date(day);
  const hh_mm_ss clock(floor<seconds>(time - day));
  char text[48];
  std::snprintf(text, sizeof text, "%s, %02u %s %d %02d:%02d:%02d +0000", kDays[weekday(day).c_encoding()],
                static_cast<unsigned>(date.day()), kMonths[static_cast<unsigned>(date.month()) - 1],
                static_cast<int>(date.year()), static_cast<int>(clock.hours().count()),
                static_cast<int>(clock.minutes().count()), static_cast<int>(clock.seconds().count()));
  return text;
}

std::string base64_lines(const std::string& text) {
  constexpr std::size_t kWidth = 76;
  const std::string all = base64(bytes_of(text));
  std::string lines;
  for (std::size_t at = 0; at < all.size(); at += kWidth) lines += all.substr(at, kWidth) + kEnd;
  return lines;
}

/// The first bytes of a text, at most `most`, that end where a character does.
std::size_t whole_characters(std::string_view text, std::size_t most) {
  if (text.size() <= most) return text.size();
  while (most > 0 && (static_cast<unsigned char>(text[most]) & 0xC0) == 0x80) --most;
  return most;
}

}  // namespace

std::string encoded_header(std::string text) {
  constexpr std::size_t kPlain = 60, kWord_bytes = 42;  // an encoded word has at most 75 characters
  const auto is_control = [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7F; };
  std::ranges::replace_if(text, is_control, ' ');
  const bool is_ascii = std::ranges::all_of(text, [](char c) { return static_cast<unsigned char>(c) < 0x80; });
  if (is_ascii && text.size() <= kPlain && !text.starts_with(' ') && text.find("=?") == std::string::npos) return text;
  std::string words;
  for (std::string_view rest = text; !rest.empty();) {
    const std::size_t size = whole_characters(rest, kWord_bytes);
    words += (words.empty() ? "" : "\r\n ") + ("=?UTF-8?B?" + base64(bytes_of(rest.substr(0, size))) + "?=");
    rest.remove_prefix(size);
  }
  return words;
}

std::string mail_message(const MailSettings& settings, const Message& message) {
  const Json body = Json::parse(message.body);
  std::string to;
  for (const std::string& address : settings.to) to += (to.empty() ? "" : ",\r\n ") + ("<" + address + ">");
  const std::string domain = settings.from.substr(settings.from.rfind('@') + 1);
  return "Date: " + mail_date(text_at(body, "timestamp")) + kEnd + "From: raywatch <" + settings.from + ">" + kEnd +
         "To: " + to + kEnd + "Subject: " + encoded_header(subject(body)) + kEnd + "Message-ID: <" + message.id + "@" +
         domain + ">" + kEnd + "Auto-Submitted: auto-generated" + kEnd + "MIME-Version: 1.0" + kEnd +
         "Content-Type: text/plain; charset=utf-8" + kEnd + "Content-Transfer-Encoding: base64" + kEnd + kEnd +
         base64_lines(plain_text(body));
}

}  // namespace raywatch
