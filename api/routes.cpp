#include "api/routes.hpp"

#include <algorithm>

#include "api/endpoints/endpoints.hpp"
#include "api/endpoints/survey_endpoints.hpp"
#include "api/problem.hpp"
#include "api/text_values.hpp"

namespace raywatch {
namespace {

constexpr Route kRoutes[] = {
    {"GET", "/healthz", endpoints::get_health, "Whether the program is alive"},
    {"GET", "/readyz", endpoints::get_readiness, "Whether it can do its work"},
    {"GET", "/metrics", endpoints::get_metrics, "Figures for Prometheus"},
    {"GET", "/openapi.json", endpoints::get_openapi, "This contract"},

    {"POST", "/api/v1/sites", endpoints::create_site, "Makes a site"},
    {"GET", "/api/v1/sites", endpoints::list_sites, "Lists the sites"},
    {"GET", "/api/v1/sites/{name}", endpoints::get_site, "One site"},
    {"PATCH", "/api/v1/sites/{name}", endpoints::edit_site, "Edits a site"},
    {"DELETE", "/api/v1/sites/{name}", endpoints::delete_site, "Deletes a site without sensors"},
    {"GET", "/api/v1/sites/{name}/parameters", endpoints::get_site_parameters, "What comparisons use when not told"},

    {"POST", "/api/v1/sensors", endpoints::create_sensor, "Makes a sensor"},
    {"GET", "/api/v1/sensors", endpoints::list_sensors, "Lists the sensors"},
    {"GET", "/api/v1/sensors/{name}", endpoints::get_sensor, "One sensor"},
    {"PATCH", "/api/v1/sensors/{name}", endpoints::edit_sensor, "Edits a sensor"},
    {"DELETE", "/api/v1/sensors/{name}", endpoints::delete_sensor, "Deletes a sensor without scans"},

    {"POST", "/api/v1/scans", endpoints::upload_scan, "Stores a scan file and has it compared"},
    {"GET", "/api/v1/scans", endpoints::list_scans, "Lists the scans"},
    {"GET", "/api/v1/scans/{id}", endpoints::get_scan, "One scan"},
    {"PATCH", "/api/v1/scans/{id}", endpoints::edit_scan, "Pins a scan or notes something about it"},
    {"DELETE", "/api/v1/scans/{id}", endpoints::delete_scan, "Deletes a scan"},
    {"GET", "/api/v1/scans/{id}/points", endpoints::get_scan_points, "The points of a scan"},
    {"GET", "/api/v1/scans/{id}/panorama", endpoints::get_panorama, "How far a scan saw in each direction"},
    {"GET", "/api/v1/scans/{id}/candidates", endpoints::list_candidates, "The priors that were considered"},
    {"GET", "/api/v1/vantages", endpoints::list_vantages, "The places from which scans are taken"},

    {"POST", "/api/v1/comparisons", endpoints::create_comparison, "Compares a stored scan"},
    {"GET", "/api/v1/comparisons", endpoints::list_comparisons, "Lists the comparisons"},
    {"GET", "/api/v1/comparisons/{id}", endpoints::get_comparison, "One comparison"},
    {"GET", "/api/v1/comparisons/{id}/changes", endpoints::list_comparison_changes, "What a comparison found"},
    {"GET", "/api/v1/comparisons/{id}/points", endpoints::get_comparison_points, "The points with their classes"},

    {"GET", "/api/v1/changes", endpoints::list_changes, "Lists the changes"},
    {"GET", "/api/v1/changes/{id}", endpoints::get_change, "One change"},
    {"GET", "/api/v1/changes/{id}/evidence", endpoints::get_change_evidence, "The points and rays that prove a change"},

    {"GET", "/api/v1/baselines", endpoints::list_baselines, "What counts as normal, by version"},
    {"POST", "/api/v1/baselines/{name}/accept", endpoints::accept_baseline, "Changes what counts as normal at a site"},

    {"POST", "/api/v1/zones", endpoints::create_zone, "Makes a zone"},
    {"GET", "/api/v1/zones", endpoints::list_zones, "Lists the zones"},
    {"GET", "/api/v1/zones/{id}", endpoints::get_zone, "One zone"},
    {"PUT", "/api/v1/zones/{id}", endpoints::replace_zone, "Replaces a zone"},
    {"DELETE", "/api/v1/zones/{id}", endpoints::delete_zone, "Deletes a zone that no rule looks into"},
    {"GET", "/api/v1/zones/{id}/coverage", endpoints::list_zone_coverage, "How much of a zone each scan could judge"},

    {"POST", "/api/v1/rules", endpoints::create_rule, "Makes a rule"},
    {"GET", "/api/v1/rules", endpoints::list_rules, "Lists the rules"},
    {"GET", "/api/v1/rules/{id}", endpoints::get_rule, "One rule"},
    {"PUT", "/api/v1/rules/{id}", endpoints::replace_rule, "Replaces a rule"},
    {"DELETE", "/api/v1/rules/{id}", endpoints::delete_rule, "Deletes a rule"},
    {"POST", "/api/v1/rules/{id}/test", endpoints::test_rule, "What a rule would have alerted of"},

    {"POST", "/api/v1/silences", endpoints::create_silence, "Silences a site, zone or sensor for a time"},
    {"GET", "/api/v1/silences", endpoints::list_silences, "Lists the silences"},
    {"DELETE", "/api/v1/silences/{id}", endpoints::delete_silence, "Ends a silence"},

    {"GET", "/api/v1/tracks", endpoints::list_tracks, "Lists changes through time"},
    {"GET", "/api/v1/tracks/{id}", endpoints::get_track, "One change through time"},
    {"GET", "/api/v1/tracks/{id}/changes", endpoints::list_track_changes, "What a track was made of"},

    {"GET", "/api/v1/alerts", endpoints::list_alerts, "Lists the alerts"},
    {"GET", "/api/v1/alerts/{id}", endpoints::get_alert, "One alert, with its history and why it was raised"},
    {"POST", "/api/v1/alerts/{id}/acknowledge", endpoints::acknowledge_alert, "Says that somebody takes care"},
    {"POST", "/api/v1/alerts/{id}/resolve", endpoints::resolve_alert, "Says that it is over"},
    {"POST", "/api/v1/alerts/{id}/snooze", endpoints::snooze_alert, "Puts it off until a time"},
    {"POST", "/api/v1/alerts/{id}/accept", endpoints::accept_alert, "Makes the change part of what is normal"},

    {"GET", "/api/v1/history", endpoints::get_history, "What was at a place through time"},
    {"GET", "/api/v1/calendar", endpoints::get_calendar, "How much happened at a site, day by day"},

    {"GET", "/api/v1/events", endpoints::stream_events, "Everything that happens, as it happens"},
    {"GET", "/api/v1/events/log", endpoints::list_events, "Everything that happened, in order"},

    {"POST", "/api/v1/channels", endpoints::create_channel, "Makes a channel by which others are told"},
    {"GET", "/api/v1/channels", endpoints::list_channels, "Lists the channels"},
    {"GET", "/api/v1/channels/{id}", endpoints::get_channel, "One channel"},
    {"PUT", "/api/v1/channels/{id}", endpoints::replace_channel, "Replaces a channel"},
    {"DELETE", "/api/v1/channels/{id}", endpoints::delete_channel, "Deletes a channel"},
    {"POST", "/api/v1/channels/{id}/test", endpoints::test_channel, "Sends a test message at once"},
    {"GET", "/api/v1/deliveries", endpoints::list_deliveries, "Lists what was sent, or waits"},
    {"POST", "/api/v1/deliveries/{id}/retry", endpoints::retry_delivery, "Sends again what failed"},

    {"POST", "/api/v1/schedules", endpoints::create_schedule, "Makes a schedule of surveys"},
    {"GET", "/api/v1/schedules", endpoints::list_schedules, "Lists the schedules of surveys"},
    {"GET", "/api/v1/schedules/{id}", endpoints::get_schedule, "One schedule"},
    {"PUT", "/api/v1/schedules/{id}", endpoints::replace_schedule, "Replaces a schedule"},
    {"DELETE", "/api/v1/schedules/{id}", endpoints::delete_schedule, "Deletes a schedule; its surveys stay"},
    {"POST", "/api/v1/schedules/{id}/run", endpoints::run_schedule, "Runs a schedule at once"},
    {"GET", "/api/v1/schedules/{id}/runs", endpoints::list_schedule_runs, "What became of the runs of a schedule"},

    {"POST", "/api/v1/epochs", endpoints::create_epoch, "Makes an epoch of the scans of a time window"},
    {"GET", "/api/v1/epochs", endpoints::list_epochs, "Lists the epochs"},
    {"GET", "/api/v1/epochs/{id}", endpoints::get_epoch, "One epoch"},
    {"DELETE", "/api/v1/epochs/{id}", endpoints::delete_epoch, "Deletes an epoch; its scans and surveys stay"},
    {"POST", "/api/v1/epochs/{id}/accept", endpoints::accept_epoch, "Accepts an epoch as a state to compare with"},

    {"POST", "/api/v1/surveys", endpoints::create_survey, "Surveys what changed between two epochs"},
    {"GET", "/api/v1/surveys", endpoints::list_surveys, "Lists the surveys"},
    {"GET", "/api/v1/surveys/runs", endpoints::list_survey_runs, "Lists the runs of surveys, whatever began them"},
    {"GET", "/api/v1/surveys/runs/{id}", endpoints::get_survey_run, "One run of a survey, with its log"},
    {"POST", "/api/v1/surveys/runs/{id}/cancel", endpoints::cancel_survey_run,
     "Cancels a run that waits or is running"},
    {"GET", "/api/v1/surveys/series", endpoints::get_survey_series, "One figure through time, and how fast it changes"},
    {"GET", "/api/v1/surveys/{id}", endpoints::get_survey, "One survey, and what it rests on"},
    {"GET", "/api/v1/surveys/{id}/volumes", endpoints::get_survey_volumes, "The figures of each zone, and in total"},
    {"GET", "/api/v1/surveys/{id}/changes", endpoints::list_survey_changes, "The changes, each with its own volume"},
    {"GET", "/api/v1/surveys/{id}/dod", endpoints::get_survey_grid, "The elevation models and their difference"},
    {"GET", "/api/v1/surveys/{id}/dod.tif", endpoints::get_survey_difference_tiff,
     "The difference of the models as GeoTIFF"},
    {"GET", "/api/v1/surveys/{id}/before.tif", endpoints::get_survey_before_tiff,
     "The earlier elevation model as GeoTIFF"},
    {"GET", "/api/v1/surveys/{id}/after.tif", endpoints::get_survey_after_tiff, "The later elevation model as GeoTIFF"},
    {"GET", "/api/v1/surveys/{id}/before.las", endpoints::get_survey_before_las,
     "The earlier points as LAS, with classes"},
    {"GET", "/api/v1/surveys/{id}/after.las", endpoints::get_survey_after_las, "The later points as LAS, with classes"},
    {"GET", "/api/v1/surveys/{id}/map.geojson", endpoints::get_survey_geojson, "Zones and changes as GeoJSON"},
    {"GET", "/api/v1/surveys/{id}/changes.csv", endpoints::get_survey_changes_csv, "The changes as CSV"},
    {"GET", "/api/v1/surveys/{id}/zones.csv", endpoints::get_survey_zones_csv, "The figures of the zones as CSV"},
    {"GET", "/api/v1/surveys/{id}/report.html", endpoints::get_survey_report, "The report"},
    {"GET", "/api/v1/surveys/{id}/bundle.zip", endpoints::get_survey_bundle,
     "Report, models, tables and map in one file"},

    {"GET", "/api/v1/storage", endpoints::get_storage, "What is stored, how much room is left, and for how long"},
    {"GET", "/api/v1/storage/deletions", endpoints::list_deletions, "What was deleted, when and why"},
    {"POST", "/api/v1/storage/retention/preview", endpoints::preview_retention, "What retention would delete"},

    {"POST", "/api/v1/backup", endpoints::create_backup, "Copies the running store"},
};

bool is_placeholder(std::string_view segment) { return segment.starts_with('{'); }

bool matches(std::string_view pattern, const std::vector<std::string>& segments) {
  const auto parts = split(pattern, '/');
  return std::ranges::equal(parts, segments, [](std::string_view part, const std::string& segment) {
    return is_placeholder(part) ? !segment.empty() : part == segment;
  });
}

std::vector<std::string> placeholder_values(std::string_view pattern, const std::vector<std::string>& segments) {
  const auto parts = split(pattern, '/');
  std::vector<std::string> values;
  for (std::size_t i = 0; i < parts.size(); ++i)
    if (is_placeholder(parts[i])) values.push_back(segments[i]);
  return values;
}

std::vector<std::string> decoded_segments(std::string_view path) {
  std::vector<std::string> segments;
  for (const std::string_view segment : split(path, '/')) {
    const auto decoded = percent_decoded(segment, false);
    if (!decoded) throw HttpError(bad_request("The path has a broken %-escape or is not UTF-8."));
    segments.push_back(*decoded);
  }
  return segments;
}

}  // namespace

std::span<const Route> routes() { return kRoutes; }

bool belongs_to_api(std::string_view path) {
  if (path == "/api" || path.starts_with("/api/")) return true;
  const auto segments = decoded_segments(path);
  return std::ranges::any_of(kRoutes, [&](const Route& route) { return matches(route.pattern, segments); });
}

RouteMatch find_route(std::string_view method, std::string_view path) {
  const auto segments = decoded_segments(path);
  const std::string_view wanted = method == "HEAD" ? "GET" : method;
  for (const Route& route : kRoutes)
    if (route.method == wanted && matches(route.pattern, segments))
      return {&route, placeholder_values(route.pattern, segments)};
  throw HttpError(method_not_allowed(allowed_methods(path)));
}

std::string allowed_methods(std::string_view path) {
  const auto segments = decoded_segments(path);
  std::string methods;
  for (const Route& route : kRoutes) {
    if (!matches(route.pattern, segments)) continue;
    methods += std::string(route.method) + ", ";
    if (route.method == "GET") methods += "HEAD, ";
  }
  if (methods.empty()) throw HttpError(no_such_route(std::string(path.substr(0, 200))));
  return methods + "OPTIONS";
}

}  // namespace raywatch
