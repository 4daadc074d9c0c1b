#include "storage/deliveries.hpp"

#include "api/call.hpp"
#include "api/endpoints/endpoints.hpp"
#include "api/json_body.hpp"
#include "api/json_object.hpp"
#include "api/lookup.hpp"
#include "api/name_rules.hpp"
#include "api/render.hpp"
#include "storage/events.hpp"

namespace raywatch::endpoints {
namespace {

std::string parse_who(const nlohmann::json& json) {
  FieldErrors errors;
  JsonObject body(json, "", errors);
  body.require("by");
  const auto by = body.parsed("by", checked_actor);
  body.finish();
  errors.throw_if_any();
  return *by;
}

}  // namespace

HttpAnswer list_deliveries(Call& call) {
  DeliveryFilter filter;
  if (const auto channel = call.query.integer("channel", {.min = 1})) filter.channel = ChannelId{*channel};
  filter.state = call.query.parsed("state", parse_delivery_state);
  if (const auto alert = call.query.integer("alert", {.min = 1})) filter.alert = AlertId{*alert};
  const PageRequest page = call.query.page();
  call.query.finish();
  return json_answer(call.services.store.read([&](const Snapshot& snapshot) {
    return render_page(raywatch::list_deliveries(snapshot, filter, page),
                       [&](const DeliveryRecord& delivery) { return render(snapshot, delivery); });
  }));
}

HttpAnswer retry_delivery(Call& call) {
  call.query.finish();
  const auto id = id_in_path<DeliveryId>(call.path[0]);
  const std::string by = parse_who(json_body(call));
  const Time now = call.services.now();
  return json_answer(call.services.store.write([&](Transaction& transaction) {
    const DeliveryRecord queued = raywatch::retry_delivery(transaction, delivery_with(transaction, id).id, now);
    insert_event(transaction, {.at = now,
                               .type = "delivery.retried",
                               .text = by + " had delivery " + std::to_string(id.value) + " sent again."});
    return render(transaction, queued);
  }));
}

}  // namespace raywatch::endpoints
