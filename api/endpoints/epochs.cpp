#include "storage/epochs.hpp"

#include "api/call.hpp"
#include "api/conditional.hpp"
#include "api/endpoints/list_of_site.hpp"
#include "api/endpoints/survey_endpoints.hpp"
#include "api/json_body.hpp"
#include "api/json_object.hpp"
#include "api/lookup.hpp"
#include "api/name_rules.hpp"
#include "api/parse_survey.hpp"
#include "api/render_survey.hpp"
#include "api/signature.hpp"

namespace raywatch::endpoints {
namespace {

struct GivenEpoch {
  std::string site;
  std::optional<std::string> name;
  GivenWindow window;
};

GivenEpoch parse_epoch(const nlohmann::json& json) {
  FieldErrors errors;
  JsonObject body(json, "", errors);
  GivenEpoch given;
  body.require("site");
  given.site = body.text("site").value_or("");
  given.name = body.parsed("name", checked_name);
  given.window = parse_window(body);
  body.finish();
  errors.throw_if_any();
  return given;
}

}  // namespace

HttpAnswer create_epoch(Call& call) {
  call.query.finish();
  const GivenEpoch given = parse_epoch(json_body(call));
  const Time now = call.services.now();
  const Json json = call.services.store.write([&](Transaction& transaction) {
    EpochRecord epoch = epoch_of_window(transaction, site_named(transaction, given.site).id, given.window, "");
    if (given.name) epoch.name = *given.name;
    return render(transaction, insert_epoch(transaction, epoch, now));
  });
  HttpAnswer answer = with_body_tag(json_answer(json, 201), std::nullopt);
  answer.set_header("Location", "/api/v1/epochs/" + json["id"].dump());
  return answer;
}

HttpAnswer list_epochs(Call& call) { return list_of_site(call, raywatch::list_epochs); }

HttpAnswer get_epoch(Call& call) {
  call.query.finish();
  const auto id = id_in_path<EpochId>(call.path[0]);
  const Json json =
      call.services.store.read([&](const Snapshot& snapshot) { return render(snapshot, epoch_with(snapshot, id)); });
  return with_body_tag(json_answer(json), call.header("If-None-Match"));
}

HttpAnswer accept_epoch(Call& call) {
  call.query.finish();
  const auto id = id_in_path<EpochId>(call.path[0]);
  const nlohmann::json json = json_body(call);
  FieldErrors errors;
  JsonObject body(json, "", errors);
  const Signature signature = parse_signature(body);
  body.finish();
  errors.throw_if_any();
  const Time now = call.services.now();
  return json_answer(call.services.store.write([&](Transaction& transaction) {
    const EpochRecord epoch = epoch_with(transaction, id);
    return render(transaction, raywatch::accept_epoch(transaction, epoch.id, {signature.by, signature.note, now}));
  }));
}

HttpAnswer delete_epoch(Call& call) {
  call.query.finish();
  const auto id = id_in_path<EpochId>(call.path[0]);
  call.services.store.write(
      [&](Transaction& transaction) { raywatch::delete_epoch(transaction, epoch_with(transaction, id).id); });
  return {.status = 204};
}

}  // namespace raywatch::endpoints
