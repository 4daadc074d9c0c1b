#include <cmath>

#include "api/call.hpp"
#include "api/conditional.hpp"
#include "api/endpoints/endpoints.hpp"
#include "api/json.hpp"
#include "api/lookup.hpp"
#include "core/panorama.hpp"
#include "storage/payloads.hpp"

namespace raywatch::endpoints {
namespace {

enum class PanoramaFormat { json, bin };

PanoramaFormat parse_panorama_format(const std::string& name) {
  if (name == "json") return PanoramaFormat::json;
  if (name == "bin") return PanoramaFormat::bin;
  throw InvalidInput("must be json or bin");
}

/// The range that a cell holds (see `Panorama`), to the millimetre; null for "nothing seen".
Json range_of(std::uint16_t cell) {
  if (cell == 0) return nullptr;
  const double range_m = std::exp2((cell - 1) / 1000.0) - 1.0;
  return std::round(range_m * 1000.0) / 1000.0;
}

HttpAnswer render_json(const Panorama& panorama) {
  Json farthest_m = Json::array();
  for (const std::uint16_t cell : panorama.farthest) farthest_m.push_back(range_of(cell));
  return json_answer({{"rows", Panorama::kRows},
                      {"columns", Panorama::kColumns},
                      {"first_elevation_deg", -90.0},
                      {"first_azimuth_deg", -180.0},
                      {"cell_deg", 180.0 / Panorama::kRows},
                      {"farthest_m", std::move(farthest_m)}});
}

HttpAnswer render_bin(const Panorama& panorama) {
  const auto bytes = to_bytes(panorama);
  HttpAnswer answer;
  answer.content_type = "application/octet-stream";
  answer.body.assign(bytes.begin(), bytes.end());
  return answer;
}

}  // namespace

HttpAnswer get_panorama(Call& call) {
  const auto format = call.query.parsed("format", parse_panorama_format).value_or(PanoramaFormat::json);
  call.query.finish();
  const auto id = id_in_path<ScanId>(call.path[0]);
  const ScanRecord scan = call.services.store.read([&](const Snapshot& snapshot) { return scan_with(snapshot, id); });
  const Panorama panorama = call.services.store.payloads().scan_panorama(scan.payload);
  return with_body_tag(format == PanoramaFormat::json ? render_json(panorama) : render_bin(panorama),
                       call.header("If-None-Match"));
}

}  // namespace raywatch::endpoints
