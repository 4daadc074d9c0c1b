#include "storage/surveys.hpp"

#include "api/call.hpp"
#include "api/conditional.hpp"
#include "api/endpoints/survey_endpoints.hpp"
#include "api/json_body.hpp"
#include "api/lookup.hpp"
#include "api/parse_survey.hpp"
#include "api/render.hpp"
#include "api/render_survey.hpp"

namespace raywatch::endpoints {
namespace {

struct GivenSurvey {
  std::string site;
  EpochId before, after;
  SurveyDefinition definition;
};

GivenSurvey parse_survey(const nlohmann::json& json) {
  FieldErrors errors;
  JsonObject body(json, "", errors);
  GivenSurvey given;
  for (const char* member : {"site", "before", "after"}) body.require(member);
  given.site = body.text("site").value_or("");
  given.before = EpochId{body.integer("before", {.min = 1}).value_or(0)};
  given.after = EpochId{body.integer("after", {.min = 1}).value_or(0)};
  given.definition = parse_definition(body, errors);
  body.finish();
  errors.throw_if_any();
  return given;
}

/// An epoch that a survey by hand may use.
EpochRecord usable_epoch(const Snapshot& snapshot, EpochId id, SiteId site, const char* member) {
  const EpochRecord epoch = epoch_with(snapshot, id);
  if (epoch.site == site && epoch.state != EpochState::refused) return epoch;
  throw InvalidInput("The epochs cannot be compared.", {{member, "must be an epoch of the site that was not refused"}});
}

RunRecord run_of(const Snapshot& snapshot, const GivenSurvey& given) {
  const SiteId site = site_named(snapshot, given.site).id;
  const EpochRecord before = usable_epoch(snapshot, given.before, site, "before");
  const EpochRecord after = usable_epoch(snapshot, given.after, site, "after");
  if (before.to > after.from) {
    throw InvalidInput("The epochs cannot be compared.",
                       {{"before", "must end before the epoch 'after' begins, at " + format_rfc3339(after.from)}});
  }
  check_zones(snapshot, given.definition, site);
  RunRecord run;
  run.site = site;
  run.due_at = after.to;
  run.from = after.from;
  run.to = after.to;
  run.definition = given.definition;
  run.epoch = after.id;
  run.reference = before.id;
  return run;
}

/// The survey that a path names, and what it found.
struct Found {
  SurveyRecord record;
  SurveyResult result;
};
Found found(const Snapshot& snapshot, SurveyId id) { return {survey_with(snapshot, id), survey_result(snapshot, id)}; }

}  // namespace

HttpAnswer create_survey(Call& call) {
  call.query.finish();
  const GivenSurvey given = parse_survey(json_body(call));
  const Time now = call.services.now();
  const Json json = call.services.store.write([&](Transaction& transaction) {
    return render(transaction, insert_run(transaction, run_of(transaction, given), now));
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

HttpAnswer list_surveys(Call& call) {
  const auto site_name = call.query.text("site");
  const auto schedule = call.query.integer("schedule", {.min = 1});
  const PageRequest page = call.query.page();
  call.query.finish();
  return json_answer(call.services.store.read([&](const Snapshot& snapshot) {
    SurveyFilter filter;
    if (site_name) filter.site = site_named(snapshot, *site_name).id;
    if (schedule) filter.schedule = ScheduleId{*schedule};
    return render_page(raywatch::list_surveys(snapshot, filter, page), [&](const SurveyRecord& survey) {
      return render(snapshot, survey, survey_result(snapshot, survey.id));
    });
  }));
}

HttpAnswer get_survey(Call& call) {
  call.query.finish();
  const auto id = id_in_path<SurveyId>(call.path[0]);
  const Json json = call.services.store.read([&](const Snapshot& snapshot) {
    const Found survey = found(snapshot, id);
    Json rendered = render(snapshot, survey.record, survey.result);
    rendered["ground"] = render_ground(snapshot, survey.record, survey.result);
    return rendered;
  });
  return with_body_tag(json_answer(json), call.header("If-None-Match"));
}

HttpAnswer get_survey_volumes(Call& call) {
  call.query.finish();
  const auto id = id_in_path<SurveyId>(call.path[0]);
  const Json json = call.services.store.read([&](const Snapshot& snapshot) {
    const Found survey = found(snapshot, id);
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
    const Found survey = found(snapshot, id);
    const Eigen::Vector3d origin_m = origin_of(site_with(snapshot, survey.record.site));
    return render_page(survey_changes(snapshot, id, page),
                       [&](const SurveyChange& change) { return render(change, survey.result, origin_m); });
  }));
}

}  // namespace raywatch::endpoints
