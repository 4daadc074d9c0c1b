#include "api/call.hpp"
#include "api/conditional.hpp"
#include "api/endpoints/endpoints.hpp"
#include "api/lookup.hpp"
#include "api/render.hpp"
#include "storage/comparisons.hpp"

namespace raywatch::endpoints {
namespace {

/// Which comparisons' changes are listed: what just happened, or what lasts.
bool parse_lasting(const std::string& name) {
  if (name == "previous") return false;
  if (name == "baseline") return true;
  throw InvalidInput("must be previous or baseline");
}

JsonText list(const Snapshot& snapshot, const ChangeFilter& filter, const PageRequest& page) {
  return render_page(raywatch::list_changes(snapshot, filter, page),
                     [&](const ChangeRecord& change) { return render(snapshot, change); });
}

}  // namespace

HttpAnswer list_changes(Call& call) {
  ChangeFilter filter;
  const auto site_name = call.query.text("site");
  filter.kind = call.query.parsed("kind", parse_change_kind);
  filter.watching = call.query.parsed("reference", parse_lasting).value_or(false);
  const TimeRange range = call.query.time_range();
  filter.from = range.from;
  filter.to = range.to;
  filter.min_volume_m3 = call.query.real("min_volume_m3", {.min = 0.0});
  const auto box_m = call.query.box("box");
  if (box_m && !site_name) call.query.fail("box", "needs 'site', in whose coordinates it stands");
  const PageRequest page = call.query.page();
  call.query.finish();
  return json_answer(call.services.store.read([&](const Snapshot& snapshot) {
    if (site_name) {
      const Site site = site_named(snapshot, *site_name);
      filter.site = site.id;
      if (box_m) filter.box_m = box_m->translated(-origin_of(site));
    }
    return list(snapshot, filter, page);
  }));
}

HttpAnswer list_comparison_changes(Call& call) {
  const PageRequest page = call.query.page();
  call.query.finish();
  const auto id = id_in_path<ComparisonId>(call.path[0]);
  return json_answer(call.services.store.read([&](const Snapshot& snapshot) {
    ChangeFilter filter;
    filter.comparison = comparison_with(snapshot, id).id;
    return list(snapshot, filter, page);
  }));
}

HttpAnswer get_change(Call& call) {
  call.query.finish();
  const auto id = id_in_path<ChangeId>(call.path[0]);
  const Json json =
      call.services.store.read([&](const Snapshot& snapshot) { return render(snapshot, change_with(snapshot, id)); });
  return with_body_tag(json_answer(json), call.header("If-None-Match"));
}

}  // namespace raywatch::endpoints
