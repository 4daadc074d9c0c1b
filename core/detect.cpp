#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <numeric>

#include "core/compare.hpp"
#include "core/error.hpp"

namespace raywatch {
namespace {

/// T_a as a multiple of the spacing of a sensor's shots: wide enough to have neighbours on every side of a direction
/// also where the spacing varies.
constexpr double kAnglePerSpacing = 1.6;
/// Used when nothing is known of a sensor's resolution.
constexpr double kFallbackAngle_rad = std::numbers::pi / 180.0;

using Answers = std::vector<Answer>;  // of one prior, one a point

/// When a prior was taken, seen from the compared scan.
enum class Epoch : std::uint8_t { earlier, contemporary, later };

Epoch epoch_of(const ScanView& prior, const ScanView& scan, Duration tolerance) {
  const Duration age = scan.captured_at - prior.captured_at;
  if (std::chrono::abs(age) <= tolerance) return Epoch::contemporary;
  return age > Duration::zero() ? Epoch::earlier : Epoch::later;
}

/// The class of a point of a prior of that epoch that is free in the scan.
PointClass class_of_prior_point(Epoch prior) {
  switch (prior) {
    case Epoch::earlier:
      return PointClass::removed;
    case Epoch::later:
      return PointClass::added;
    case Epoch::contemporary:
      break;
  }
  return PointClass::discrepancy;
}

std::vector<std::uint8_t> valid_points(const ScanView& view) {
  const PointCloud& points = view.points;
  const UsableRange& usable = view.index.usable();
  std::vector<std::uint8_t> valid(points.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, points.size(), 16384), [&](const auto& block) {
    for (std::size_t i = block.begin(); i < block.end(); ++i) {
      const double x = points.x_m[i], y = points.y_m[i], z = points.z_m[i];
      valid[i] = is_usable(std::sqrt(x * x + y * y + z * z), usable);
    }
  });
  return valid;
}

double spacing_rad(const ScanView& view) {
  return view.sensor.angular_resolution_rad ? view.sensor.angular_resolution_rad->maxCoeff() : 0.0;
}

double angle_for(const ScanView& view, const CompareParameters& parameters) {
  if (parameters.angle_rad) return *parameters.angle_rad;
  const double spacing = spacing_rad(view);
  return spacing > 0.0 ? std::min(kAnglePerSpacing * spacing, std::numbers::pi / 2) : kFallbackAngle_rad;
}

void warn_of_coarse_rings(const ScanView& view, double angle_rad, const std::string& name,
                          std::vector<std::string>& warnings) {
  const double spacing = spacing_rad(view);
  if (spacing == 0.0 || angle_rad >= spacing) return;
  char text[240];
  const double degrees = 180.0 / std::numbers::pi;
  std::snprintf(text, sizeof text,
                "The angular threshold of %.4g degrees is below the spacing of the shots of %s (%.4g degrees): many "
                "points have no neighbours on every side, so that changes are missed; %.3g degrees or more would do.",
                angle_rad * degrees, name.c_str(), spacing * degrees, kAnglePerSpacing * spacing * degrees);
  warnings.emplace_back(text);
}

/// One prior's answers about one point, as the folds see them.
struct PriorOpinion {
  Answer answer;
  Epoch epoch;
};

/// The published grouping: changed if free in any prior. What an earlier or later prior says comes before a
/// contemporary one's discrepancy.
PointClass fold_union(std::span<const PriorOpinion> opinions) {
  bool supported = false, occluded = false, discrepancy = false, removed = false;
  for (const auto& [answer, epoch] : opinions) {
    if (answer == Answer::free && epoch == Epoch::earlier) return PointClass::added;
    removed |= answer == Answer::free && epoch == Epoch::later;
    discrepancy |= answer == Answer::free && epoch == Epoch::contemporary;
    supported |= answer == Answer::supported;
    occluded |= answer == Answer::occluded;
  }
  if (removed) return PointClass::removed;
  if (discrepancy) return PointClass::discrepancy;
  if (supported) return PointClass::unchanged;
  return occluded ? PointClass::occluded : PointClass::unseen;
}

/// Evidence is weighed: within each epoch the newest prior that can test the point decides (`opinions` are ordered from
/// the newest to the oldest; `group` numbers those that are contemporary with each other), and support within its group
/// wins. A discrepancy needs that no prior at all supports the point.
PointClass fold_consensus(std::span<const PriorOpinion> opinions, std::span<const std::uint32_t> group) {
  enum class Verdict : std::uint8_t { none, free, supported };
  struct EpochVerdict {
    Verdict verdict = Verdict::none;
    std::uint32_t group = 0;
  };
  std::array<EpochVerdict, 3> verdicts{};
  bool supported = false, free = false, occluded = false;
  for (std::size_t p = 0; p < opinions.size(); ++p) {
    const auto& [answer, epoch] = opinions[p];
    supported |= answer == Answer::supported;
    free |= answer == Answer::free;
    occluded |= answer == Answer::occluded;
    if (answer != Answer::supported && answer != Answer::free) continue;
    EpochVerdict& current = verdicts[static_cast<std::size_t>(epoch)];
    if (current.verdict == Verdict::none) {
      current = {answer == Answer::free ? Verdict::free : Verdict::supported, group[p]};
    } else if (current.group == group[p] && answer == Answer::supported) {
      current.verdict = Verdict::supported;
    }
  }
  const auto is_free = [&](Epoch epoch) { return verdicts[static_cast<std::size_t>(epoch)].verdict == Verdict::free; };
  if (is_free(Epoch::earlier)) return PointClass::added;
  if (is_free(Epoch::later)) return PointClass::removed;
  if (is_free(Epoch::contemporary) && !supported) return PointClass::discrepancy;
  if (supported || free) return PointClass::unchanged;
  return occluded ? PointClass::occluded : PointClass::unseen;
}

/// The priors from the newest to the oldest, and which of them are contemporary with each other: a group ends where the
/// step to the next older prior is longer than the tolerance.
struct PriorOrder {
  std::vector<std::size_t> newest_first;
  std::vector<std::uint32_t> group;  ///< in the order of `newest_first`
};

PriorOrder order_by_age(std::span<const ScanView> priors, Duration tolerance) {
  PriorOrder order;
  order.newest_first.resize(priors.size());
  std::iota(order.newest_first.begin(), order.newest_first.end(), std::size_t{0});
  std::stable_sort(order.newest_first.begin(), order.newest_first.end(),
                   [&](std::size_t a, std::size_t b) { return priors[a].captured_at > priors[b].captured_at; });
  std::uint32_t group = 0;
  for (std::size_t k = 0; k < priors.size(); ++k) {
    const bool gap =
        k > 0 && priors[order.newest_first[k - 1]].captured_at - priors[order.newest_first[k]].captured_at > tolerance;
    order.group.push_back(gap ? ++group : group);
  }
  return order;
}

PointCloud points_at(const PointCloud& points, std::span<const std::uint32_t> places) {
  PointCloud chosen;
  chosen.reserve(places.size());
  for (const std::uint32_t i : places) chosen.push_back(points.x_m[i], points.y_m[i], points.z_m[i]);
  return chosen;
}

/// One comparison's asking; its steps in the order in which `detect` runs them.
class Detector {
 public:
  Detector(const ScanView& scan, std::span<const ScanView> priors, const CompareParameters& parameters)
      : scan_(scan), priors_(priors), parameters_(parameters) {
    for (const ScanView& prior : priors) {
      epochs_.push_back(epoch_of(prior, scan, parameters.contemporary_tolerance));
      angles_rad_.push_back(angle_for(prior, parameters));
    }
    order_ = order_by_age(priors, parameters.contemporary_tolerance);
  }

