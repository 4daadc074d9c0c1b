#include "api/endpoints/comparison_request.hpp"

#include <algorithm>

#include "api/json_object.hpp"
#include "api/lookup.hpp"
#include "api/parameter_bounds.hpp"
#include "api/units.hpp"
#include "core/profile.hpp"
#include "storage/baselines.hpp"

namespace raywatch::endpoints {
namespace {

constexpr std::size_t kMaxExplicitScans = 255;  // `compare` counts priors in a byte

constexpr RealBounds kDistance_m{.min = 0.0, .max = 1000.0, .exclusive_min = true};

template <class T>
void assign(const std::optional<T>& given, T& value) {
  if (given) value = *given;
}

CompareParameters parse_parameters(JsonObject& body, Profile profile) {
  const auto grouping = body.parsed("grouping", parse_grouping).value_or(Grouping::consensus);
  CompareParameters parameters = default_parameters(profile, grouping);
  if (const auto angle_deg = body.real("angle_deg", kAngleBounds_deg)) {
    parameters.angle_rad = radians_of_deg(*angle_deg);
  }
  assign(body.real("range_m", kThresholdBounds_m), parameters.range_m);
  assign(body.real("support_distance_m", kThresholdBounds_m), parameters.support_distance_m);
  assign(body.real("growth_distance_m", kThresholdBounds_m), parameters.growth_distance_m);
  assign(body.real("foliage_distance_m", kThresholdBounds_m), parameters.foliage_distance_m);
  assign(body.flag("clustering"), parameters.clustering);
  assign(body.real("cluster_distance_m", kDistance_m), parameters.cluster_distance_m);
  if (const auto points = body.integer("cluster_min_points", kMinPointsBounds)) {
    parameters.cluster_min_points = static_cast<std::size_t>(*points);
  }
  assign(body.real("min_range_m", kRangeBounds_m), parameters.min_range_m);
  assign(body.real("max_range_m", kRangeBounds_m), parameters.max_range_m);
  if (const auto seconds = body.real("contemporary_s", kContemporaryBounds_s)) {
    parameters.contemporary_tolerance = duration_of_seconds(*seconds);
  }
  assign(body.flag("align"), parameters.align);
  if (parameters.align && grouping == Grouping::union_) body.fail("align", "must be false for union");
  if (parameters.min_range_m > parameters.max_range_m) body.fail("min_range_m", "must not be above max_range_m");
  for (const char* name :
       {"grouping", "range_m", "support_distance_m", "growth_distance_m", "foliage_distance_m", "clustering",
        "cluster_distance_m", "cluster_min_points", "min_range_m", "max_range_m", "contemporary_s", "align"})
    body.refuse_null(name);
  body.finish();
  return parameters;
}

Reference parse_named_reference(JsonObject& body, const std::string& name) {
  if (name == "baseline") return BaselineReference{};
  if (name != "previous")
    body.fail("reference", R"(must be "previous", "baseline", {"from", "to"} or {"scans": [...]})");
  return PreviousReference{};
}

Reference parse_reference_window(JsonObject& reference) {
  reference.require("from");
  reference.require("to");
  const auto from = reference.time("from");
  const auto to = reference.time("to");
  if (from && to && *from >= *to) reference.fail("to", "must be later than 'from'");
  return WindowReference{from.value_or(Time{}), to.value_or(Time{})};
}

Reference parse_scans(JsonObject& reference) {
  ExplicitReference parsed;
  for (const std::int64_t id : reference.integers("scans", {.min = 1}).value_or(std::vector<std::int64_t>{})) {
    if (std::ranges::find(parsed.scans, ScanId{id}) != parsed.scans.end()) {
      reference.fail("scans", "names scan " + std::to_string(id) + " twice");
    }
    parsed.scans.push_back(ScanId{id});
  }
  if (parsed.scans.size() > kMaxExplicitScans) reference.fail("scans", "must name at most 255 scans");
  if (parsed.scans.empty()) reference.fail("scans", "must name at least one scan");
  return parsed;
}

Reference parse_reference(JsonObject& body) {
  const nlohmann::json* given = body.any("reference");
  if (given == nullptr) return PreviousReference{};
  if (given->is_string()) return parse_named_reference(body, given->get<std::string>());
  auto reference = body.object("reference");
  if (!reference) {
    body.fail("reference", "must not be null");
    return PreviousReference{};
  }
  const bool is_list = reference->any("scans") != nullptr;
  Reference parsed = is_list ? parse_scans(*reference) : parse_reference_window(*reference);
  reference->finish();
  return parsed;
}

/// What an explicit reference names must be there, in the same site, and not the compared scan.
void check_scans(const Snapshot& snapshot, const ScanRecord& scan, const Reference& reference, FieldErrors& errors) {
  if (std::holds_alternative<BaselineReference>(reference)) {
    const auto latest = latest_baseline(snapshot, scan.site);
    const bool is_empty = !latest || baseline_entries(snapshot, scan.site, latest->version).empty();
    if (is_empty) errors.add("reference", "the site has no baseline");
  }
  const auto* scans = std::get_if<ExplicitReference>(&reference);
  if (scans == nullptr) return;
  for (const ScanId id : scans->scans) {
    const ScanRecord prior = scan_with(snapshot, id);
    const std::string name = "scan " + std::to_string(id.value);
    if (prior.id == scan.id) errors.add("reference.scans", name + " is the one that is compared");
    if (prior.site != scan.site) errors.add("reference.scans", name + " belongs to another site");
  }
}

}  // namespace

ComparisonRequest parse_comparison_request(const Snapshot& snapshot, const nlohmann::json& json) {
  FieldErrors errors;
  JsonObject body(json, "", errors);
  body.require("scan");
  const auto scan_id = body.integer("scan", {.min = 1});
  ComparisonRequest request;
  request.reference = parse_reference(body);
  // The defaults depend on the site. When the scan is missing or wrong, the parameters are still read for their errors.
  std::optional<ScanRecord> scan;
  if (scan_id) scan = scan_with(snapshot, ScanId{*scan_id});
  const Profile profile = scan ? site_with(snapshot, scan->site).profile : Profile::indoor;
  static const nlohmann::json no_parameters = nlohmann::json::object();
  JsonObject parameters = body.object("parameters").value_or(JsonObject(no_parameters, "parameters", errors));
  request.parameters = parse_parameters(parameters, profile);
  body.refuse_null("parameters");
  body.finish();
  if (scan) check_scans(snapshot, *scan, request.reference, errors);
  errors.throw_if_any();
  request.scan = scan->id;
  return request;
}

}  // namespace raywatch::endpoints
