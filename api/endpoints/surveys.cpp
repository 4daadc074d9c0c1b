#include "storage/surveys.hpp"

#include <optional>
#include <variant>

#include "api/call.hpp"
#include "api/conditional.hpp"
#include "api/endpoints/survey_endpoints.hpp"
#include "api/json_body.hpp"
#include "api/lookup.hpp"
#include "api/parse_survey.hpp"
#include "api/render.hpp"
#include "api/render_survey.hpp"
#include "api/signature.hpp"
#include "storage/epochs.hpp"
#include "storage/events.hpp"

namespace raywatch::endpoints {
namespace {

/// An epoch that there is, or the window of one that is to be made.
using EpochOrWindow = std::variant<EpochId, GivenWindow>;

struct GivenSurvey {
  std::string site;
  EpochOrWindow before, after;
  SurveyDefinition definition;
};

EpochOrWindow parse_epoch_or_window(JsonObject& body, const char* member) {
  body.require(member);
  const nlohmann::json* value = body.any(member);
  if (value == nullptr || !value->is_object()) return EpochId{body.integer(member, {.min = 1}).value_or(0)};
  JsonObject window = body.object(member).value();
  GivenWindow given = parse_window(window);
  window.finish();
  return given;
}

GivenSurvey parse_survey(const nlohmann::json& json) {
  FieldErrors errors;
  JsonObject body(json, "", errors);
  GivenSurvey given;
  body.require("site");
  given.site = body.text("site").value_or("");
  given.before = parse_epoch_or_window(body, "before");
  given.after = parse_epoch_or_window(body, "after");
  given.definition = parse_definition(body, errors);
  body.finish();
  errors.throw_if_any();
  return given;
}

/// An epoch that a survey by hand may use; one of a window has no id yet.
EpochRecord usable_epoch(const Snapshot& snapshot, const EpochOrWindow& given, SiteId site, const std::string& member) {
  if (const auto* window = std::get_if<GivenWindow>(&given)) {
    return epoch_of_window(snapshot, site, *window, member + ".");
  }
  const std::optional<EpochRecord> epoch = find_epoch(snapshot, std::get<EpochId>(given));
  if (epoch && epoch->site == site && epoch->state != EpochState::refused) return *epoch;
  throw InvalidInput("The epochs cannot be compared.", {{member, "must be an epoch of the site that was not refused"}});
}

/// The run of a survey; epochs of windows are made for it.
RunRecord run_of(Transaction& transaction, const GivenSurvey& given, Time now) {
  const SiteId site = site_named(transaction, given.site).id;
  const EpochRecord before = usable_epoch(transaction, given.before, site, "before");
  const EpochRecord after = usable_epoch(transaction, given.after, site, "after");
  if (before.to > after.from) {
    throw InvalidInput("The epochs cannot be compared.",
                       {{"before", "must end before the epoch 'after' begins, at " + format_rfc3339(after.from)}});
  }
  check_zones(transaction, given.definition, site);
  const auto stored = [&](const EpochRecord& epoch) {
    return epoch.id.value > 0 ? epoch.id : insert_epoch(transaction, epoch, now).id;
  };
  RunRecord run;
  run.site = site;
  run.due_at = after.to;
  run.from = after.from;
  run.to = after.to;
  run.definition = given.definition;
  run.reference = stored(before);
  run.epoch = stored(after);
  return run;
}

/// @returns why the run ends.
std::string parse_cancellation(const nlohmann::json& json) {
  FieldErrors errors;
  JsonObject body(json, "", errors);
  const Signature signature = parse_signature(body);
  body.finish();
  errors.throw_if_any();
  return "cancelled by " + signature.by + (signature.note.empty() ? "" : ": " + signature.note);
}

/// The survey that a path names, and what it found.
ListedSurvey found(const Snapshot& snapshot, SurveyId id) {
  const SurveyRecord record = survey_with(snapshot, id);
  return {record, site_with(snapshot, record.site).name, survey_result(snapshot, id)};
}

}  // namespace

HttpAnswer create_survey(Call& call) {
  call.query.finish();
  const GivenSurvey given = parse_survey(json_body(call));
  const Time now = call.services.now();
  const Json json = call.services.store.write([&](Transaction& transaction) {
    return render(transaction, insert_run(transaction, run_of(transaction, given, now), now));
  });
  HttpAnswer answer = json_answer(json, 202);
  answer.set_header("Location", "/api/v1/surveys/runs/" + json["id"].dump());
  return answer;
}

HttpAnswer list_survey_runs(Call& call) {
  const auto site_name = call.query.text("site");
  const PageRequest page = call.query.page();
  call.query.finish();
  return json_answer(call.services.store.read([&](const Snapshot& snapshot) {
    RunFilter filter;
    if (site_name) filter.site = site_named(snapshot, *site_name).id;
    return render_page(list_runs(snapshot, filter, page), [&](const RunRecord& run) { return render(snapshot, run); });
  }));
}

HttpAnswer get_survey_run(Call& call) {
  call.query.finish();
  const auto id = id_in_path<RunId>(call.path[0]);
  return json_answer(
      call.services.store.read([&](const Snapshot& snapshot) { return render(snapshot, run_with(snapshot, id)); }));
}

HttpAnswer cancel_survey_run(Call& call) {
  call.query.finish();
  const auto id = id_in_path<RunId>(call.path[0]);
  const std::string why = parse_cancellation(json_body(call));
  const Time now = call.services.now();
  return json_answer(call.services.store.write([&](Transaction& transaction) {
    const RunRecord run = run_with(transaction, id);
    if (!cancel_run(transaction, id, why, now)) {
      throw Conflict("Run " + std::to_string(id.value) + " has ended already: it is " +
                     std::string(to_string(run.state)) + ".");
    }
    insert_event(transaction, {.at = now,
                               .type = "survey.cancelled",
                               .site = run.site,
                               .text = "Run " + std::to_string(id.value) + " of a survey: " + why});
    return render(transaction, run_with(transaction, id));
  }));
}

HttpAnswer list_surveys(Call& call) {
  const auto site_name = call.query.text("site");
  const auto schedule = call.query.integer("schedule", {.min = 1});
  const PageRequest page = call.query.page();
  call.query.finish();
  return json_answer(call.services.store.read([&](const Snapshot& snapshot) {
    SurveyFilter filter;
    if (site_name) filter.site = site_named(snapshot, *site_name).id;
    if (schedule) filter.schedule = ScheduleId{*schedule};
    return render_page(raywatch::list_surveys(snapshot, filter, page),
                       [](const ListedSurvey& survey) { return render(survey); });
  }));
}

HttpAnswer get_survey(Call& call) {
  call.query.finish();
  const auto id = id_in_path<SurveyId>(call.path[0]);
  const Json json = call.services.store.read([&](const Snapshot& snapshot) {
    const ListedSurvey survey = found(snapshot, id);
    Json rendered = render(survey);
    rendered["ground"] = render_ground(snapshot, survey.record, survey.result);
    return rendered;
  });
  return with_body_tag(json_answer(json), call.header("If-None-Match"));
}

HttpAnswer get_survey_volumes(Call& call) {
  call.query.finish();
  const auto id = id_in_path<SurveyId>(call.path[0]);
  const Json json = call.services.store.read([&](const Snapshot& snapshot) {
    const ListedSurvey survey = found(snapshot, id);
    Json zones = Json::array();
    for (const ZoneFigures& figures : survey.result.zones) zones.push_back(render(figures));
    return Json{{"survey", id.value}, {"zones", std::move(zones)}, {"total", render(survey.result.total)}};
  });
  return with_body_tag(json_answer(json), call.header("If-None-Match"));
}

HttpAnswer list_survey_changes(Call& call) {
  const PageRequest page = call.query.page();
  call.query.finish();
  const auto id = id_in_path<SurveyId>(call.path[0]);
  return json_answer(call.services.store.read([&](const Snapshot& snapshot) {
    const ListedSurvey survey = found(snapshot, id);
    const Eigen::Vector3d origin_m = origin_of(site_with(snapshot, survey.record.site));
    return render_page(survey_changes(snapshot, id, page),
                       [&](const SurveyChange& change) { return render(change, survey.result, origin_m); });
  }));
}

}  // namespace raywatch::endpoints
