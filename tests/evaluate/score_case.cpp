#include "tests/evaluate/score_case.hpp"

#include <algorithm>

#include "server/stopwatch.hpp"
#include "tests/evaluate/testable.hpp"

namespace raywatch::evaluation {

CaseScore& CaseScore::operator+=(const CaseScore& other) {
  single += other.single;
  single_in_sight += other.single_in_sight;
  clustered.resize(std::max(clustered.size(), other.clustered.size()));
  for (std::size_t k = 0; k < other.clustered.size(); ++k) {
    clustered[k].points += other.clustered[k].points;
    clustered[k].in_sight += other.clustered[k].in_sight;
    clustered[k].objects += other.clustered[k].objects;
  }
  return *this;
}

namespace {

void ignore_untestable(const std::vector<std::uint8_t>& testable, std::vector<Truth>& truth) {
  for (std::size_t i = 0; i < truth.size(); ++i) {
    if (truth[i] == Truth::changed && !testable[i]) truth[i] = Truth::ignored;
  }
}

}  // namespace

CaseLabels labels_of(const IndexedPlace& place, const Case& c) {
  CaseLabels labels;
  labels.scan = &place.place().scans[c.scan];
  for (const std::size_t prior : c.priors) labels.priors.push_back(&place.place().scans[prior]);
  labels.truth = truth_of(*labels.scan, labels.priors);
  const CaseViews views = place.views(c, Grouping::consensus);
  labels.testable_scan = testable_points(views.scan, views.priors);
  for (const ScanView& prior : views.priors) {
    labels.testable_priors.push_back(testable_points(prior, std::span(&views.scan, 1)));
  }
  labels.in_sight = labels.truth;
  ignore_untestable(labels.testable_scan, labels.in_sight.scan);
  for (std::size_t p = 0; p < views.priors.size(); ++p) {
    ignore_untestable(labels.testable_priors[p], labels.in_sight.priors[p]);
  }
  return labels;
}

TimedScore score_case(const IndexedPlace& place, const Case& c, const CaseLabels& labels,
                      const CompareParameters& parameters, std::span<const Clustering> clusterings) {
  const CaseViews views = place.refined_views(c, parameters);
  Stopwatch watch;
  const Detection detection = detect(views.scan, views.priors, parameters);
  TimedScore timed{.score = {}, .detect_ms = watch.lap_ms()};
  CaseScore& score = timed.score;
  const Verdicts single = verdicts_of(detection, views.priors);
  score.single = count_points(single, labels.truth);
  score.single_in_sight = count_points(single, labels.in_sight);
  for (const Clustering& clustering : clusterings) {
    CompareParameters with = parameters;
    with.clustering = true;
    with.cluster_distance_m = clustering.distance_m;
    with.cluster_min_points = clustering.min_points;
    const Comparison comparison = form_changes(views.scan, views.priors, with, detection);
    const Verdicts verdicts = verdicts_of(comparison, views.priors);
    score.clustered.push_back({count_points(verdicts, labels.truth), count_points(verdicts, labels.in_sight),
                               count_objects(comparison, labels)});
  }
  return timed;
}

}  // namespace raywatch::evaluation
