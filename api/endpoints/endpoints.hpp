#pragma once

#include "api/answer.hpp"

namespace raywatch {
struct Call;
}

/// The handlers behind `routes()`, one source file a resource. Each parses the call, calls the store or a command, and
/// renders the result; each throws what `problem_of` knows.
namespace raywatch::endpoints {

HttpAnswer get_health(Call& call);
HttpAnswer get_readiness(Call& call);
HttpAnswer get_metrics(Call& call);
HttpAnswer get_openapi(Call& call);

HttpAnswer create_site(Call& call);
HttpAnswer list_sites(Call& call);
HttpAnswer get_site(Call& call);
HttpAnswer edit_site(Call& call);
HttpAnswer delete_site(Call& call);

HttpAnswer create_sensor(Call& call);
HttpAnswer list_sensors(Call& call);
HttpAnswer get_sensor(Call& call);
HttpAnswer edit_sensor(Call& call);
HttpAnswer delete_sensor(Call& call);

HttpAnswer upload_scan(Call& call);
HttpAnswer list_scans(Call& call);
HttpAnswer get_scan(Call& call);
HttpAnswer edit_scan(Call& call);
HttpAnswer delete_scan(Call& call);
HttpAnswer get_scan_points(Call& call);
HttpAnswer get_panorama(Call& call);
HttpAnswer list_candidates(Call& call);
HttpAnswer list_vantages(Call& call);

HttpAnswer create_comparison(Call& call);
HttpAnswer list_comparisons(Call& call);
HttpAnswer get_comparison(Call& call);
HttpAnswer list_comparison_changes(Call& call);
HttpAnswer get_comparison_points(Call& call);

HttpAnswer list_changes(Call& call);
HttpAnswer get_change(Call& call);

HttpAnswer create_backup(Call& call);

}  // namespace raywatch::endpoints