  Detection run() {
    Detection detection;
    warn(detection);
    const std::vector<std::uint8_t> valid = valid_points(scan_);
    detection.answers = ask_priors(scan_.points, valid, scan_.world_from_sensor);
    judge_by_surfaces(detection.answers);
    ask_for_near_support(detection.answers);
    fold(valid, detection.answers, detection);
    for (std::uint32_t p = 0; p < priors_.size(); ++p) find_changed_points_of(p, detection);
    detection.angle_rad = angles_rad_;
    return detection;
  }

 private:
  void warn(Detection& detection) const {
    if (!parameters_.angle_rad) return;
    warn_of_coarse_rings(scan_, *parameters_.angle_rad, "the scan", detection.warnings);
    for (std::size_t p = 0; p < priors_.size(); ++p) {
      warn_of_coarse_rings(priors_[p], angles_rad_[p], "prior " + std::to_string(p), detection.warnings);
    }
  }

  Thresholds thresholds_of(std::size_t prior) const { return {angles_rad_[prior], parameters_.range_m}; }

  std::vector<Answers> ask_priors(const PointCloud& points, std::span<const std::uint8_t> valid,
                                  const Pose& world_from_points) const {
    std::vector<Answers> answers(priors_.size(), Answers(points.size()));
    for (std::size_t p = 0; p < priors_.size(); ++p) {
      const Pose prior_from_points = priors_[p].world_from_sensor.inverse() * world_from_points;
      ask(priors_[p].index, points, valid, prior_from_points, thresholds_of(p), answers[p]);
    }
    return answers;
  }

