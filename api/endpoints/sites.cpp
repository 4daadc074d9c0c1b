#include "storage/sites.hpp"

#include "api/call.hpp"
#include "api/conditional.hpp"
#include "api/endpoints/endpoints.hpp"
#include "api/endpoints/given_limits.hpp"
#include "api/json_body.hpp"
#include "api/json_object.hpp"
#include "api/lookup.hpp"
#include "api/name_rules.hpp"
#include "api/render.hpp"
#include "api/units.hpp"
#include "storage/rules.hpp"
#include "storage/site_crs.hpp"

namespace raywatch::endpoints {
namespace {

constexpr IntegerBounds kEpsgCodes{.min = 1024, .max = 32767};

/// @throws InvalidInput unless PROJ knows the code, and its coordinates are metres on a plane, as those of sites are.
int checked_epsg(std::int64_t code) {
  const int epsg = static_cast<int>(code);
  require_metric(describe_crs(epsg));
  return epsg;
}

/// The members of `MineGrid`; a scale that is wrong is named here, before the store refuses it.
std::optional<MineGrid> parse_grid(JsonObject& body) {
  std::optional<JsonObject> given = body.object("mine_grid");
  if (!given) return std::nullopt;
  MineGrid grid;
  for (const char* member : {"site_origin_m", "grid_origin_m"}) given->require(member);
  grid.site_origin_m = given->vector3("site_origin_m").value_or(grid.site_origin_m);
  grid.grid_origin_m = given->vector3("grid_origin_m").value_or(grid.grid_origin_m);
  grid.rotation_rad = radians_of_deg(given->real("rotation_deg", {.min = -360.0, .max = 360.0}).value_or(0.0));
  grid.scale = given->real("scale", {.min = 0.9, .max = 1.1}).value_or(grid.scale);
  given->finish();
  return grid;
}

/// What is not given is left to the one who asks.
struct GivenEdit {
  SiteEdit edit;
  GivenLimits retention;
};

GivenEdit parse_edit(JsonObject& body) {
  GivenEdit given;
  SiteEdit& edit = given.edit;
  edit.time_zone = body.parsed("time_zone", checked_time_zone);
  edit.profile = body.parsed("profile", parse_profile);
  if (const auto epsg = body.integer("epsg", kEpsgCodes)) edit.epsg = checked_epsg(*epsg);
  if (auto grid = parse_grid(body)) edit.mine_grid = grid;
  edit.origin_m = body.vector3("origin_m");
  if (auto retention = body.object("retention")) {
    given.retention = parse_limits(*retention);
    retention->finish();
  }
  return given;
}

Site parse_site(const nlohmann::json& json) {
  FieldErrors errors;
  JsonObject body(json, "", errors);
  body.require("name");
  Site site;
  site.name = body.parsed("name", checked_name).value_or("");
  const GivenEdit whole = parse_edit(body);
  const SiteEdit& given = whole.edit;
  body.finish();
  errors.throw_if_any();
  site.time_zone = given.time_zone.value_or(site.time_zone);
  site.profile = given.profile.value_or(site.profile);
  site.epsg = given.epsg.value_or(std::nullopt);
  site.mine_grid = given.mine_grid.value_or(std::nullopt);
  site.origin_m = given.origin_m;
  site.retention = whole.retention.applied_to({});
  return site;
}

GivenEdit parse_site_edit(const nlohmann::json& json) {
  FieldErrors errors;
  JsonObject body(json, "", errors);
  GivenEdit edit = parse_edit(body);
  for (const char* name : {"time_zone", "profile", "origin_m", "retention"}) body.refuse_null(name);
  if (body.is_null("epsg")) edit.edit.epsg.emplace();
  if (body.is_null("mine_grid")) edit.edit.mine_grid.emplace();
  body.finish();
  errors.throw_if_any();
  return edit;
}

std::string tag_of(const Site& site) { return entity_tag(to_json_text(render(site))); }

}  // namespace

HttpAnswer create_site(Call& call) {
  call.query.finish();
  const Site site = parse_site(json_body(call));
  const Time now = call.services.now();
  const Site stored = call.services.store.write([&](Transaction& transaction) {
    Site made = insert_site(transaction, site, now);
    insert_rule(transaction, default_rule(made.id, made.profile), now);
    return made;
  });
  HttpAnswer answer = with_body_tag(json_answer(render(stored), 201), std::nullopt);
  answer.set_header("Location", "/api/v1/sites/" + percent_encoded(stored.name));
  return answer;
}

HttpAnswer list_sites(Call& call) {
  const PageRequest page = call.query.page();
  call.query.finish();
  const auto sites =
      call.services.store.read([&](const Snapshot& snapshot) { return raywatch::list_sites(snapshot, page); });
  return json_answer(render_page(sites, [](const Site& site) { return render(site); }));
}

HttpAnswer get_site(Call& call) {
  call.query.finish();
  const Site site =
      call.services.store.read([&](const Snapshot& snapshot) { return site_named(snapshot, call.path[0]); });
  return with_body_tag(json_answer(render(site)), call.header("If-None-Match"));
}

HttpAnswer edit_site(Call& call) {
  call.query.finish();
  GivenEdit given = parse_site_edit(json_body(call));
  const auto if_match = call.header("If-Match");
  const Site site = call.services.store.write([&](Transaction& transaction) {
    const Site before = site_named(transaction, call.path[0]);
    check_if_match(if_match, tag_of(before));
    given.edit.retention = given.retention.applied_to(before.retention);
    return raywatch::edit_site(transaction, before.id, given.edit);
  });
  return with_body_tag(json_answer(render(site)), std::nullopt);
}

HttpAnswer delete_site(Call& call) {
  call.query.finish();
  call.services.store.write(
      [&](Transaction& transaction) { raywatch::delete_site(transaction, site_named(transaction, call.path[0]).id); });
  return {.status = 204};
}

}  // namespace raywatch::endpoints
