#pragma once

#include "api/call.hpp"
#include "api/lookup.hpp"
#include "api/render.hpp"

namespace raywatch::endpoints {

/// Answers a list that takes nothing but `site`, `limit` and `cursor`: of one site, or of all.
/// @param list (snapshot, std::optional<SiteId>, PageRequest) -> Page of what `render` takes
template <class List>
HttpAnswer list_of_site(Call& call, List list) {
  const auto site_name = call.query.text("site");
  const PageRequest page = call.query.page();
  call.query.finish();
  return json_answer(call.services.store.read([&](const Snapshot& snapshot) {
    std::optional<SiteId> site;
    if (site_name) site = site_named(snapshot, *site_name).id;
    return render_page(list(snapshot, site, page), [&](const auto& record) { return render(snapshot, record); });
  }));
}

}  // namespace raywatch::endpoints