  bool asks_for_near_support() const {
    return parameters_.grouping == Grouping::consensus && parameters_.support_distance_m > 0.0;
  }

  /// Where a prior calls points free or cannot decide, its surface there is looked at more closely.
  void judge_by_surfaces(std::vector<Answers>& answers) const {
    if (!asks_for_near_support()) return;
    for (std::size_t p = 0; p < priors_.size(); ++p) {
      judge_by_surface_of(priors_[p], thresholds_of(p), scan_, answers[p]);
    }
  }

  void judge_by_surface_of(const ScanView& asked, const Thresholds& thresholds, const ScanView& view,
                           Answers& answers) const {
    std::vector<std::uint32_t> places;
    Answers open;
    for (std::uint32_t i = 0; i < answers.size(); ++i) {
      if (answers[i] != Answer::free && answers[i] != Answer::ambiguous) continue;
      places.push_back(i);
      open.push_back(answers[i]);
    }
    judge_by_surface(asked.index, points_at(view.points, places),
                     asked.world_from_sensor.inverse() * view.world_from_sensor, thresholds,
                     parameters_.support_distance_m, open);
    for (std::size_t k = 0; k < places.size(); ++k) answers[places[k]] = open[k];
  }

  /// Of the points that some prior calls free, those that a prior has a return near are supported by it after all.
  void ask_for_near_support(std::vector<Answers>& answers) const {
    if (!asks_for_near_support()) return;
    std::vector<std::uint32_t> free;
    for (std::uint32_t i = 0; i < scan_.points.size(); ++i) {
      const bool is_free = std::any_of(answers.begin(), answers.end(),
                                       [&](const Answers& of_prior) { return of_prior[i] == Answer::free; });
      if (is_free) free.push_back(i);
    }
    const PointCloud points = points_at(scan_.points, free);
    std::vector<std::uint8_t> near(points.size());
    for (std::size_t p = 0; p < priors_.size(); ++p) {
      find_near_returns(priors_[p].index, points, priors_[p].world_from_sensor.inverse() * scan_.world_from_sensor,
                        parameters_.support_distance_m, near);
      for (std::size_t k = 0; k < free.size(); ++k) {
        if (near[k]) answers[p][free[k]] = Answer::supported;
      }
    }
  }

  /// The same for the points of a prior that the scan calls free: those that are near a return of the scan are not.
  void drop_near_candidates(const ScanView& prior, std::vector<std::uint32_t>& candidates) const {
    if (!asks_for_near_support()) return;
    const PointCloud points = points_at(prior.points, candidates);
    std::vector<std::uint8_t> near(points.size());
    find_near_returns(scan_.index, points, scan_.world_from_sensor.inverse() * prior.world_from_sensor,
                      parameters_.support_distance_m, near);
    std::size_t kept = 0;
    for (std::size_t k = 0; k < candidates.size(); ++k) {
      if (!near[k]) candidates[kept++] = candidates[k];
    }
    candidates.resize(kept);
  }

  PointClass fold_one(std::span<const Answers> answers, std::size_t i, std::vector<PriorOpinion>& opinions) const {
    for (std::size_t k = 0; k < opinions.size(); ++k) {
      const std::size_t p = order_.newest_first[k];
      opinions[k] = {answers[p][i], epochs_[p]};
    }
    return parameters_.grouping == Grouping::union_ ? fold_union(opinions) : fold_consensus(opinions, order_.group);
  }

