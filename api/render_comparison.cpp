#include "api/lookup.hpp"
#include "api/render.hpp"
#include "api/units.hpp"

namespace raywatch {
namespace {

struct RenderReference {
  Json operator()(const PreviousReference&) const { return "previous"; }
  Json operator()(const BaselineReference&) const { return "baseline"; }
  Json operator()(const WindowReference& window) const {
    return {{"from", format_rfc3339(window.from)}, {"to", format_rfc3339(window.to)}};
  }
  Json operator()(const ExplicitReference& reference) const {
    Json scans = Json::array();
    for (const ScanId scan : reference.scans) scans.push_back(scan.value);
    return {{"scans", std::move(scans)}};
  }
};

Json render_priors(const std::vector<ComparisonPrior>& priors) {
  Json list = Json::array();
  for (const ComparisonPrior& prior : priors) {
    list.push_back({{"scan", prior.scan.value},
                    {"vantage", prior.vantage.value},
                    {"overlap", prior.overlap},
                    {"added", prior.added},
                    {"removed", prior.removed}});
  }
  return list;
}

Json render_counts(const ComparisonRecord& comparison) {
  Json counts = Json::object();
  for (std::size_t i = 0; i < kPointClasses; ++i) {
    counts[std::string(to_string(static_cast<PointClass>(i)))] = comparison.counts[i];
  }
  return counts;
}

}  // namespace

Json render(const CompareParameters& parameters) {
  return {{"grouping", to_string(parameters.grouping)},
          {"angle_deg", parameters.angle_rad ? Json(deg_of_radians(*parameters.angle_rad)) : Json(nullptr)},
          {"range_m", parameters.range_m},
          {"clustering", parameters.clustering},
          {"support_distance_m", parameters.support_distance_m},
          {"growth_distance_m", parameters.growth_distance_m},
          {"foliage_distance_m", parameters.foliage_distance_m},
          {"cluster_distance_m", parameters.cluster_distance_m},
          {"cluster_min_points", parameters.cluster_min_points},
          {"min_range_m", parameters.min_range_m},
          {"max_range_m", parameters.max_range_m},
          {"contemporary_s", seconds_of(parameters.contemporary_tolerance)},
          {"align", parameters.align}};
}

Json render(const Reference& reference) { return std::visit(RenderReference{}, reference); }

Json render(const Snapshot& snapshot, const ComparisonRecord& comparison) {
  return {{"id", comparison.id.value},
          {"scan", comparison.scan.value},
          {"site", site_with(snapshot, comparison.site).name},
          {"state", to_string(comparison.state)},
          {"failure", comparison.failure.empty() ? Json(nullptr) : Json(comparison.failure)},
          {"reference", render(comparison.reference)},
          {"parameters", render(comparison.parameters)},
          {"priors", render_priors(comparison.priors)},
          {"counts", render_counts(comparison)},
          {"testable", comparison.testable},
          {"changes", comparison.changes},
          {"timings_ms", Json(comparison.timings_ms)},
          {"warnings", comparison.warnings},
          {"created_at", format_rfc3339(comparison.created_at)},
          {"finished_at", render(comparison.finished_at)}};
}

Json render(const ComparisonCandidate& candidate) {
  return {{"scan", candidate.scan.value},       {"vantage", candidate.vantage.value},
          {"distance_m", candidate.distance_m}, {"age_s", seconds_of(candidate.age)},
          {"overlap", candidate.overlap},       {"gain", candidate.gain},
          {"chosen", candidate.chosen},         {"reason", candidate.reason}};
}

}  // namespace raywatch
