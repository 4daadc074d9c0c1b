#include <algorithm>
#include <limits>
#include <vector>

#include "api/call.hpp"
#include "api/endpoints/endpoints.hpp"
#include "api/endpoints/given_limits.hpp"
#include "api/endpoints/list_of_site.hpp"
#include "api/json_body.hpp"
#include "api/lookup.hpp"
#include "api/render.hpp"
#include "storage/all_of_list.hpp"
#include "storage/deletions.hpp"
#include "storage/payloads.hpp"
#include "storage/retention.hpp"
#include "storage/storage_use.hpp"

namespace raywatch::endpoints {
namespace {

std::vector<Site> all_sites(const Snapshot& snapshot) {
  return all_of_list([&](const PageRequest& page) { return raywatch::list_sites(snapshot, page); });
}

double bytes_per_day(const Growth& growth, Time now) {
  const std::chrono::duration<double, std::ratio<86'400>> days = now - growth.since;
  return static_cast<double>(growth.bytes) / days.count();
}

Json render_site_use(const Call& call, const Site& site, const std::optional<Growth>& growth, Time now) {
  return {{"site", site.name},
          {"payload_bytes", payload_bytes_on_disk(call.services.store, site.id)},
          {"payload_bytes_in_use", call.services.store.payloads().use_of(site.id).in_use_bytes},
          {"bytes_per_day", growth ? Json(bytes_per_day(*growth, now)) : Json(nullptr)},
          {"growth_since", growth ? Json(format_rfc3339(growth->since)) : Json(nullptr)},
          {"retention", render(limits_in_force(site.retention, call.services.retention_defaults))}};
}

/// How long the room lasts at this rate if nothing is deleted; null when nothing is known to come in.
Json render_days_to_full(const StorageUse& use, std::uint64_t reserve_bytes, double bytes_a_day) {
  if (bytes_a_day <= 0.0) return nullptr;
  const std::uint64_t room_bytes = use.free_bytes - std::min(reserve_bytes, use.free_bytes);
  return static_cast<double>(room_bytes) / bytes_a_day;
}

struct PreviewRequest {
  std::optional<std::string> site;
  GivenLimits limits;
};

PreviewRequest parse_preview(const nlohmann::json& json) {
  FieldErrors errors;
  JsonObject body(json, "", errors);
  PreviewRequest request;
  request.site = body.text("site");
  request.limits = parse_limits(body);
  body.finish();
  errors.throw_if_any();
  return request;
}

template <class Key>
Json render_counts(const std::map<Key, std::uint64_t>& counts) {
  Json json = Json::object();
  for (const auto& [key, count] : counts) json[std::string(to_string(key))] = count;
  return json;
}

Json render_plan(const Site& site, const RetentionState& state, const RetentionPlan& plan) {
  return {{"site", site.name},
          {"limits", render(state.in_force)},
          {"scans", plan.expired.size()},
          {"bytes", plan.bytes},
          {"oldest_received_at", render(plan.oldest_received_at)},
          {"newest_received_at", render(plan.newest_received_at)},
          {"reasons", render_counts(plan.reasons)},
          {"protected", render_counts(plan.kept)},
          {"reached", plan.reached}};
}

}  // namespace

HttpAnswer get_storage(Call& call) {
  call.query.finish();
  Store& store = call.services.store;
  const Time now = call.services.now();
  std::vector<std::pair<Site, std::optional<Growth>>> sites;
  const EventsUse events = store.read([&](const Snapshot& snapshot) {
    for (const Site& site : all_sites(snapshot)) sites.emplace_back(site, growth_of(snapshot, site.id, now));
    return events_use(snapshot);
  });
  Json items = Json::array();
  double bytes_a_day = 0.0;
  for (const auto& [site, growth] : sites) {
    items.push_back(render_site_use(call, site, growth, now));
    if (growth) bytes_a_day += bytes_per_day(*growth, now);
  }
  const StorageUse use = storage_use(store);
  return json_answer(
      {{"sites", std::move(items)},
       {"metadata_bytes", use.metadata_bytes},
       {"metadata_copies_bytes", use.metadata_copies_bytes},
       {"spool_bytes", use.spool_bytes},
       {"events",
        {{"events", events.events}, {"estimated_bytes", events.bytes}, {"oldest_at", render(events.oldest_at)}}},
       {"disk",
        {{"bytes", use.disk_bytes},
         {"free_bytes", use.free_bytes},
         {"reserve_bytes", store.reserve_bytes()},
         {"days_to_full", render_days_to_full(use, store.reserve_bytes(), bytes_a_day)}}}});
}

HttpAnswer list_deletions(Call& call) { return list_of_site(call, raywatch::list_deletions); }

HttpAnswer preview_retention(Call& call) {
  call.query.finish();
  const PreviewRequest request = parse_preview(json_body(call));
  Store& store = call.services.store;
  const Time now = call.services.now();
  const std::vector<Site> sites = store.read([&](const Snapshot& snapshot) {
    return request.site ? std::vector{site_named(snapshot, *request.site)} : all_sites(snapshot);
  });
  Json items = Json::array();
  for (const Site& site : sites) {
    const RetentionLimits limits =
        limits_in_force(request.limits.applied_to(site.retention), call.services.retention_defaults);
    const RetentionState state = retention_state(store, site.id, limits, now);
    const RetentionPlan plan = store.read([&](const Snapshot& snapshot) {
      return plan_retention(snapshot, site.id, state, std::numeric_limits<std::size_t>::max());
    });
    items.push_back(render_plan(site, state, plan));
  }
  return json_answer({{"items", std::move(items)}, {"next", nullptr}});
}

}  // namespace raywatch::endpoints
