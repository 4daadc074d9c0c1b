#include "storage/baselines.hpp"

#include "api/call.hpp"
#include "api/endpoints/endpoints.hpp"
#include "api/json_body.hpp"
#include "api/json_object.hpp"
#include "api/lookup.hpp"
#include "api/render.hpp"
#include "api/signature.hpp"
#include "storage/acceptance.hpp"

namespace raywatch::endpoints {
namespace {

enum class Mode { extend, replace, learn };

Mode parse_mode(const std::string& name) {
  if (name == "extend") return Mode::extend;
  if (name == "replace") return Mode::replace;
  if (name == "learn") return Mode::learn;
  throw InvalidInput("must be extend, replace or learn");
}

struct GivenAcceptance {
  AcceptedBy who;
  Mode mode = Mode::extend;
  std::optional<TrackId> track;
  AcceptedScans scans;  ///< the region in the coordinates of the site
};

std::optional<Eigen::AlignedBox3d> parse_region(JsonObject& body) {
  auto region = body.object("region_m");
  if (!region) return std::nullopt;
  region->require("min");
  region->require("max");
  const auto low_m = region->vector3("min"), high_m = region->vector3("max");
  region->finish();
  if (!low_m || !high_m) return std::nullopt;
  if ((low_m->array() >= high_m->array()).any()) {
    body.fail("region_m", "must have its lower corner as min, and some size");
    return std::nullopt;
  }
  return Eigen::AlignedBox3d(*low_m, *high_m);
}

GivenAcceptance parse_acceptance(const nlohmann::json& json, Time now) {
  FieldErrors errors;
  JsonObject body(json, "", errors);
  GivenAcceptance given;
  const Signature signature = parse_signature(body);
  given.who = {signature.by, signature.note, now};
  given.mode = body.parsed("mode", parse_mode).value_or(Mode::extend);
  if (const auto track = body.integer("track", {.min = 1})) given.track = TrackId{*track};
  for (const std::int64_t id : body.integers("scans", {.min = 1}).value_or(std::vector<std::int64_t>{})) {
    given.scans.scans.push_back(ScanId{id});
  }
  given.scans.region_m = parse_region(body);
  given.scans.replace = given.mode == Mode::replace;
  const bool names_scans = !given.scans.scans.empty();
  if (given.mode == Mode::learn && (names_scans || given.track))
    body.fail("mode", "learn takes neither scans nor a track");
  if (given.mode == Mode::replace && given.track) body.fail("mode", "a track can only extend what is normal");
  if (given.mode == Mode::replace && given.scans.region_m) body.fail("region_m", "cannot stand for all that is normal");
  if (given.mode != Mode::learn && names_scans == given.track.has_value()) {
    body.fail("scans", "must be given, or else 'track'");
  }
  body.finish();
  errors.throw_if_any();
  return given;
}

}  // namespace

HttpAnswer list_baselines(Call& call) {
  const auto site_name = call.query.text("site");
  const PageRequest page = call.query.page();
  call.query.finish();
  return json_answer(call.services.store.read([&](const Snapshot& snapshot) {
    const Page<BaselineVersion> versions =
        site_name ? raywatch::list_baselines(snapshot, site_named(snapshot, *site_name).id, page)
                  : latest_baselines(snapshot, page);
    return render_page(versions, [&](const BaselineVersion& version) { return render(snapshot, version); });
  }));
}

HttpAnswer accept_baseline(Call& call) {
  call.query.finish();
  const GivenAcceptance given = parse_acceptance(json_body(call), call.services.now());
  const Json json = call.services.store.write([&](Transaction& transaction) {
    const Site site = site_named(transaction, call.path[0]);
    if (given.mode == Mode::learn) return render(transaction, learn_anew(transaction, site.id, given.who));
    if (given.track) {
      if (track_with(transaction, *given.track).site != site.id) throw NotFound("The site has no such track.");
      return render(transaction, accept_track(transaction, *given.track, given.who));
    }
    AcceptedScans local = given.scans;
    if (local.region_m) local.region_m->translate(-origin_of(site));
    return render(transaction, accept_scans(transaction, site.id, local, given.who));
  });
  return json_answer(json, 201);
}

}  // namespace raywatch::endpoints
