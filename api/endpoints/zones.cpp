#include "storage/zones.hpp"

#include "api/call.hpp"
#include "api/conditional.hpp"
#include "api/endpoints/endpoints.hpp"
#include "api/endpoints/list_of_site.hpp"
#include "api/json_body.hpp"
#include "api/json_object.hpp"
#include "api/lookup.hpp"
#include "api/name_rules.hpp"
#include "api/render.hpp"

namespace raywatch::endpoints {
namespace {

/// A zone as given: in the coordinates of the site.
struct GivenZone {
  std::optional<std::string> site;
  std::string name;
  ZoneKind kind = ZoneKind::alert;
  Prism prism;
};

std::vector<Eigen::Vector2d> parse_polygon(JsonObject& body) {
  std::vector<Eigen::Vector2d> polygon;
  const nlohmann::json* corners = body.any("polygon_m");
  const auto is_corner = [](const nlohmann::json& corner) {
    return corner.is_array() && corner.size() == 2 && corner[0].is_number() && corner[1].is_number();
  };
  if (corners == nullptr || !corners->is_array() || !std::ranges::all_of(*corners, is_corner)) {
    body.fail("polygon_m", "must be an array of corners [x, y]");
    return polygon;
  }
  for (const nlohmann::json& corner : *corners) polygon.emplace_back(corner[0].get<double>(), corner[1].get<double>());
  return polygon;
}

GivenZone parse_zone(const nlohmann::json& json) {
  FieldErrors errors;
  JsonObject body(json, "", errors);
  GivenZone zone;
  for (const char* name : {"name", "kind", "z_min_m", "z_max_m"}) body.require(name);
  zone.site = body.text("site");
  zone.name = body.parsed("name", checked_name).value_or("");
  zone.kind = body.parsed("kind", parse_zone_kind).value_or(zone.kind);
  zone.prism.polygon_m = parse_polygon(body);
  zone.prism.z_min_m = body.real("z_min_m").value_or(0.0);
  zone.prism.z_max_m = body.real("z_max_m").value_or(0.0);
  body.finish();
  errors.throw_if_any();
  check_prism(zone.prism);
  return zone;
}

/// The first zone or scan of a site fixes what its coordinates are relative to.
ZoneRecord record_of(Transaction& transaction, const GivenZone& given, const Site& site) {
  const Eigen::Vector2d& corner_m = given.prism.polygon_m.front();
  const Site fixed = fix_origin(transaction, site, {corner_m.x(), corner_m.y(), given.prism.z_min_m});
  const Eigen::Vector3d origin_m = origin_of(fixed);
  ZoneRecord record{.zone = {.kind = given.kind, .prism = given.prism}, .site = site.id, .name = given.name};
  for (Eigen::Vector2d& p : record.zone.prism.polygon_m) p -= origin_m.head<2>();
  record.zone.prism.z_min_m -= origin_m.z();
  record.zone.prism.z_max_m -= origin_m.z();
  return record;
}

}  // namespace

HttpAnswer create_zone(Call& call) {
  call.query.finish();
  const GivenZone given = parse_zone(json_body(call));
  if (!given.site) throw InvalidInput("The zone needs a site.", {{"site", "is required"}});
  const Time now = call.services.now();
  const Json json = call.services.store.write([&](Transaction& transaction) {
    const Site site = site_named(transaction, *given.site);
    return render(transaction, insert_zone(transaction, record_of(transaction, given, site), now));
  });
  HttpAnswer answer = with_body_tag(json_answer(json, 201), std::nullopt);
  answer.set_header("Location", "/api/v1/zones/" + json["id"].dump());
  return answer;
}

HttpAnswer list_zones(Call& call) { return list_of_site(call, raywatch::list_zones); }

HttpAnswer get_zone(Call& call) {
  call.query.finish();
  const auto id = id_in_path<ZoneId>(call.path[0]);
  const Json json =
      call.services.store.read([&](const Snapshot& snapshot) { return render(snapshot, zone_with(snapshot, id)); });
  return with_body_tag(json_answer(json), call.header("If-None-Match"));
}

HttpAnswer replace_zone(Call& call) {
  call.query.finish();
  const auto id = id_in_path<ZoneId>(call.path[0]);
  const GivenZone given = parse_zone(json_body(call));
  const auto if_match = call.header("If-Match");
  const Time now = call.services.now();
  const Json json = call.services.store.write([&](Transaction& transaction) {
    const ZoneRecord before = zone_with(transaction, id);
    check_if_match(if_match, entity_tag(to_json_text(render(transaction, before))));
    const Site site = site_with(transaction, before.site);
    if (given.site && *given.site != site.name) throw Conflict("A zone cannot go to another site.");
    ZoneRecord after = record_of(transaction, given, site);
    after.zone.id = id;
    return render(transaction, raywatch::replace_zone(transaction, after, now));
  });
  return with_body_tag(json_answer(json), std::nullopt);
}

HttpAnswer delete_zone(Call& call) {
  call.query.finish();
  const auto id = id_in_path<ZoneId>(call.path[0]);
  call.services.store.write(
      [&](Transaction& transaction) { raywatch::delete_zone(transaction, zone_with(transaction, id).zone.id); });
  return {.status = 204};
}

HttpAnswer list_zone_coverage(Call& call) {
  const PageRequest page = call.query.page();
  call.query.finish();
  const auto id = id_in_path<ZoneId>(call.path[0]);
  return json_answer(call.services.store.read([&](const Snapshot& snapshot) {
    return render_page(list_coverage(snapshot, zone_with(snapshot, id).zone.id, page),
                       [&](const ZoneCoverage& coverage) { return render(coverage); });
  }));
}

}  // namespace raywatch::endpoints
