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
HttpAnswer get_site_parameters(Call& call);

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
HttpAnswer get_change_evidence(Call& call);

HttpAnswer create_zone(Call& call);
HttpAnswer list_zones(Call& call);
HttpAnswer get_zone(Call& call);
HttpAnswer replace_zone(Call& call);
HttpAnswer delete_zone(Call& call);
HttpAnswer list_zone_coverage(Call& call);

HttpAnswer create_rule(Call& call);
HttpAnswer list_rules(Call& call);
HttpAnswer get_rule(Call& call);
HttpAnswer replace_rule(Call& call);
HttpAnswer delete_rule(Call& call);
HttpAnswer test_rule(Call& call);

HttpAnswer create_silence(Call& call);
HttpAnswer list_silences(Call& call);
HttpAnswer delete_silence(Call& call);

HttpAnswer list_tracks(Call& call);
HttpAnswer get_track(Call& call);
HttpAnswer list_track_changes(Call& call);

HttpAnswer list_alerts(Call& call);
HttpAnswer get_alert(Call& call);
HttpAnswer acknowledge_alert(Call& call);
HttpAnswer resolve_alert(Call& call);
HttpAnswer snooze_alert(Call& call);
HttpAnswer accept_alert(Call& call);

HttpAnswer list_baselines(Call& call);
HttpAnswer accept_baseline(Call& call);

HttpAnswer get_history(Call& call);
HttpAnswer get_calendar(Call& call);

HttpAnswer stream_events(Call& call);
HttpAnswer list_events(Call& call);

HttpAnswer create_channel(Call& call);
HttpAnswer list_channels(Call& call);
HttpAnswer get_channel(Call& call);
HttpAnswer replace_channel(Call& call);
HttpAnswer delete_channel(Call& call);
HttpAnswer test_channel(Call& call);

HttpAnswer list_deliveries(Call& call);
HttpAnswer retry_delivery(Call& call);

HttpAnswer get_storage(Call& call);
HttpAnswer list_deletions(Call& call);
HttpAnswer preview_retention(Call& call);

HttpAnswer create_backup(Call& call);

}  // namespace raywatch::endpoints
