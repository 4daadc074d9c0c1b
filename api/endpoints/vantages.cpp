#include "api/endpoints/endpoints.hpp"
#include "api/endpoints/list_of_site.hpp"
#include "storage/scans.hpp"

namespace raywatch::endpoints {

HttpAnswer list_vantages(Call& call) { return list_of_site(call, raywatch::list_vantages); }

}  // namespace raywatch::endpoints
