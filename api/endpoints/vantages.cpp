#include "api/call.hpp"
#include "api/endpoints/endpoints.hpp"
#include "api/lookup.hpp"
#include "api/render.hpp"
#include "storage/scans.hpp"

namespace raywatch::endpoints {

HttpAnswer list_vantages(Call& call) {
  const auto site_name = call.query.text("site");
  const PageRequest page = call.query.page();
  call.query.finish();
  return json_answer(call.services.store.read([&](const Snapshot& snapshot) {
    std::optional<SiteId> site;
    if (site_name) site = site_named(snapshot, *site_name).id;
    return render_page(raywatch::list_vantages(snapshot, site, page),
                       [&](const Vantage& vantage) { return render(snapshot, vantage); });
  }));
}

}  // namespace raywatch::endpoints
