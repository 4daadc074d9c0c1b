#include "storage/alerts.hpp"

#include "api/call.hpp"
#include "api/conditional.hpp"
#include "api/endpoints/endpoints.hpp"
#include "api/json_body.hpp"
#include "api/json_object.hpp"
#include "api/lookup.hpp"
#include "api/render.hpp"
#include "api/signature.hpp"
#include "storage/acceptance.hpp"

namespace raywatch::endpoints {
namespace {

/// Why it was raised: the rule as it was, the figures of the change, and the scans.
Json render_why(const Snapshot& snapshot, const AlertRecord& alert) {
  if (!alert.track) return nullptr;
  Json rule = {{"name", alert.rule_name}};
  rule.update(render_rule_body(alert.rule_then));
  Json observations = Json::array();
  for (const SightRun& run : sight_runs(snapshot, *alert.track)) observations.push_back(render(run));
  Json changes = Json::array(), priors = Json::array();
  if (alert.scan) {
    for (const ChangeRecord& change : changes_of_track(snapshot, *alert.track, *alert.scan)) {
      changes.push_back(change.id.value);
      if (!priors.empty()) continue;
      const std::optional<ComparisonRecord> comparison = find_comparison(snapshot, change.comparison);
      if (!comparison) continue;
      for (const ComparisonPrior& prior : comparison->priors) priors.push_back(prior.scan.value);
    }
  }
  return {{"rule", std::move(rule)},
          {"track", render(snapshot, track_with(snapshot, *alert.track))},
          {"observations", std::move(observations)},
          {"changes", std::move(changes)},
          {"priors", std::move(priors)}};
}

Json render_whole(const Snapshot& snapshot, const AlertRecord& alert) {
  Json json = render(snapshot, alert);
  Json history = Json::array();
  for (const AlertHistoryStep& step : alert_history(snapshot, alert.id)) history.push_back(render(step));
  json["history"] = std::move(history);
  json["why"] = render_why(snapshot, alert);
  return json;
}

struct GivenAction {
  Signature signature;
  std::optional<Time> until;
};

GivenAction parse_action(const nlohmann::json& json, bool has_end) {
  FieldErrors errors;
  JsonObject body(json, "", errors);
  GivenAction action;
  action.signature = parse_signature(body);
  if (has_end) {
    body.require("until");
    action.until = body.time("until");
  }
  body.finish();
  errors.throw_if_any();
  return action;
}

void require_standing(const AlertRecord& alert) {
  if (alert.state != AlertState::resolved) return;
  throw Conflict("Alert " + std::to_string(alert.id.value) + " is resolved already.");
}

/// Reads the action, carries it out in one transaction, and answers with the alert.
template <class Act>
HttpAnswer act(Call& call, bool has_end, const Act& carry_out) {
  call.query.finish();
  const auto id = id_in_path<AlertId>(call.path[0]);
  const GivenAction action = parse_action(json_body(call), has_end);
  const auto if_match = call.header("If-Match");
  const Time now = call.services.now();
  if (action.until && *action.until <= now) {
    throw InvalidInput("The snooze is over.", {{"until", "must lie in the future"}});
  }
  const Json json = call.services.store.write([&](Transaction& transaction) {
    const AlertRecord alert = alert_with(transaction, id);
    check_if_match(if_match, entity_tag(to_json_text(render_whole(transaction, alert))));
    require_standing(alert);
    carry_out(transaction, alert, action, now);
    return render_whole(transaction, alert_with(transaction, id));
  });
  return with_body_tag(json_answer(json), std::nullopt);
}

/// What only changes the alert itself.
HttpAnswer change_state(Call& call, const std::string& name, AlertState state) {
  return act(call, state == AlertState::snoozed,
             [&](Transaction& transaction, const AlertRecord& alert, const GivenAction& action, Time now) {
               change_alert(transaction, alert.id,
                            {.action = name,
                             .by = action.signature.by,
                             .note = action.signature.note,
                             .at = now,
                             .state = state,
                             .snoozed_until = action.until});
             });
}

}  // namespace

HttpAnswer list_alerts(Call& call) {
  const auto site_name = call.query.text("site");
  AlertFilter filter;
  filter.state = call.query.parsed("state", parse_alert_state);
  filter.severity = call.query.parsed("severity", parse_severity);
  const PageRequest page = call.query.page();
  call.query.finish();
  return json_answer(call.services.store.read([&](const Snapshot& snapshot) {
    if (site_name) filter.site = site_named(snapshot, *site_name).id;
    return render_page(raywatch::list_alerts(snapshot, filter, page),
                       [&](const AlertRecord& alert) { return render(snapshot, alert); });
  }));
}

HttpAnswer get_alert(Call& call) {
  call.query.finish();
  const auto id = id_in_path<AlertId>(call.path[0]);
  const Json json = call.services.store.read(
      [&](const Snapshot& snapshot) { return render_whole(snapshot, alert_with(snapshot, id)); });
  return with_body_tag(json_answer(json), call.header("If-None-Match"));
}

HttpAnswer acknowledge_alert(Call& call) { return change_state(call, "acknowledged", AlertState::acknowledged); }
HttpAnswer resolve_alert(Call& call) { return change_state(call, "resolved", AlertState::resolved); }
HttpAnswer snooze_alert(Call& call) { return change_state(call, "snoozed", AlertState::snoozed); }

HttpAnswer accept_alert(Call& call) {
  return act(call, false, [](Transaction& transaction, const AlertRecord& alert, const GivenAction& action, Time now) {
    if (!alert.track) throw Conflict("Only what was added or removed can be accepted as normal.");
    accept_track(transaction, *alert.track, {.by = action.signature.by, .note = action.signature.note, .at = now});
  });
}

}  // namespace raywatch::endpoints
