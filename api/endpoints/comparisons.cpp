#include "storage/comparisons.hpp"

#include <array>

#include "api/call.hpp"
#include "api/conditional.hpp"
#include "api/endpoints/comparison_request.hpp"
#include "api/endpoints/endpoints.hpp"
#include "api/json_body.hpp"
#include "api/lookup.hpp"
#include "api/render.hpp"
#include "api/wait_preference.hpp"
#include "core/profile.hpp"

namespace raywatch::endpoints {
namespace {

double progress_of(const Services& services, const ComparisonRecord& comparison) {
  switch (comparison.state) {
    case ComparisonState::queued:
      return 0.0;
    case ComparisonState::running:
      return services.commands.progress(comparison.id);
    case ComparisonState::done:
    case ComparisonState::failed:
      break;
  }
  return 1.0;
}

Json render_with_progress(const Services& services, const Snapshot& snapshot, const ComparisonRecord& comparison) {
  Json json = render(snapshot, comparison);
  json["progress"] = progress_of(services, comparison);
  return json;
}

ComparisonState parse_state(const std::string& name) {
  for (const auto state :
       {ComparisonState::queued, ComparisonState::running, ComparisonState::done, ComparisonState::failed})
    if (to_string(state) == name) return state;
  throw InvalidInput("must be queued, running, done or failed");
}

}  // namespace

HttpAnswer create_comparison(Call& call) {
  call.query.finish();
  const nlohmann::json body = json_body(call);
  const ComparisonRequest request =
      call.services.store.read([&](const Snapshot& snapshot) { return parse_comparison_request(snapshot, body); });
  const ComparisonRecord comparison =
      call.services.commands.compare(request.scan, request.reference, request.parameters);
  const auto wait = preferred_wait(call);
  if (wait) wait_for_scans(call, std::array{request.scan}, *wait);
  const Json json = call.services.store.read([&](const Snapshot& snapshot) {
    return render_with_progress(call.services, snapshot, comparison_with(snapshot, comparison.id));
  });
  HttpAnswer answer = json_answer(json, 202);
  answer.set_header("Location", "/api/v1/comparisons/" + std::to_string(comparison.id.value));
  if (wait) set_wait_applied(answer, *wait);
  return answer;
}

HttpAnswer get_site_parameters(Call& call) {
  const Grouping grouping = call.query.parsed("grouping", parse_grouping).value_or(Grouping::consensus);
  call.query.finish();
  const Site site =
      call.services.store.read([&](const Snapshot& snapshot) { return site_named(snapshot, call.path[0]); });
  return json_answer(render(default_parameters(site.profile, grouping)));
}

HttpAnswer list_comparisons(Call& call) {
  const auto site_name = call.query.text("site");
  const auto scan = call.query.integer("scan", {.min = 1});
  const auto state = call.query.parsed("state", parse_state);
  const PageRequest page = call.query.page();
  call.query.finish();
  return json_answer(call.services.store.read([&](const Snapshot& snapshot) {
    ComparisonFilter filter;
    if (site_name) filter.site = site_named(snapshot, *site_name).id;
    if (scan) filter.scan = ScanId{*scan};
    filter.state = state;
    return render_page(raywatch::list_comparisons(snapshot, filter, page), [&](const ComparisonRecord& comparison) {
      return render_with_progress(call.services, snapshot, comparison);
    });
  }));
}

HttpAnswer get_comparison(Call& call) {
  call.query.finish();
  const auto id = id_in_path<ComparisonId>(call.path[0]);
  const Json json = call.services.store.read([&](const Snapshot& snapshot) {
    return render_with_progress(call.services, snapshot, comparison_with(snapshot, id));
  });
  return with_body_tag(json_answer(json), call.header("If-None-Match"));
}

}  // namespace raywatch::endpoints
