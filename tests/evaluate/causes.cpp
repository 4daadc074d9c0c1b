#include "tests/evaluate/causes.hpp"

#include <algorithm>
#include <cstdio>
#include <map>
#include <optional>

#include "tests/evaluate/surroundings.hpp"
#include "tests/simulator/scanner.hpp"

namespace raywatch::evaluation {
namespace {

constexpr std::size_t kFaintReturns = 40;
constexpr double kFoot_m = 0.10;
constexpr double kMargin_m = 0.10;
const double kGrazing_rad = simulator::radians(75.0);

/// One scan of a case whose points are judged, and the scans that they are judged by.
struct Judged {
  const ScanView& view;
  std::span<const ScanView> others;
  const std::vector<StateId>& labels;
  const std::vector<Truth>& truth;
  const std::vector<std::uint8_t>& testable;
  const std::vector<std::uint8_t>& called;
};

/// For each point whether one of those whose truth is `beside` lies within the reach of a foot.
std::vector<std::uint8_t> near_truth(const Judged& judged, Truth beside) {
  const PointCloud& points = judged.view.points;
  PointCloud chosen;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (judged.truth[i] == beside) chosen.push_back(points.x_m[i], points.y_m[i], points.z_m[i]);
  }
  std::vector<std::uint8_t> near(points.size(), 0);
  if (chosen.empty()) return near;
  find_near_returns(PriorIndex::build(chosen, {}), points, Pose{}, kFoot_m, near);
  return near;
}

class CauseFinder {
 public:
  explicit CauseFinder(const Judged& judged)
      : judged_(judged),
        near_static_(near_truth(judged, Truth::unchanged)),
        near_changed_(near_truth(judged, Truth::changed)) {
    for (std::size_t i = 0; i < judged.truth.size(); ++i) {
      if (judged.truth[i] == Truth::changed) ++returns_[judged.labels[i]];
    }
  }

  Cause cause_of(std::size_t i, bool missed) const {
    if (missed && !judged_.testable[i]) return Cause::unseen;
    if (missed && returns_.at(judged_.labels[i]) < kFaintReturns) return Cause::faint;
    if (missed ? near_static_[i] : near_changed_[i]) return Cause::foot;
    const Eigen::Vector3d world_m = judged_.view.world_from_sensor * judged_.view.points[i].cast<double>();
    bool grazing = is_grazing(surroundings_of(judged_.view, world_m, kMargin_m));
    for (const ScanView& other : judged_.others) {
      const Surroundings seen = surroundings_of(other, world_m, kMargin_m);
      if (seen.nearer > 0 && seen.farther > 0) return Cause::silhouette;
      grazing |= is_grazing(seen);
    }
    return grazing ? Cause::grazing : Cause::other;
  }

 private:
  static bool is_grazing(const Surroundings& seen) { return seen.flat && seen.incidence_rad > kGrazing_rad; }

  const Judged& judged_;
  std::vector<std::uint8_t> near_static_, near_changed_;
  std::map<StateId, std::size_t> returns_;
};

/// The wrongly judged points, without their causes.
std::vector<PointError> wrong_points(const Judged& judged, std::optional<std::uint32_t> prior) {
  std::vector<PointError> errors;
  for (std::uint32_t i = 0; i < judged.truth.size(); ++i) {
    if (judged.truth[i] == Truth::ignored) continue;
    const bool changed = judged.truth[i] == Truth::changed;
    if (changed == (judged.called[i] != 0)) continue;
    errors.push_back({.of_scan = !prior, .prior = prior.value_or(0), .index = i, .missed = changed});
  }
  return errors;
}

void append_errors(const Judged& judged, std::optional<std::uint32_t> prior, std::vector<PointError>& errors) {
  std::vector<PointError> found = wrong_points(judged, prior);
  if (found.empty()) return;
  const CauseFinder finder(judged);
  for (PointError& error : found) error.cause = finder.cause_of(error.index, error.missed);
  errors.insert(errors.end(), found.begin(), found.end());
}

}  // namespace

std::vector<PointError> find_errors(const CaseViews& views, const CaseLabels& labels, const Verdicts& verdicts) {
  std::vector<PointError> errors;
  append_errors({views.scan, views.priors, labels.scan->labels, labels.truth.scan, labels.testable_scan, verdicts.scan},
                std::nullopt, errors);
  for (std::uint32_t p = 0; p < views.priors.size(); ++p) {
    append_errors({views.priors[p], std::span(&views.scan, 1), labels.priors[p]->labels, labels.truth.priors[p],
                   labels.testable_priors[p], verdicts.priors[p]},
                  p, errors);
  }
  return errors;
}

void CauseTable::add(const std::vector<PointError>& errors) {
  for (const PointError& error : errors) {
    ++counts_[static_cast<std::size_t>(error.cause)][column(error.of_scan, error.missed)];
  }
}

void CauseTable::write_markdown(std::ostream& out) const {
  out << "| cause | false added | missed added | false removed | missed removed | share of all errors |\n"
         "| --- | ---: | ---: | ---: | ---: | ---: |\n";
  std::size_t all = 0;
  for (const auto& row : counts_) {
    for (const std::size_t count : row) all += count;
  }
  for (std::size_t cause = 0; cause < counts_.size(); ++cause) {
    std::size_t sum = 0;
    out << "| " << kCauseNames[cause];
    for (const std::size_t count : counts_[cause]) {
      out << " | " << count;
      sum += count;
    }
    char share[16];
    std::snprintf(share, sizeof share, "%.1f %%",
                  all == 0 ? 0.0 : 100.0 * static_cast<double>(sum) / static_cast<double>(all));
    out << " | " << share << " |\n";
  }
}

}  // namespace raywatch::evaluation
