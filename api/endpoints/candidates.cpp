#include <algorithm>

#include "api/call.hpp"
#include "api/endpoints/endpoints.hpp"
#include "api/lookup.hpp"
#include "api/render.hpp"

namespace raywatch::endpoints {
namespace {

/// The comparison that is asked about: the named one of this scan, or its first.
std::optional<ComparisonId> choose(const Snapshot& snapshot, ScanId scan, std::optional<std::int64_t> named) {
  const auto comparisons = comparisons_of(snapshot, scan);
  if (!named) return comparisons.empty() ? std::nullopt : std::optional(comparisons.front().id);
  const ComparisonId id{*named};
  if (std::ranges::find(comparisons, id, &ComparisonRecord::id) == comparisons.end()) {
    throw NotFound("Scan " + std::to_string(scan.value) + " has no comparison " + std::to_string(id.value) + ".");
  }
  return id;
}

}  // namespace

HttpAnswer list_candidates(Call& call) {
  const auto named = call.query.integer("comparison", {.min = 1});
  call.query.finish();
  const auto id = id_in_path<ScanId>(call.path[0]);
  return json_answer(call.services.store.read([&](const Snapshot& snapshot) {
    const auto comparison = choose(snapshot, scan_with(snapshot, id).id, named);
    Json items = Json::array();
    if (comparison)
      for (const ComparisonCandidate& candidate : candidates_of(snapshot, *comparison))
        items.push_back(render(candidate));
    return Json{{"comparison", comparison ? Json(comparison->value) : Json(nullptr)},
                {"items", std::move(items)},
                {"next", nullptr}};
  }));
}

}  // namespace raywatch::endpoints
