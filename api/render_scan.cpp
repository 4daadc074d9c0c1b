#include "api/lookup.hpp"
#include "api/render.hpp"
#include "api/units.hpp"

namespace raywatch {
namespace {

Json render_registration(const ScanRecord& scan) {
  const Registration& registration = scan.registration;
  const PoseUncertainty size = size_of(registration.correction, scan.pose);
  Json uncertainty;
  if (registration.uncertainty) {
    uncertainty = {{"position_m", registration.uncertainty->position_m},
                   {"angle_deg", deg_of_radians(registration.uncertainty->angle_rad)}};
  }
  return {{"state", to_string(registration.state)},
          {"correction", render(registration.correction)},
          {"shift_m", size.position_m},
          {"turn_deg", deg_of_radians(size.angle_rad)},
          {"residual_m", json_or_null(registration.residual_m)},
          {"inliers", json_or_null(registration.inliers)},
          {"against", registration.against ? Json(registration.against->value) : Json(nullptr)},
          {"uncertainty", uncertainty}};
}

Json render_comparisons(const std::vector<ComparisonRecord>& comparisons) {
  Json list = Json::array();
  for (const ComparisonRecord& comparison : comparisons) {
    list.push_back({{"id", comparison.id.value},
                    {"reference", render(comparison.reference)},
                    {"state", to_string(comparison.state)}});
  }
  return list;
}

std::string sensor_name(const Snapshot& snapshot, SensorId id) {
  const auto sensor = find_sensor(snapshot, id);
  if (!sensor) throw NotFound("There is no sensor with id " + std::to_string(id.value) + ".");
  return sensor->name;
}

}  // namespace

Json render(const Snapshot& snapshot, const ScanRecord& scan) {
  const auto comparisons = comparisons_of(snapshot, scan.id);
  const auto grid = scan.grid ? Json{{"rows", scan.grid->rows}, {"columns", scan.grid->columns}} : Json(nullptr);
  return {{"id", scan.id.value},
          {"site", site_with(snapshot, scan.site).name},
          {"sensor", sensor_name(snapshot, scan.sensor)},
          {"vantage", scan.vantage.value},
          {"captured_at", format_rfc3339(scan.captured_at)},
          {"received_at", format_rfc3339(scan.received_at)},
          {"points", scan.points},
          {"intensity", scan.has_intensity},
          {"grid", grid},
          {"sha256", scan.sha256},
          {"stored_bytes", scan.stored_bytes},
          {"pose", render(scan.pose)},
          {"registration", render_registration(scan)},
          {"pinned", scan.pinned},
          {"note", scan.note},
          {"state", to_string(scan.state)},
          {"failure", scan.failure.empty() ? Json(nullptr) : Json(scan.failure)},
          {"comparison", comparisons.empty() ? Json(nullptr) : Json(comparisons.front().id.value)},
          {"comparisons", render_comparisons(comparisons)}};
}

Json render(const Snapshot& snapshot, const Vantage& vantage) {
  const Site site = site_with(snapshot, vantage.site);
  return {{"id", vantage.id.value},
          {"site", site.name},
          {"position_m", render(vantage.position_m + origin_of(site))},
          {"scans", vantage.scans},
          {"first_captured_at", render(vantage.first_captured_at)},
          {"last_captured_at", render(vantage.last_captured_at)}};
}

}  // namespace raywatch
