#include "storage/schedules.hpp"

#include "api/call.hpp"
#include "api/conditional.hpp"
#include "api/endpoints/survey_endpoints.hpp"
#include "api/json_body.hpp"
#include "api/lookup.hpp"
#include "api/parse_survey.hpp"
#include "api/render.hpp"
#include "api/render_survey.hpp"
#include "storage/schedule_runs.hpp"

namespace raywatch::endpoints {
namespace {

Json rendered(Call& call, const Snapshot& snapshot, const ScheduleRecord& schedule) {
  return render(snapshot, schedule, next_run_of(schedule, call.services.now()));
}

/// The record that is given, with all that it names.
ScheduleRecord resolved(const Snapshot& snapshot, const GivenSchedule& given) {
  const Site site = site_named(snapshot, given.site);
  ScheduleRecord schedule;
  schedule.site = site.id;
  schedule.name = given.name;
  schedule.enabled = given.enabled;
  schedule.plan = given.plan;
  if (schedule.plan.time_zone.empty()) schedule.plan.time_zone = site.time_zone;
  schedule.plan.sensors = sensors_named(snapshot, given.sensors, site.id, "sensors");
  schedule.plan.required_sensors = sensors_named(snapshot, given.required_sensors, site.id, "required_sensors");
  check_zones(snapshot, schedule.plan.definition, site.id);
  return schedule;
}

}  // namespace

HttpAnswer create_schedule(Call& call) {
  call.query.finish();
  const Time now = call.services.now();
  const GivenSchedule given = parse_schedule(json_body(call), now);
  const Json json = call.services.store.write([&](Transaction& transaction) {
    ScheduleRecord schedule = resolved(transaction, given);
    schedule.looked_until = given.since.value_or(now);
    return rendered(call, transaction, insert_schedule(transaction, schedule, now));
  });
  HttpAnswer answer = with_body_tag(json_answer(json, 201), std::nullopt);
  answer.set_header("Location", "/api/v1/schedules/" + json["id"].dump());
  return answer;
}

HttpAnswer list_schedules(Call& call) {
  const auto site_name = call.query.text("site");
  const PageRequest page = call.query.page();
  call.query.finish();
  return json_answer(call.services.store.read([&](const Snapshot& snapshot) {
    std::optional<SiteId> site;
    if (site_name) site = site_named(snapshot, *site_name).id;
    return render_page(raywatch::list_schedules(snapshot, site, page),
                       [&](const ScheduleRecord& schedule) { return rendered(call, snapshot, schedule); });
  }));
}

HttpAnswer get_schedule(Call& call) {
  call.query.finish();
  const auto id = id_in_path<ScheduleId>(call.path[0]);
  const Json json = call.services.store.read(
      [&](const Snapshot& snapshot) { return rendered(call, snapshot, schedule_with(snapshot, id)); });
  return with_body_tag(json_answer(json), call.header("If-None-Match"));
}

HttpAnswer replace_schedule(Call& call) {
  call.query.finish();
  const auto id = id_in_path<ScheduleId>(call.path[0]);
  const Time now = call.services.now();
  const GivenSchedule given = parse_schedule(json_body(call), now);
  const auto if_match = call.header("If-Match");
  const Json json = call.services.store.write([&](Transaction& transaction) {
    const ScheduleRecord before = schedule_with(transaction, id);
    check_if_match(if_match, entity_tag(to_json_text(rendered(call, transaction, before))));
    ScheduleRecord after = resolved(transaction, given);
    if (after.site != before.site) throw Conflict("A schedule cannot go to another site.");
    after.id = id;
    // What was due while it was disabled was not missed.
    after.looked_until = given.since.value_or(before.enabled ? before.looked_until : now);
    return rendered(call, transaction, raywatch::replace_schedule(transaction, after, now));
  });
  return with_body_tag(json_answer(json), std::nullopt);
}

HttpAnswer delete_schedule(Call& call) {
  call.query.finish();
  const auto id = id_in_path<ScheduleId>(call.path[0]);
  call.services.store.write(
      [&](Transaction& transaction) { raywatch::delete_schedule(transaction, schedule_with(transaction, id).id); });
  return {.status = 204};
}

HttpAnswer run_schedule(Call& call) {
  call.query.finish();
  const auto id = id_in_path<ScheduleId>(call.path[0]);
  const Time now = call.services.now();
  const Json json = call.services.store.write([&](Transaction& transaction) {
    const ScheduleRecord schedule = schedule_with(transaction, id);
    return render(transaction, insert_run(transaction, run_of(schedule, now), now));
  });
  HttpAnswer answer = json_answer(json, 202);
  answer.set_header("Location", "/api/v1/surveys/runs/" + json["id"].dump());
  return answer;
}

HttpAnswer list_schedule_runs(Call& call) {
  const PageRequest page = call.query.page();
  call.query.finish();
  const auto id = id_in_path<ScheduleId>(call.path[0]);
  return json_answer(call.services.store.read([&](const Snapshot& snapshot) {
    schedule_with(snapshot, id);
    return render_page(list_runs(snapshot, {.site = {}, .schedule = id}, page),
                       [&](const RunRecord& run) { return render(snapshot, run); });
  }));
}

}  // namespace raywatch::endpoints