  void fold(std::span<const std::uint8_t> valid, std::span<const Answers> answers, Detection& detection) const {
    const std::size_t n = scan_.points.size();
    detection.classes.resize(n);
    detection.free.resize(n);
    detection.supported.resize(n);
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, n, 16384), [&](const auto& block) {
      std::vector<PriorOpinion> opinions(priors_.size());
      for (std::size_t i = block.begin(); i < block.end(); ++i) {
        detection.classes[i] = valid[i] ? fold_one(answers, i, opinions) : PointClass::invalid;
        if (!valid[i]) continue;
        for (const Answers& of_prior : answers) {
          detection.free[i] = static_cast<std::uint8_t>(detection.free[i] + (of_prior[i] == Answer::free));
          detection.supported[i] =
              static_cast<std::uint8_t>(detection.supported[i] + (of_prior[i] == Answer::supported));
        }
      }
    });
    std::size_t valid_count = 0, testable = 0;
    for (std::size_t i = 0; i < n; ++i) {
      valid_count += valid[i];
      testable += detection.free[i] > 0 || detection.supported[i] > 0;
    }
    detection.testable = valid_count == 0 ? 0.0 : static_cast<double>(testable) / static_cast<double>(valid_count);
  }

  /// The other way: the points of prior `p` that are free in the scan.
  void find_changed_points_of(std::uint32_t p, Detection& detection) const {
    const ScanView& prior = priors_[p];
    const std::vector<std::uint8_t> valid = valid_points(prior);
    Answers answers(prior.points.size());
    const Thresholds thresholds{angle_for(scan_, parameters_), parameters_.range_m};
    ask(scan_.index, prior.points, valid, scan_.world_from_sensor.inverse() * prior.world_from_sensor, thresholds,
        answers);
    if (asks_for_near_support()) judge_by_surface_of(scan_, thresholds, prior, answers);
    std::vector<std::uint32_t> candidates;
    for (std::uint32_t i = 0; i < answers.size(); ++i) {
      if (answers[i] == Answer::free) candidates.push_back(i);
    }
    drop_near_candidates(prior, candidates);
    add_prior_points(p, candidates, detection);
  }

  /// What the other priors say about the candidates. In a consensus, a prior that is newer than the candidate's own and
  /// can test the point decides: if it saw the place free, or if one of the scan's time supports the point, then
  /// nothing was removed since.
  void add_prior_points(std::uint32_t p, std::span<const std::uint32_t> candidates, Detection& detection) const {
    if (candidates.empty()) return;
    const PointCloud points = points_at(priors_[p].points, candidates);
    const std::vector<std::uint8_t> valid(points.size(), 1);
    std::vector<PriorPointVotes> votes(points.size());
    std::vector<std::uint8_t> refuted(points.size(), 0);
    Answers answers(points.size());
    for (std::size_t q = 0; q < priors_.size(); ++q) {
      if (q == p) continue;
      ask(priors_[q].index, points, valid, priors_[q].world_from_sensor.inverse() * priors_[p].world_from_sensor,
          thresholds_of(q), answers);
      const bool newer = priors_[q].captured_at > priors_[p].captured_at + parameters_.contemporary_tolerance;
      const bool same_time_as_scan = epochs_[q] == Epoch::contemporary;
      for (std::size_t i = 0; i < answers.size(); ++i) {
        votes[i].free = static_cast<std::uint8_t>(votes[i].free + (answers[i] == Answer::free));
        votes[i].supported = static_cast<std::uint8_t>(votes[i].supported + (answers[i] == Answer::supported));
        refuted[i] |= same_time_as_scan ? answers[i] == Answer::supported : newer && answers[i] == Answer::free;
      }
    }
    const PointClass point_class = class_of_prior_point(epochs_[p]);
    for (std::size_t i = 0; i < candidates.size(); ++i) {
      if (parameters_.grouping == Grouping::consensus && refuted[i]) continue;
      detection.prior_points.push_back({.prior = p, .index = candidates[i], .point_class = point_class});
      detection.prior_votes.push_back(votes[i]);
    }
  }

  const ScanView& scan_;
  std::span<const ScanView> priors_;
  const CompareParameters& parameters_;
  std::vector<Epoch> epochs_;
  std::vector<double> angles_rad_;
  PriorOrder order_;
};

void check(const CompareParameters& parameters, std::size_t priors) {
  std::vector<FieldError> errors;
  const auto require = [&](bool holds, const char* field, const char* message) {
    if (!holds) errors.push_back({field, message});
  };
  const double angle = parameters.angle_rad.value_or(kFallbackAngle_rad);
  require(angle > 0.0 && angle <= std::numbers::pi / 2, "angle_deg", "must be above 0 and at most 90");
  require(std::isfinite(parameters.range_m) && parameters.range_m >= 0.0, "range_m", "must be 0 or more");
  require(std::isfinite(parameters.support_distance_m) && parameters.support_distance_m >= 0.0, "support_distance_m",
          "must be 0 or more");
  require(std::isfinite(parameters.cluster_distance_m) && parameters.cluster_distance_m > 0.0, "cluster_distance_m",
          "must be above 0");
  require(parameters.min_range_m >= 0.0, "min_range_m", "must be 0 or more");
  require(parameters.max_range_m > parameters.min_range_m, "max_range_m", "must be above min_range_m");
  require(parameters.contemporary_tolerance >= Duration::zero(), "contemporary_s", "must be 0 or more");
  require(priors <= 255, "scans", "at most 255 priors can be compared at once");
  if (!errors.empty()) throw InvalidInput("A parameter of the comparison is out of its range.", std::move(errors));
}

}  // namespace

Detection detect(const ScanView& scan, std::span<const ScanView> priors, const CompareParameters& parameters) {
  check(parameters, priors.size());
  return Detector(scan, priors, parameters).run();
}

}  // namespace raywatch
