#include "tests/evaluate/score.hpp"

#include <algorithm>

namespace raywatch::evaluation {
namespace {

double share(std::size_t part, std::size_t whole) {
  return whole == 0 ? 1.0 : static_cast<double>(part) / static_cast<double>(whole);
}

bool is_named(StateId label) { return label != simulator::kBackground && label != simulator::kNoSurface; }

bool was_there(const SimulatedScan& scan, StateId label) { return std::ranges::binary_search(scan.present, label); }

/// `changed(label)` is asked about every label that names an object.
template <class Changed>
std::vector<Truth> truths(const std::vector<StateId>& labels, Changed changed) {
  std::vector<Truth> truth;
  truth.reserve(labels.size());
  for (const StateId label : labels) {
    if (label == simulator::kNoSurface) {
      truth.push_back(Truth::ignored);
    } else {
      truth.push_back(is_named(label) && changed(label) ? Truth::changed : Truth::unchanged);
    }
  }
  return truth;
}

bool is_change(PointClass point_class) {
  return point_class == PointClass::added || point_class == PointClass::removed ||
         point_class == PointClass::discrepancy;
}

Verdicts make_verdicts(std::span<const PointClass> classes, std::span<const PriorPoint> prior_points,
                       std::span<const ScanView> priors) {
  Verdicts verdicts;
  for (const PointClass point_class : classes) verdicts.scan.push_back(is_change(point_class) ? 1 : 0);
  for (const ScanView& prior : priors) verdicts.priors.emplace_back(prior.points.size(), std::uint8_t{0});
  for (const PriorPoint& point : prior_points) verdicts.priors[point.prior][point.index] = 1;
  return verdicts;
}

PointCounts count(std::span<const std::uint8_t> called, std::span<const Truth> truth) {
  PointCounts counts;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    if (truth[i] == Truth::ignored) continue;
    const bool changed = truth[i] == Truth::changed;
    ++(changed ? (called[i] ? counts.found : counts.missed) : (called[i] ? counts.false_ : counts.unchanged));
  }
  return counts;
}

}  // namespace

double PointCounts::precision() const { return share(found, found + false_); }
double PointCounts::recall() const { return share(found, found + missed); }
double PointCounts::f_score() const { return share(2 * found, 2 * found + false_ + missed); }

PointCounts& PointCounts::operator+=(const PointCounts& other) {
  found += other.found;
  false_ += other.false_;
  missed += other.missed;
  unchanged += other.unchanged;
  return *this;
}

PointCounts Counts::both() const {
  PointCounts sum = added;
  return sum += removed;
}

Counts& Counts::operator+=(const Counts& other) {
  added += other.added;
  removed += other.removed;
  return *this;
}

CaseTruth truth_of(const SimulatedScan& scan, std::span<const SimulatedScan* const> priors) {
  CaseTruth truth;
  truth.scan = truths(scan.labels, [&](StateId label) {
    return std::ranges::none_of(priors, [&](const SimulatedScan* prior) { return was_there(*prior, label); });
  });
  for (const SimulatedScan* prior : priors) {
    truth.priors.push_back(truths(prior->labels, [&](StateId label) { return !was_there(scan, label); }));
  }
  return truth;
}

Verdicts verdicts_of(const Detection& detection, std::span<const ScanView> priors) {
  return make_verdicts(detection.classes, detection.prior_points, priors);
}

Verdicts verdicts_of(const Comparison& comparison, std::span<const ScanView> priors) {
  return make_verdicts(comparison.classes, comparison.prior_points, priors);
}

Counts count_points(const Verdicts& verdicts, const CaseTruth& truth) {
  Counts counts{.added = count(verdicts.scan, truth.scan), .removed = {}};
  for (std::size_t p = 0; p < truth.priors.size(); ++p) counts.removed += count(verdicts.priors[p], truth.priors[p]);
  return counts;
}

}  // namespace raywatch::evaluation
