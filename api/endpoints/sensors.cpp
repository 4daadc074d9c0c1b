#include "storage/sensors.hpp"

#include "api/call.hpp"
#include "api/conditional.hpp"
#include "api/endpoints/endpoints.hpp"
#include "api/endpoints/list_of_site.hpp"
#include "api/json_body.hpp"
#include "api/json_object.hpp"
#include "api/lookup.hpp"
#include "api/name_rules.hpp"
#include "api/render.hpp"
#include "api/units.hpp"

namespace raywatch::endpoints {
namespace {

constexpr RealBounds kRange_m{.min = 0.0, .max = 1e6};
constexpr RealBounds kPositiveRange_m{.min = 0.0, .max = 1e6, .exclusive_min = true};
constexpr RealBounds kResolution_deg{.min = 0.0, .max = 90.0, .exclusive_min = true};
constexpr RealBounds kDivergence_mrad{.min = 0.0, .max = 1000.0};
constexpr RealBounds kInterval_s{.min = 0.0, .max = 1e9, .exclusive_min = true};

/// Writes a member into `value`: absent leaves it, null clears it.
template <class T>
void apply(JsonObject& body, const char* name, const std::optional<T>& given, std::optional<T>& value) {
  if (given || body.is_null(name)) value = given;
}

std::optional<Eigen::Vector2d> parse_resolution(JsonObject& body) {
  const auto values_deg = body.reals("angular_resolution_deg", 2, kResolution_deg);
  if (!values_deg) return std::nullopt;
  return Eigen::Vector2d(radians_of_deg((*values_deg)[0]), radians_of_deg((*values_deg)[1]));
}

std::optional<double> parse_divergence(JsonObject& body) {
  const auto value_mrad = body.real("beam_divergence_mrad", kDivergence_mrad);
  if (!value_mrad) return std::nullopt;
  return radians_of_mrad(*value_mrad);
}

void parse_model(JsonObject& body, SensorModel& model) {
  apply(body, "min_range_m", body.real("min_range_m", kRange_m), model.min_range_m);
  apply(body, "max_range_m", body.real("max_range_m", kPositiveRange_m), model.max_range_m);
  apply(body, "no_return_m", body.real("no_return_m", kPositiveRange_m), model.no_return_m);
  apply(body, "range_noise_m", body.real("range_noise_m", kRange_m), model.range_noise_m);
  apply(body, "angular_resolution_deg", parse_resolution(body), model.angular_resolution_rad);
  apply(body, "beam_divergence_mrad", parse_divergence(body), model.beam_divergence_rad);
  if (model.min_range_m && model.max_range_m && *model.min_range_m > *model.max_range_m) {
    body.fail("min_range_m", "must not be above max_range_m");
  }
}

struct NewSensor {
  Sensor sensor;
  std::string site;
};

NewSensor parse_sensor(const nlohmann::json& json) {
  FieldErrors errors;
  JsonObject body(json, "", errors);
  body.require("name");
  body.require("site");
  NewSensor parsed;
  parsed.sensor.name = body.parsed("name", checked_name).value_or("");
  parsed.site = body.text("site").value_or("");
  parsed.sensor.pose = body.pose("pose");
  parse_model(body, parsed.sensor.known);
  parsed.sensor.interval_s = body.real("interval_s", kInterval_s);
  body.finish();
  errors.throw_if_any();
  return parsed;
}

SensorEdit parse_edit(const nlohmann::json& json, const Sensor& before) {
  FieldErrors errors;
  JsonObject body(json, "", errors);
  SensorEdit edit;
  std::optional<Pose> pose = before.pose;
  std::optional<double> interval_s = before.interval_s;
  edit.known = before.known;
  apply(body, "pose", body.pose("pose"), pose);
  parse_model(body, *edit.known);
  apply(body, "interval_s", body.real("interval_s", kInterval_s), interval_s);
  body.finish();
  errors.throw_if_any();
  edit.pose = pose;
  edit.interval_s = interval_s;
  return edit;
}

}  // namespace

HttpAnswer create_sensor(Call& call) {
  call.query.finish();
  const NewSensor given = parse_sensor(json_body(call));
  const Time now = call.services.now();
  const Json json = call.services.store.write([&](Transaction& transaction) {
    Sensor sensor = given.sensor;
    sensor.site = site_named(transaction, given.site).id;
    return render(transaction, insert_sensor(transaction, sensor, now));
  });
  HttpAnswer answer = with_body_tag(json_answer(json, 201), std::nullopt);
  answer.set_header("Location", "/api/v1/sensors/" + percent_encoded(given.sensor.name));
  return answer;
}

HttpAnswer list_sensors(Call& call) { return list_of_site(call, raywatch::list_sensors); }

HttpAnswer get_sensor(Call& call) {
  call.query.finish();
  const Json json = call.services.store.read(
      [&](const Snapshot& snapshot) { return render(snapshot, sensor_named(snapshot, call.path[0])); });
  return with_body_tag(json_answer(json), call.header("If-None-Match"));
}

HttpAnswer edit_sensor(Call& call) {
  call.query.finish();
  const nlohmann::json body = json_body(call);
  const auto if_match = call.header("If-Match");
  const Json json = call.services.store.write([&](Transaction& transaction) {
    const Sensor before = sensor_named(transaction, call.path[0]);
    check_if_match(if_match, entity_tag(to_json_text(render(transaction, before))));
    return render(transaction, raywatch::edit_sensor(transaction, before.id, parse_edit(body, before)));
  });
  return with_body_tag(json_answer(json), std::nullopt);
}

HttpAnswer delete_sensor(Call& call) {
  call.query.finish();
  call.services.store.write([&](Transaction& transaction) {
    raywatch::delete_sensor(transaction, sensor_named(transaction, call.path[0]).id);
  });
  return {.status = 204};
}

}  // namespace raywatch::endpoints
