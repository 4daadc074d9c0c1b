#include <vector>

#include "api/call.hpp"
#include "api/endpoints/endpoints.hpp"
#include "api/lookup.hpp"
#include "api/problem.hpp"
#include "api/render.hpp"
#include "api/spool_file.hpp"
#include "api/wait_preference.hpp"
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

void refuse_multipart(const RequestBody& body) {
  if (lower(body.content_type()).starts_with("multipart/")) {
    throw HttpError(unsupported_media_type("The content must be the scan file itself, not a form that holds it."));
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
  const auto wait = preferred_wait(call);
  refuse_multipart(call.body);
  call.services.store.read([&](const Snapshot& snapshot) { sensor_named(snapshot, *hints.sensor); });
  // Received bodies lie on the disk for a while, too: what is kept free is not for them.
  const std::uint64_t announced_bytes = call.body.length().value_or(0);
  if (announced_bytes <= call.config.max_body_bytes) call.services.store.require_room(announced_bytes);
  const UploadResult result = store_upload(call, hints);
  if (!wait) return render_result(call, result);
  std::vector<ScanId> scans;
  for (const ScanRecord& scan : result.scans) scans.push_back(scan.id);
  wait_for_scans(call, scans, *wait);
  HttpAnswer answer = render_result(call, result);
  set_wait_applied(answer, *wait);
  return answer;
}

}  // namespace raywatch::endpoints
