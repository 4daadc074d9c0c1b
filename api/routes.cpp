#include "api/routes.hpp"

#include <algorithm>

#include "api/endpoints/endpoints.hpp"
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
