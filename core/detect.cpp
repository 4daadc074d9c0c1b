#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/asking.hpp"
#include "core/detect_points.hpp"
#include "core/error.hpp"
#include "core/fold.hpp"
#include "core/grow.hpp"
#include "core/prior_changes.hpp"
#include "core/prior_index_impl.hpp"

namespace raywatch {
namespace {

constexpr std::size_t kClassGrain = 16384;

/// One comparison's asking; its steps in the order in which `detect` runs them.
class Detector {
 public:
  Detector(const ScanView& scan, std::span<const ScanView> priors, const CompareParameters& parameters)
      : scan_(scan),
        priors_(priors),
        parameters_(parameters),
        asking_(parameters),
        order_(order_by_age(priors, parameters.contemporary_tolerance)) {
    for (const ScanView& prior : priors) epochs_.push_back(epoch_of(prior, scan, parameters.contemporary_tolerance));
  }

  /// One way: the scan's points against the priors.
  Detection run_points() {
    Detection detection;
    warn(detection);
    const std::vector<std::uint8_t> valid = valid_points(scan_);
    for (const ScanView& prior : priors_) detection.answers.push_back(asking_.ask_all(prior, scan_, valid));
    look_closely(detection.answers);
    detection.classes = fold(valid, detection.answers);
    grow_over_scan(detection);
    count_answers(valid, detection);
    for (const ScanView& prior : priors_) detection.angle_rad.push_back(asking_.angle_rad(prior));
    return detection;
  }

  Detection run() {
    Detection detection = run_points();
    PriorChanges changes = find_prior_changes(scan_, priors_, asking_);
    detection.prior_points = std::move(changes.points);
    detection.prior_votes = std::move(changes.votes);
    return detection;
  }

 private:
  void warn(Detection& detection) const {
    asking_.warn_of_coarse_rings(scan_, "the scan", detection.warnings);
    for (std::size_t p = 0; p < priors_.size(); ++p) {
      asking_.warn_of_coarse_rings(priors_[p], "prior " + std::to_string(p), detection.warnings);
    }
  }

  /// Where a prior calls a point free or cannot decide, all priors look closely.
  void look_closely(std::vector<Answers>& answers) const {
    if (!asking_.weighs()) return;
    std::vector<std::uint32_t> places;
    for (std::uint32_t i = 0; i < scan_.points.size(); ++i) {
      if (std::any_of(answers.begin(), answers.end(),
                      [&](const Answers& of_prior) { return is_undecided(of_prior[i]); })) {
        places.push_back(i);
      }
    }
    for (std::size_t p = 0; p < priors_.size(); ++p) asking_.look_closely(priors_[p], scan_, places, answers[p]);
  }

  PointClass fold_one(std::span<const Answers> answers, std::size_t i, std::vector<PriorOpinion>& opinions) const {
    for (std::size_t k = 0; k < opinions.size(); ++k) {
      const std::size_t p = order_.newest_first[k];
      opinions[k] = {answers[p][i], epochs_[p]};
    }
    return parameters_.grouping == Grouping::union_ ? fold_union(opinions) : fold_consensus(opinions, order_.group);
  }

  std::vector<PointClass> fold(std::span<const std::uint8_t> valid, std::span<const Answers> answers) const {
    std::vector<PointClass> classes(scan_.points.size());
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, classes.size(), kClassGrain), [&](const auto& block) {
      if (parameters_.grouping == Grouping::union_) {
        fold_union(answers, epochs_, block.begin(), std::span(classes).subspan(block.begin(), block.size()));
      } else {
        std::vector<PriorOpinion> opinions(priors_.size());
        for (std::size_t i = block.begin(); i < block.end(); ++i) classes[i] = fold_one(answers, i, opinions);
      }
      for (std::size_t i = block.begin(); i < block.end(); ++i) {
        if (!valid[i]) classes[i] = PointClass::invalid;
      }
    });
    return classes;
  }

  /// The points of the scan beside changes that no prior supports.
  void grow_over_scan(Detection& detection) const {
    if (!asking_.grows()) return;
    const std::vector<Candidate> candidates = candidates_of_scan(detection);
    const std::vector<JudgedCluster> clusters = judge_clusters(scan_, candidates, priors_, false, parameters_);
    const std::vector<ClassedPoint> seeds = find_seeds({&clusters, 1}, parameters_).front();
    for (const Candidate& candidate : candidates) detection.classes[candidate.index] = PointClass::unchanged;
    if (seeds.empty()) return;
    const auto is_open = [&](std::span<const std::uint32_t> places) {
      for (std::size_t p = 0; p < priors_.size(); ++p) {
        asking_.look_closely(priors_[p], scan_, places, detection.answers[p]);
      }
      std::vector<std::uint8_t> open;
      std::vector<PriorOpinion> opinions(priors_.size());
      for (const std::uint32_t i : places) {
        open.push_back(fold_one(detection.answers, i, opinions) != PointClass::unchanged);
      }
      return open;
    };
    const std::vector<std::uint32_t> sources = sources_of(scan_.index.impl(), scan_.points);
    for (const auto& [i, point_class] : grow(scan_, sources, seeds, candidates, parameters_, is_open)) {
      detection.classes[i] = point_class;
    }
  }

