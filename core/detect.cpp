#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "core/compare.hpp"
#include "core/error.hpp"
#include "core/evidence.hpp"
#include "core/fold.hpp"
#include "core/grow.hpp"
#include "core/index_kernels.hpp"

namespace raywatch {
namespace {

/// T_a as a multiple of the spacing of a sensor's shots: wide enough to have neighbours on every side of a direction
/// also where the spacing varies.
constexpr double kAnglePerSpacing = 1.6;
/// Used when nothing is known of a sensor's resolution.
constexpr double kFallbackAngle_rad = std::numbers::pi / 180.0;

using Answers = std::vector<Answer>;  // of one prior, one a point

constexpr std::size_t kGrain = 16384;

std::vector<std::uint8_t> valid_points(const ScanView& view) {
  std::vector<std::uint8_t> valid(view.points.size());
  const PointPlanes planes = planes_of(view.points);
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, valid.size(), kGrain), [&](const auto& block) {
    find_usable(planes.subspan(block.begin(), block.size()), view.index.usable(), valid.data() + block.begin());
  });
  return valid;
}

double spacing_rad(const ScanView& view) {
  return view.sensor.angular_resolution_rad ? view.sensor.angular_resolution_rad->maxCoeff() : 0.0;
}

double neighbour_angle(const ScanView& view) {
  const double spacing = spacing_rad(view);
  return spacing > 0.0 ? std::min(kAnglePerSpacing * spacing, std::numbers::pi / 2) : kFallbackAngle_rad;
}

