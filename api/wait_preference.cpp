#include "api/wait_preference.hpp"

#include <algorithm>
#include <string>

#include "api/http_server.hpp"
#include "api/text_values.hpp"

namespace raywatch {
namespace {

std::optional<std::int64_t> parse_wait_s(const std::optional<std::string>& prefer) {
  if (!prefer) return std::nullopt;
  for (const std::string_view part : split(*prefer, ',')) {
    const std::string preference = lower(without_blanks(part.substr(0, part.find(';'))));
    if (!preference.starts_with("wait=")) continue;
    const auto seconds = parse_integer(std::string_view(preference).substr(5));
    if (seconds && *seconds >= 0) return seconds;
  }
  return std::nullopt;
}

}  // namespace

std::optional<std::chrono::seconds> preferred_wait(const Call& call) {
  const auto seconds = parse_wait_s(call.header("Prefer"));
  if (!seconds) return std::nullopt;
  return std::chrono::seconds(std::min(*seconds, static_cast<std::int64_t>(call.config.max_wait_s)));
}

void wait_for_scans(const Call& call, std::span<const ScanId> scans, std::chrono::seconds time) {
  using namespace std::chrono_literals;
  const auto end = std::chrono::steady_clock::now() + time;
  for (const ScanId scan : scans) {
    for (;;) {
      const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(end - std::chrono::steady_clock::now());
      if (left <= 0ms || call.abandoned()) return;
      if (call.services.commands.wait_for_scan(scan, std::min(left, std::chrono::milliseconds(200ms)))) break;
    }
  }
}

void set_wait_applied(HttpAnswer& answer, std::chrono::seconds time) {
  answer.set_header("Preference-Applied", "wait=" + std::to_string(time.count()));
}

}  // namespace raywatch