  /// What is free in any prior; contradicted if the priors together say otherwise.
  std::vector<Candidate> candidates_of_scan(const Detection& detection) const {
    std::vector<Candidate> candidates;
    std::vector<PriorOpinion> opinions(priors_.size());
    for (std::uint32_t i = 0; i < detection.classes.size(); ++i) {
      const PointClass decided = detection.classes[i];
      if (decided == PointClass::invalid) continue;
      for (std::size_t p = 0; p < priors_.size(); ++p) opinions[p] = {detection.answers[p][i], epochs_[p]};
      const PointClass any = fold_union(opinions);
      if (is_change(any)) candidates.push_back({i, is_change(decided) ? decided : any, !is_change(decided)});
    }
    return candidates;
  }

  /// Points that are not valid were answered unseen.
  void count_answers(std::span<const std::uint8_t> valid, Detection& detection) const {
    const std::size_t n = scan_.points.size();
    detection.free.resize(n);
    detection.supported.resize(n);
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, n, kClassGrain), [&](const auto& block) {
      for (const Answers& of_prior : detection.answers) {
        for (std::size_t i = block.begin(); i < block.end(); ++i) {
          detection.free[i] = static_cast<std::uint8_t>(detection.free[i] + (of_prior[i] == Answer::free));
          detection.supported[i] =
              static_cast<std::uint8_t>(detection.supported[i] + (of_prior[i] == Answer::supported));
        }
      }
    });
    std::size_t valid_count = 0, testable = 0;
    for (std::size_t i = 0; i < n; ++i) {
      valid_count += valid[i];
      testable += (detection.free[i] | detection.supported[i]) != 0;
    }
    detection.testable = valid_count == 0 ? 0.0 : static_cast<double>(testable) / static_cast<double>(valid_count);
  }

  const ScanView& scan_;
  std::span<const ScanView> priors_;
  const CompareParameters& parameters_;
  Asking asking_;
  std::vector<Epoch> epochs_;
  PriorOrder order_;
};

void check(const CompareParameters& parameters, std::size_t priors) {
  std::vector<FieldError> errors;
  const auto require = [&](bool holds, const char* field, const char* message) {
    if (!holds) errors.push_back({field, message});
  };
  if (parameters.angle_rad) {
    require(*parameters.angle_rad > 0.0 && *parameters.angle_rad <= std::numbers::pi / 2, "angle_deg",
            "must be above 0 and at most 90");
  }
  require(std::isfinite(parameters.range_m) && parameters.range_m >= 0.0, "range_m", "must be 0 or more");
  require(std::isfinite(parameters.support_distance_m) && parameters.support_distance_m >= 0.0, "support_distance_m",
          "must be 0 or more");
  require(std::isfinite(parameters.growth_distance_m) && parameters.growth_distance_m >= 0.0, "growth_distance_m",
          "must be 0 or more");
  require(std::isfinite(parameters.foliage_distance_m) && parameters.foliage_distance_m >= 0.0, "foliage_distance_m",
          "must be 0 or more");
  require(std::isfinite(parameters.cluster_distance_m) && parameters.cluster_distance_m > 0.0, "cluster_distance_m",
          "must be above 0");
  require(parameters.min_range_m >= 0.0, "min_range_m", "must be 0 or more");
  require(parameters.max_range_m > parameters.min_range_m, "max_range_m", "must be above min_range_m");
  require(parameters.contemporary_tolerance >= Duration::zero(), "contemporary_s", "must be 0 or more");
  require(priors <= 255, "scans", "must be at most 255 at once");
  if (errors.empty()) return;
  std::string message = "A parameter of the comparison is out of its range:";
  for (std::size_t i = 0; i < errors.size(); ++i) {
    message += (i == 0 ? " " : "; ") + errors[i].field + " " + errors[i].message;
  }
  throw InvalidInput(message, std::move(errors));
}

}  // namespace

Detection detect(const ScanView& scan, std::span<const ScanView> priors, const CompareParameters& parameters) {
  check(parameters, priors.size());
  return Detector(scan, priors, parameters).run();
}

Detection detect_points(const ScanView& scan, std::span<const ScanView> priors, const CompareParameters& parameters) {
  check(parameters, priors.size());
  return Detector(scan, priors, parameters).run_points();
}

}  // namespace raywatch
