#include "api/lookup.hpp"
#include "api/render.hpp"
#include "api/units.hpp"

namespace raywatch {
namespace {

Json render_resolution(const std::optional<Eigen::Vector2d>& resolution_rad) {
  if (!resolution_rad) return nullptr;
  return Json::array({deg_of_radians(resolution_rad->x()), deg_of_radians(resolution_rad->y())});
}

Json render_model(const SensorModel& model) {
  Json divergence = model.beam_divergence_rad ? Json(mrad_of_radians(*model.beam_divergence_rad)) : Json(nullptr);
  return {{"min_range_m", json_or_null(model.min_range_m)},
          {"max_range_m", json_or_null(model.max_range_m)},
          {"no_return_m", json_or_null(model.no_return_m)},
          {"range_noise_m", json_or_null(model.range_noise_m)},
          {"angular_resolution_deg", render_resolution(model.angular_resolution_rad)},
          {"beam_divergence_mrad", std::move(divergence)}};
}

/// What scans showed of what was not given. The figures that comparisons use are the given ones, then these.
Json render_estimated(const Json& known, const SensorModel& estimated) {
  Json shown = Json::object();
  const Json all = render_model(estimated);
  for (const auto& [name, value] : all.items())
    if (known.at(name).is_null() && !value.is_null()) shown[name] = value;
  return shown;
}

}  // namespace

Json render(const Snapshot& snapshot, const Sensor& sensor) {
  Json known = render_model(sensor.known);
  Json json = {{"name", sensor.name},
               {"site", site_with(snapshot, sensor.site).name},
               {"pose", sensor.pose ? render(*sensor.pose) : Json(nullptr)}};
  Json estimated = render_estimated(known, sensor.estimated);
  json.update(known);
  json["interval_s"] = json_or_null(sensor.interval_s);
  json["estimated"] = std::move(estimated);
  json["created_at"] = format_rfc3339(sensor.created_at);
  return json;
}

}  // namespace raywatch
