#include <algorithm>

#include "api/call.hpp"
#include "api/endpoints/endpoints.hpp"
#include "api/lookup.hpp"
#include "api/problem.hpp"
#include "api/render.hpp"
#include "api/spool_file.hpp"
#include "storage/formats/scan_file.hpp"
#include "storage/formats/side_car.hpp"

namespace raywatch::endpoints {
namespace {

ScanHints parse_hints(Query& query) {
  ScanHints hints;
  query.require("sensor");
  hints.sensor = query.text("sensor");
  hints.captured_at = query.time("captured_at");
  hints.pose = query.parsed("pose", [](const std::string& text) { return parse_pose_text(text, "pose"); });
  hints.frame = query.parsed("frame", [](const std::string& text) { return parse_frame(text); });
  hints.format = query.parsed("format", [](const std::string& text) { return parse_scan_format(text); });
  query.finish();
  return hints;
}

/// The N of `Prefer: wait=N` (RFC 7240). A preference that is not understood is ignored, as that says.
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

void refuse_multipart(const RequestBody& body) {
  if (lower(body.content_type()).starts_with("multipart/")) {
    throw HttpError(unsupported_media_type("The content must be the scan file itself, not a form that holds it."));
  }
}

/// Waits until the scans are compared, the time is over, or nobody waits for the answer any more.
void wait_for(Call& call, const std::vector<ScanRecord>& scans, std::chrono::seconds time) {
  using namespace std::chrono_literals;
  const auto end = std::chrono::steady_clock::now() + time;
  for (const ScanRecord& scan : scans) {
    for (;;) {
      const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(end - std::chrono::steady_clock::now());
      if (left <= 0ms || call.abandoned()) return;
      if (call.services.commands.wait_for_scan(scan.id, std::min(left, std::chrono::milliseconds(200ms)))) break;
    }
  }
}

HttpAnswer render_result(Call& call, const UploadResult& result) {
  const Json items = call.services.store.read([&](const Snapshot& snapshot) {
    Json list = Json::array();
    for (const ScanRecord& scan : result.scans) list.push_back(render(snapshot, scan_with(snapshot, scan.id)));
    return list;
  });
  const int status = result.already_stored ? 200 : 201;
  HttpAnswer answer =
      json_answer(items.size() == 1 ? items.front() : Json{{"items", items}, {"next", nullptr}}, status);
  if (!result.scans.empty()) {
    answer.set_header("Location", "/api/v1/scans/" + std::to_string(result.scans.front().id.value));
  }
  return answer;
}

UploadResult store_upload(Call& call, const ScanHints& hints) {
  const SpoolFile spooled(call.config.spool_dir, call.body, call.config.max_body_bytes);
  if (spooled.size() == 0) throw InvalidInput("The content is empty; it must be a scan file.", {{"", "is empty"}});
  return call.services.commands.ingest({spooled.path(), spooled.sha256(), hints});
}

}  // namespace

HttpAnswer upload_scan(Call& call) {
  const ScanHints hints = parse_hints(call.query);
  const auto wait_s = parse_wait_s(call.header("Prefer"));
  refuse_multipart(call.body);
  call.services.store.read([&](const Snapshot& snapshot) { sensor_named(snapshot, *hints.sensor); });
  // Received bodies lie on the disk for a while, too: what is kept free is not for them.
  const std::uint64_t announced_bytes = call.body.length().value_or(0);
  if (announced_bytes <= call.config.max_body_bytes) call.services.store.require_room(announced_bytes);
  const UploadResult result = store_upload(call, hints);
  if (!wait_s) return render_result(call, result);
  const auto seconds = std::min(*wait_s, static_cast<std::int64_t>(call.config.max_wait_s));
  wait_for(call, result.scans, std::chrono::seconds(seconds));
  HttpAnswer answer = render_result(call, result);
  answer.set_header("Preference-Applied", "wait=" + std::to_string(seconds));
  return answer;
}

}  // namespace raywatch::endpoints