double angle_for(const ScanView& view, const CompareParameters& parameters) {
  return parameters.angle_rad.value_or(neighbour_angle(view));
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
      : scan_(scan),
        priors_(priors),
        parameters_(parameters),
        weighs_(parameters.grouping == Grouping::consensus && parameters.support_distance_m > 0.0) {
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
    detection.answers = ask_priors(valid);
    weigh_answers(detection.answers);
    detection.classes = fold(valid, detection.answers);
    grow_over_scan(detection);
    count_answers(valid, detection);
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

  Thresholds thresholds_for(const ScanView& asked) const {
    return {angle_for(asked, parameters_), parameters_.range_m};
  }

  /// For `weigh`: a surface needs neighbours on every side. Farther ones, which a wide T_a would add, only make it less
  /// flat.
  Thresholds surface_thresholds_for(const ScanView& asked) const {
    return {std::min(angle_for(asked, parameters_), neighbour_angle(asked)), parameters_.range_m};
  }

  std::vector<Answers> ask_priors(std::span<const std::uint8_t> valid) const {
    std::vector<Answers> answers(priors_.size(), Answers(scan_.points.size()));
    for (std::size_t p = 0; p < priors_.size(); ++p) {
      const Pose prior_from_scan = priors_[p].world_from_sensor.inverse() * scan_.world_from_sensor;
      ask(priors_[p].index, scan_.points, valid, prior_from_scan, thresholds_for(priors_[p]), answers[p]);
    }
    return answers;
  }

  /// Looks more closely at what `asked` answered about some points of `view`.
  void weigh_at(const ScanView& asked, const ScanView& view, std::span<const std::uint32_t> places,
                Answers& answers) const {
    Answers chosen;
    for (const std::uint32_t i : places) chosen.push_back(answers[i]);
    weigh(asked.index, points_at(view.points, places), asked.world_from_sensor.inverse() * view.world_from_sensor,
          surface_thresholds_for(asked), tolerance_between(asked, view, parameters_), chosen);
    for (std::size_t k = 0; k < places.size(); ++k) answers[places[k]] = chosen[k];
  }

  /// Where a prior calls a point free or cannot decide, all priors are weighed.
  void weigh_answers(std::vector<Answers>& answers) const {
    if (!weighs_) return;
    std::vector<std::uint32_t> places;
    for (std::uint32_t i = 0; i < scan_.points.size(); ++i) {
      if (std::any_of(answers.begin(), answers.end(),
                      [&](const Answers& of_prior) { return is_undecided(of_prior[i]); })) {
        places.push_back(i);
      }
    }
    for (std::size_t p = 0; p < priors_.size(); ++p) weigh_at(priors_[p], scan_, places, answers[p]);
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
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, classes.size(), kGrain), [&](const auto& block) {
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

  bool grows() const { return weighs_ && parameters_.clustering; }

  /// The points of the scan beside changes that no prior supports.
  void grow_over_scan(Detection& detection) const {
    if (!grows()) return;
    const std::vector<Candidate> candidates = candidates_of_scan(detection);
    const auto is_open = [&](std::span<const std::uint32_t> places) {
      for (std::size_t p = 0; p < priors_.size(); ++p) weigh_at(priors_[p], scan_, places, detection.answers[p]);
      std::vector<std::uint8_t> open;
      std::vector<PriorOpinion> opinions(priors_.size());
      for (const std::uint32_t i : places) {
        open.push_back(fold_one(detection.answers, i, opinions) != PointClass::unchanged);
      }
      return open;
    };
    for (const Candidate& candidate : candidates) detection.classes[candidate.index] = PointClass::unchanged;
    for (const auto& [i, point_class] : grow(scan_, candidates, priors_, parameters_, is_open)) {
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
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, n, kGrain), [&](const auto& block) {
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

  /// The other way: the points of prior `p` that are free in the scan.
  void find_changed_points_of(std::uint32_t p, Detection& detection) const {
    const ScanView& prior = priors_[p];
    const std::vector<std::uint8_t> valid = valid_points(prior);
    Answers answers(prior.points.size());
    ask(scan_.index, prior.points, valid, scan_.world_from_sensor.inverse() * prior.world_from_sensor,
        thresholds_for(scan_), answers);
    if (weighs_) weigh_at(scan_, prior, places_of(answers, is_undecided), answers);
    const std::vector<std::uint32_t> free = places_of(answers, [](Answer answer) { return answer == Answer::free; });
    if (parameters_.grouping == Grouping::union_) return add_prior_points(p, free, detection);
    const std::vector<Candidate> candidates = candidates_of_prior(p, free);
    std::vector<std::uint32_t> changed;
    if (grows()) {
      changed = grow_over_prior(p, answers, candidates);
    } else {
      for (const Candidate& candidate : candidates) {
        if (!candidate.contradicted) changed.push_back(candidate.index);
      }
    }
    add_prior_points(p, changed, detection);
  }

  template <class Predicate>
  static std::vector<std::uint32_t> places_of(const Answers& answers, Predicate predicate) {
    std::vector<std::uint32_t> places;
    for (std::uint32_t i = 0; i < answers.size(); ++i) {
      if (predicate(answers[i])) places.push_back(i);
    }
    return places;
  }

  std::vector<Candidate> candidates_of_prior(std::uint32_t p, std::span<const std::uint32_t> free) const {
    const std::vector<std::uint8_t> refuted = refuted_points(p, free);
    std::vector<Candidate> candidates;
    for (std::size_t k = 0; k < free.size(); ++k) {
      candidates.push_back({free[k], class_of_prior_point(epochs_[p]), refuted[k] != 0});
    }
    return candidates;
  }

  std::vector<std::uint32_t> grow_over_prior(std::uint32_t p, Answers& answers,
                                             std::span<const Candidate> candidates) const {
    const auto is_open = [&](std::span<const std::uint32_t> places) {
      weigh_at(scan_, priors_[p], places, answers);
      const std::vector<std::uint8_t> refuted = refuted_points(p, places);
      std::vector<std::uint8_t> open;
      for (std::size_t k = 0; k < places.size(); ++k)
        open.push_back(answers[places[k]] != Answer::supported && !refuted[k]);
      return open;
    };
    std::vector<std::uint32_t> changed;
    for (const auto& [i, point_class] : grow(priors_[p], candidates, {&scan_, 1}, parameters_, is_open)) {
      changed.push_back(i);
    }
    return changed;
  }

  /// What prior `q` says about points of prior `p`.
  Answers ask_about_prior(std::size_t q, std::uint32_t p, const PointCloud& points) const {
    const std::vector<std::uint8_t> valid(points.size(), 1);
    Answers answers(points.size());
    const Pose q_from_p = priors_[q].world_from_sensor.inverse() * priors_[p].world_from_sensor;
    ask(priors_[q].index, points, valid, q_from_p, thresholds_for(priors_[q]), answers);
    if (weighs_) {
      weigh(priors_[q].index, points, q_from_p, surface_thresholds_for(priors_[q]),
            tolerance_between(priors_[q], priors_[p], parameters_), answers);
    }
    return answers;
  }

  /// A prior that is newer than `p` and can test the point decides: if it saw the place free, or if one of the scan's
  /// time supports the point, then nothing was removed since.
  std::vector<std::uint8_t> refuted_points(std::uint32_t p, std::span<const std::uint32_t> places) const {
    std::vector<std::uint8_t> refuted(places.size(), 0);
    const PointCloud points = points_at(priors_[p].points, places);
    for (std::size_t q = 0; q < priors_.size(); ++q) {
      const bool newer = priors_[q].captured_at > priors_[p].captured_at + parameters_.contemporary_tolerance;
      const bool same_time_as_scan = epochs_[q] == Epoch::contemporary;
      if (q == p || !(newer || same_time_as_scan)) continue;
      const Answers answers = ask_about_prior(q, p, points);
      for (std::size_t k = 0; k < places.size(); ++k) {
        refuted[k] |= same_time_as_scan ? answers[k] == Answer::supported : answers[k] == Answer::free;
      }
    }
    return refuted;
  }

  void add_prior_points(std::uint32_t p, std::span<const std::uint32_t> changed, Detection& detection) const {
    const PointCloud points = points_at(priors_[p].points, changed);
    std::vector<PriorPointVotes> votes(changed.size());
    for (std::size_t q = 0; q < priors_.size(); ++q) {
      if (q == p || changed.empty()) continue;
      const Answers answers = ask_about_prior(q, p, points);
      for (std::size_t k = 0; k < changed.size(); ++k) {
        votes[k].free = static_cast<std::uint8_t>(votes[k].free + (answers[k] == Answer::free));
        votes[k].supported = static_cast<std::uint8_t>(votes[k].supported + (answers[k] == Answer::supported));
      }
    }
    const PointClass point_class = class_of_prior_point(epochs_[p]);
    for (std::size_t k = 0; k < changed.size(); ++k) {
      detection.prior_points.push_back({.prior = p, .index = changed[k], .point_class = point_class});
      detection.prior_votes.push_back(votes[k]);
    }
  }

  static bool is_undecided(Answer answer) { return answer == Answer::free || answer == Answer::ambiguous; }

  const ScanView& scan_;
  std::span<const ScanView> priors_;
  const CompareParameters& parameters_;
  bool weighs_;
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
  require(std::isfinite(parameters.growth_distance_m) && parameters.growth_distance_m >= 0.0, "growth_distance_m",
          "must be 0 or more");
  require(std::isfinite(parameters.foliage_distance_m) && parameters.foliage_distance_m >= 0.0, "foliage_distance_m",
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
