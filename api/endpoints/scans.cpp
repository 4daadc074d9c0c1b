#include "storage/scans.hpp"

#include "api/call.hpp"
#include "api/conditional.hpp"
#include "api/endpoints/endpoints.hpp"
#include "api/json_body.hpp"
#include "api/json_object.hpp"
#include "api/lookup.hpp"
#include "api/render.hpp"

namespace raywatch::endpoints {
namespace {

/// The filter as given; names become ids, and places local, when the store is read.
struct GivenFilter {
  std::optional<std::string> site, sensor;
  std::optional<std::int64_t> vantage;
  TimeRange range;
  std::optional<Eigen::Vector3d> near_m;
  std::optional<double> radius_m;
};

GivenFilter parse_filter(Query& query) {
  GivenFilter given;
  given.site = query.text("site");
  given.sensor = query.text("sensor");
  given.vantage = query.integer("vantage", {.min = 1});
  given.range = query.time_range();
  given.near_m = query.vector3("near");
  given.radius_m = query.real("radius_m", {.min = 0.0, .max = 1e6});
  if (given.near_m && !given.site) query.fail("near", "needs 'site', in whose coordinates it stands");
  if (given.radius_m && !query.has("near")) query.fail("radius_m", "needs 'near', around which it reaches");
  return given;
}

ScanFilter resolve(const Snapshot& snapshot, const GivenFilter& given) {
  ScanFilter filter;
  if (given.site) {
    const Site site = site_named(snapshot, *given.site);
    filter.site = site.id;
    if (given.near_m) filter.near_m = *given.near_m - origin_of(site);
  }
  if (given.sensor) filter.sensor = sensor_named(snapshot, *given.sensor).id;
  if (given.vantage) filter.vantage = VantageId{*given.vantage};
  filter.from = given.range.from;
  filter.to = given.range.to;
  filter.near_radius_m = given.radius_m.value_or(filter.near_radius_m);
  return filter;
}

std::string checked_scan_note(const std::string& note) {
  if (note.size() > 4000) throw InvalidInput("must have at most 4000 bytes");
  return note;
}

ScanEdit parse_edit(const nlohmann::json& json) {
  FieldErrors errors;
  JsonObject body(json, "", errors);
  ScanEdit edit;
  edit.pinned = body.flag("pinned");
  edit.note = body.parsed("note", checked_scan_note);
  body.refuse_null("pinned");
  body.refuse_null("note");
  body.finish();
  errors.throw_if_any();
  return edit;
}

}  // namespace

HttpAnswer list_scans(Call& call) {
  const GivenFilter given = parse_filter(call.query);
  const PageRequest page = call.query.page();
  call.query.finish();
  return json_answer(call.services.store.read([&](const Snapshot& snapshot) {
    return render_page(raywatch::list_scans(snapshot, resolve(snapshot, given), page),
                       [&](const ScanRecord& scan) { return render(snapshot, scan); });
  }));
}

HttpAnswer get_scan(Call& call) {
  call.query.finish();
  const auto id = id_in_path<ScanId>(call.path[0]);
  const Json json =
      call.services.store.read([&](const Snapshot& snapshot) { return render(snapshot, scan_with(snapshot, id)); });
  return with_body_tag(json_answer(json), call.header("If-None-Match"));
}

HttpAnswer edit_scan(Call& call) {
  call.query.finish();
  const auto id = id_in_path<ScanId>(call.path[0]);
  const ScanEdit edit = parse_edit(json_body(call));
  const auto if_match = call.header("If-Match");
  const Json json = call.services.store.write([&](Transaction& transaction) {
    check_if_match(if_match, entity_tag(to_json_text(render(transaction, scan_with(transaction, id)))));
    return render(transaction, raywatch::edit_scan(transaction, id, edit));
  });
  return with_body_tag(json_answer(json), std::nullopt);
}

HttpAnswer delete_scan(Call& call) {
  call.query.finish();
  const auto id = id_in_path<ScanId>(call.path[0]);
  call.services.store.read([&](const Snapshot& snapshot) { scan_with(snapshot, id); });
  call.services.commands.delete_scan(id);
  return {.status = 204};
}

}  // namespace raywatch::endpoints
