#include "api/call.hpp"
#include "api/endpoints/endpoints.hpp"
#include "api/endpoints/list_of_site.hpp"
#include "api/json_body.hpp"
#include "api/json_object.hpp"
#include "api/lookup.hpp"
#include "api/render.hpp"
#include "api/signature.hpp"
#include "storage/rules.hpp"

namespace raywatch::endpoints {
namespace {

struct GivenSilence {
  std::string site;
  std::optional<std::string> sensor;
  std::optional<ZoneId> zone;
  std::optional<Time> from;
  Time until;
  std::string by, note;
};

GivenSilence parse_silence(const nlohmann::json& json) {
  FieldErrors errors;
  JsonObject body(json, "", errors);
  GivenSilence given;
  for (const char* name : {"site", "until"}) body.require(name);
  given.site = body.text("site").value_or("");
  given.sensor = body.text("sensor");
  if (const auto zone = body.integer("zone", {.min = 1})) given.zone = ZoneId{*zone};
  given.from = body.time("from");
  const auto until = body.time("until");
  given.until = until.value_or(Time{});
  const Signature signature = parse_signature(body);
  given.by = signature.by;
  given.note = signature.note;
  if (given.from && until && *given.from >= *until) body.fail("until", "must be later than 'from'");
  body.finish();
  errors.throw_if_any();
  return given;
}

/// @param what is silenced, and the member that names it
void require_site(SiteId found, SiteId site, const std::string& what) {
  if (found == site) return;
  throw InvalidInput("The " + what + " is of another site.", {{what, "is of another site"}});
}

}  // namespace

HttpAnswer create_silence(Call& call) {
  call.query.finish();
  const GivenSilence given = parse_silence(json_body(call));
  const Time now = call.services.now();
  const Time from = given.from.value_or(now);
  if (from >= given.until) throw InvalidInput("The silence is over.", {{"until", "must lie in the future"}});
  const Json json = call.services.store.write([&](Transaction& transaction) {
    SilenceRecord record{.site = site_named(transaction, given.site).id, .by = given.by, .note = given.note};
    record.silence = {.zone = given.zone, .from = from, .until = given.until};
    if (given.sensor) {
      const Sensor sensor = sensor_named(transaction, *given.sensor);
      require_site(sensor.site, record.site, "sensor");
      record.silence.sensor = sensor.id;
    }
    if (given.zone) require_site(zone_with(transaction, *given.zone).site, record.site, "zone");
    return render(transaction, insert_silence(transaction, record, now));
  });
  HttpAnswer answer = json_answer(json, 201);
  answer.set_header("Location", "/api/v1/silences/" + json["id"].dump());
  return answer;
}

HttpAnswer list_silences(Call& call) { return list_of_site(call, raywatch::list_silences); }

HttpAnswer delete_silence(Call& call) {
  call.query.finish();
  const auto id = id_in_path<SilenceId>(call.path[0]);
  call.services.store.write(
      [&](Transaction& transaction) { raywatch::delete_silence(transaction, silence_with(transaction, id).id); });
  return {.status = 204};
}

}  // namespace raywatch::endpoints
