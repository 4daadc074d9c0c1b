#include "storage/rules.hpp"

#include "api/call.hpp"
#include "api/conditional.hpp"
#include "api/endpoints/endpoints.hpp"
#include "api/endpoints/list_of_site.hpp"
#include "api/json_body.hpp"
#include "api/json_object.hpp"
#include "api/lookup.hpp"
#include "api/name_rules.hpp"
#include "api/render.hpp"
#include "storage/rehearsal.hpp"

namespace raywatch::endpoints {
namespace {

struct GivenRule {
  std::optional<std::string> site;
  std::string name;
  Rule rule;
};

void parse_kinds(JsonObject& body, Rule& rule) {
  const nlohmann::json* kinds = body.any("kinds");
  if (kinds == nullptr) return;
  rule.added = rule.removed = false;
  const bool fine = kinds->is_array() && std::ranges::all_of(*kinds, [](const nlohmann::json& kind) {
                      return kind == "added" || kind == "removed";
                    });
  if (!fine) return body.fail("kinds", "must be an array of added, removed");
  for (const nlohmann::json& kind : *kinds) (kind == "added" ? rule.added : rule.removed) = true;
}

ScheduleWindow parse_schedule_window(JsonObject window, FieldErrors& errors, const std::string& name) {
  ScheduleWindow result;
  if (const nlohmann::json* days = window.any("days")) {
    result.days = {};
    try {
      for (const auto& day : days->get<std::vector<std::string>>()) result.days[parse_weekday(day)] = true;
    } catch (const nlohmann::json::exception&) {
      errors.add(name + ".days", "must be an array of mon, tue, wed, thu, fri, sat, sun");
    } catch (const Error& error) {
      errors.add(name + ".days", error.what());
    }
  }
  result.from_minute = window.parsed("from", parse_minute_of_day).value_or(result.from_minute);
  result.to_minute = window.parsed("to", parse_minute_of_day).value_or(result.to_minute);
  window.finish();
  return result;
}

void parse_schedule_windows(JsonObject& body, FieldErrors& errors, Rule& rule) {
  constexpr std::size_t kMostWindows = 100;
  const nlohmann::json* windows = body.any("schedule");
  if (windows == nullptr || windows->is_null()) return;
  if (!windows->is_array() || windows->size() > kMostWindows) {
    return body.fail("schedule", R"(must be an array of at most 100 windows {"days", "from", "to"})");
  }
  for (std::size_t i = 0; i < windows->size(); ++i) {
    const std::string name = "schedule." + std::to_string(i);
    rule.schedule.push_back(parse_schedule_window(JsonObject((*windows)[i], name, errors), errors, name));
  }
}

void parse_persistence(JsonObject& body, Rule& rule) {
  auto given = body.object("persistence");
  if (!given) return;
  Persistence& p = rule.persistence;
  p.scans = static_cast<std::uint32_t>(given->integer("scans", {.min = 1, .max = 64}).value_or(1));
  p.of = static_cast<std::uint32_t>(given->integer("of", {.min = 1, .max = 64}).value_or(p.scans));
  p.seconds = given->real("seconds", {.min = 0.0, .max = 1e9}).value_or(0.0);
  given->finish();
}

GivenRule parse_rule(const nlohmann::json& json, const std::string& place, FieldErrors& errors) {
  JsonObject body(json, place, errors);
  GivenRule given;
  body.require("name");
  given.site = body.text("site");
  given.name = body.parsed("name", checked_name).value_or("");
  Rule& rule = given.rule;
  if (const auto zone = body.integer("zone", {.min = 1})) rule.zone = ZoneId{*zone};
  parse_kinds(body, rule);
  rule.min_points =
      static_cast<std::uint64_t>(body.integer("min_points", {.min = 0, .max = 1'000'000'000}).value_or(0));
  rule.min_volume_m3 = body.real("min_volume_m3", {.min = 0.0}).value_or(0.0);
  rule.min_extent_m = body.real("min_extent_m", {.min = 0.0}).value_or(0.0);
  parse_persistence(body, rule);
  rule.severity = body.parsed("severity", parse_severity).value_or(rule.severity);
  parse_schedule_windows(body, errors, rule);
  rule.enabled = body.flag("enabled").value_or(true);
  rule.auto_resolve = body.flag("auto_resolve").value_or(true);
  body.finish();
  return given;
}

GivenRule parse_whole_rule(const nlohmann::json& json) {
  FieldErrors errors;
  GivenRule given = parse_rule(json, "", errors);
  errors.throw_if_any();
  check_rule(given.rule);
  return given;
}

/// The site of a new rule: as given, or that of its zone.
Site site_of(const Snapshot& snapshot, const GivenRule& given) {
  if (given.site) return site_named(snapshot, *given.site);
  if (given.rule.zone) return site_with(snapshot, zone_with(snapshot, *given.rule.zone).site);
  throw InvalidInput("The rule needs a site.", {{"site", "is required, unless a zone is given"}});
}

}  // namespace

HttpAnswer create_rule(Call& call) {
  call.query.finish();
  const GivenRule given = parse_whole_rule(json_body(call));
  const Time now = call.services.now();
  const Json json = call.services.store.write([&](Transaction& transaction) {
    const Site site = site_of(transaction, given);
    return render(transaction,
                  insert_rule(transaction, {.rule = given.rule, .site = site.id, .name = given.name}, now));
  });
  HttpAnswer answer = with_body_tag(json_answer(json, 201), std::nullopt);
  answer.set_header("Location", "/api/v1/rules/" + json["id"].dump());
  return answer;
}

HttpAnswer list_rules(Call& call) { return list_of_site(call, raywatch::list_rules); }

HttpAnswer get_rule(Call& call) {
  call.query.finish();
  const auto id = id_in_path<RuleId>(call.path[0]);
  const Json json =
      call.services.store.read([&](const Snapshot& snapshot) { return render(snapshot, rule_with(snapshot, id)); });
  return with_body_tag(json_answer(json), call.header("If-None-Match"));
}

HttpAnswer replace_rule(Call& call) {
  call.query.finish();
  const auto id = id_in_path<RuleId>(call.path[0]);
  const GivenRule given = parse_whole_rule(json_body(call));
  const auto if_match = call.header("If-Match");
  const Time now = call.services.now();
  const Json json = call.services.store.write([&](Transaction& transaction) {
    const RuleRecord before = rule_with(transaction, id);
    check_if_match(if_match, entity_tag(to_json_text(render(transaction, before))));
    if (given.site && *given.site != site_with(transaction, before.site).name) {
      throw Conflict("A rule cannot go to another site.");
    }
    RuleRecord after{.rule = given.rule, .site = before.site, .name = given.name};
    after.rule.id = id;
    return render(transaction, raywatch::replace_rule(transaction, after, now));
  });
  return with_body_tag(json_answer(json), std::nullopt);
}

HttpAnswer delete_rule(Call& call) {
  call.query.finish();
  const auto id = id_in_path<RuleId>(call.path[0]);
  call.services.store.write(
      [&](Transaction& transaction) { raywatch::delete_rule(transaction, rule_with(transaction, id).rule.id); });
  return {.status = 204};
}

HttpAnswer test_rule(Call& call) {
  call.query.finish();
  const auto id = id_in_path<RuleId>(call.path[0]);
  const nlohmann::json json = json_body(call);
  FieldErrors errors;
  JsonObject body(json, "", errors);
  const Time from = body.time("from").value_or(Time::min());
  const Time to = body.time("to").value_or(Time::max());
  if (from >= to) body.fail("to", "must be later than 'from'");
  std::optional<GivenRule> changed;
  if (const nlohmann::json* rule = body.any("rule"); rule != nullptr && !rule->is_null()) {
    changed = parse_rule(*rule, "rule", errors);
  }
  body.finish();
  errors.throw_if_any();
  if (changed) check_rule(changed->rule);
  return json_answer(call.services.store.read([&](const Snapshot& snapshot) {
    const RuleRecord record = rule_with(snapshot, id);
    Rule rule = changed ? changed->rule : record.rule;
    rule.id = id;
    Json alerts = Json::array();
    for (const RehearsedAlert& alert : rehearse(snapshot, rule, site_with(snapshot, record.site), from, to)) {
      alerts.push_back({{"track", alert.track.value},
                        {"scan", alert.scan.value},
                        {"at", format_rfc3339(alert.at)},
                        {"severity", to_string(alert.severity)},
                        {"resolved_at", render(alert.resolved_at)}});
    }
    return Json{{"rule", id.value}, {"alerts", std::move(alerts)}};
  }));
}

}  // namespace raywatch::endpoints
