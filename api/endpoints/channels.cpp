#include "storage/channels.hpp"

#include "api/call.hpp"
#include "api/conditional.hpp"
#include "api/endpoints/endpoints.hpp"
#include "api/endpoints/list_of_site.hpp"
#include "api/json_body.hpp"
#include "api/lookup.hpp"
#include "api/parse_channel.hpp"
#include "api/render.hpp"
#include "storage/events.hpp"

namespace raywatch::endpoints {
namespace {

ChannelRecord record_of(const Snapshot& snapshot, const GivenChannel& given) {
  ChannelRecord record = given.record;
  if (given.site) record.site = site_named(snapshot, *given.site).id;
  return record;
}

/// Who changed whom is told is worth an event.
void note(Transaction& transaction, const ChannelRecord& channel, const char* type, const char* what, Time now) {
  insert_event(transaction, {.at = now,
                             .type = type,
                             .site = channel.site,
                             .text = channel.by + " " + what + " channel " + channel.name + "."});
}

}  // namespace

HttpAnswer create_channel(Call& call) {
  call.query.finish();
  const GivenChannel given = parse_channel(json_body(call), nullptr);
  const Time now = call.services.now();
  const Json json = call.services.store.write([&](Transaction& transaction) {
    const ChannelRecord stored = insert_channel(transaction, record_of(transaction, given), now);
    note(transaction, stored, "channel.created", "made", now);
    return render(transaction, stored);
  });
  HttpAnswer answer = with_body_tag(json_answer(json, 201), std::nullopt);
  answer.set_header("Location", "/api/v1/channels/" + json["id"].dump());
  return answer;
}

HttpAnswer list_channels(Call& call) { return list_of_site(call, raywatch::list_channels); }

HttpAnswer get_channel(Call& call) {
  call.query.finish();
  const auto id = id_in_path<ChannelId>(call.path[0]);
  const Json json =
      call.services.store.read([&](const Snapshot& snapshot) { return render(snapshot, channel_with(snapshot, id)); });
  return with_body_tag(json_answer(json), call.header("If-None-Match"));
}

HttpAnswer replace_channel(Call& call) {
  call.query.finish();
  const auto id = id_in_path<ChannelId>(call.path[0]);
  const nlohmann::json body = json_body(call);
  const auto if_match = call.header("If-Match");
  const Time now = call.services.now();
  const Json json = call.services.store.write([&](Transaction& transaction) {
    const ChannelRecord before = channel_with(transaction, id);
    check_if_match(if_match, entity_tag(to_json_text(render(transaction, before))));
    ChannelRecord after = record_of(transaction, parse_channel(body, &before));
    after.id = id;
    const ChannelRecord stored = raywatch::replace_channel(transaction, after, now);
    note(transaction, stored, "channel.edited", "edited", now);
    return render(transaction, stored);
  });
  return with_body_tag(json_answer(json), std::nullopt);
}

HttpAnswer delete_channel(Call& call) {
  call.query.finish();
  call.services.commands.delete_channel(id_in_path<ChannelId>(call.path[0]));
  return {.status = 204};
}

HttpAnswer test_channel(Call& call) {
  call.query.finish();
  const ChannelTest test = call.services.commands.test_channel(id_in_path<ChannelId>(call.path[0]));
  return json_answer({{"delivered", test.delivered},
                      {"response_code", json_or_null(test.response_code)},
                      {"error", test.error.empty() ? Json(nullptr) : Json(test.error)},
                      {"took_ms", test.took_ms}});
}

}  // namespace raywatch::endpoints
