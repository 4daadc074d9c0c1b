#include "core/prior_changes.hpp"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <limits>
#include <optional>

#include "core/fold.hpp"
#include "core/grow.hpp"
#include "core/marked_points.hpp"
#include "core/reach.hpp"
#include "core/returns_near.hpp"

namespace raywatch {
namespace {

template <class Predicate>
std::vector<std::uint32_t> places_of(const Answers& answers, Predicate predicate) {
  std::vector<std::uint32_t> places;
  for (std::uint32_t i = 0; i < answers.size(); ++i) {
    if (predicate(answers[i])) places.push_back(i);
  }
  return places;
}

/// What was found of one prior so far.
struct PriorState {
  Answers answers;  ///< of the scan; only where evidence is weighed
  std::vector<Candidate> candidates;
  std::vector<ClassedPoint> seeds;
  std::vector<std::uint32_t> sources;  ///< of the prior's returns; only if anything grows
  std::vector<ClassedPoint> grown;     ///< from the seeds
  std::optional<MarkedPoints> is_grown;
};

class PriorSearch {
 public:
  PriorSearch(const ScanView& scan, std::span<const ScanView> priors, const Asking& asking)
      : scan_(scan), priors_(priors), asking_(asking), parameters_(asking.parameters()), states_(priors.size()) {
    for (const ScanView& prior : priors) epochs_.push_back(epoch_of(prior, scan, parameters_.contemporary_tolerance));
  }

  PriorChanges run() {
    PriorChanges changes;
    for (std::uint32_t p = 0; p < priors_.size(); ++p) examine(p);
    if (asking_.grows()) judge();
    if (any_seeds()) {
      for (std::uint32_t p = 0; p < priors_.size(); ++p) grow_over(p);
    }
    for (std::uint32_t p = 0; p < priors_.size(); ++p) add(p, changed_points(p), changes);
    return changes;
  }

 private:
  void examine(std::uint32_t p) {
    const std::vector<std::uint32_t> free = free_points(p);
    const bool is_union = parameters_.grouping == Grouping::union_;
    const std::vector<std::uint8_t> refuted =
        is_union ? std::vector<std::uint8_t>(free.size(), 0) : refuted_at(p, free);
    for (std::size_t k = 0; k < free.size(); ++k) {
      states_[p].candidates.push_back({free[k], class_of_prior_point(epochs_[p]), refuted[k] != 0});
    }
  }

  /// The points of prior `p` that are free in the scan. Only where evidence is weighed do other answers matter.
  std::vector<std::uint32_t> free_points(std::uint32_t p) {
    const ScanView& prior = priors_[p];
    const std::vector<std::uint8_t> valid = valid_points(prior);
    if (!asking_.weighs()) return asking_.find_free(scan_, prior, valid);
    Answers& answers = states_[p].answers;
    answers = asking_.ask_all(scan_, prior, valid);
    asking_.look_closely(scan_, prior, places_of(answers, is_undecided), answers);
    return places_of(answers, [](Answer answer) { return answer == Answer::free; });
  }

  /// All priors together, as one may confirm what another shows.
  void judge() {
    const bool is_one_of_several = priors_.size() > 1;
    std::vector<std::vector<JudgedCluster>> clusters;
    for (std::size_t p = 0; p < priors_.size(); ++p) {
      clusters.push_back(
          judge_clusters(priors_[p], states_[p].candidates, {&scan_, 1}, is_one_of_several, parameters_));
    }
    std::vector<std::vector<ClassedPoint>> seeds = find_seeds(clusters, parameters_);
    for (std::size_t p = 0; p < priors_.size(); ++p) states_[p].seeds = std::move(seeds[p]);
  }

  bool any_seeds() const {
    return std::any_of(states_.begin(), states_.end(), [](const PriorState& state) { return !state.seeds.empty(); });
  }

  IsOpen is_open_in(std::uint32_t p) {
    return [this, p](std::span<const std::uint32_t> places) { return open_at(p, places); };
  }

  void grow_over(std::uint32_t p) {
    const ScanView& prior = priors_[p];
    PriorState& state = states_[p];
    state.sources = sources_of(prior.index.impl(), prior.points);
    state.grown = grow(prior, state.sources, state.seeds, state.candidates, parameters_, is_open_in(p));
    state.is_grown.emplace(prior, state.sources);
    for (const ClassedPoint& point : state.grown) state.is_grown->mark(point.index);
  }

  std::vector<std::uint32_t> changed_points(std::uint32_t p) {
    std::vector<std::uint32_t> changed;
    if (!asking_.grows()) {
      for (const Candidate& candidate : states_[p].candidates) {
        if (!candidate.contradicted) changed.push_back(candidate.index);
      }
    } else if (any_seeds()) {
      for (const ClassedPoint& point : states_[p].grown) changed.push_back(point.index);
      const std::vector<std::uint32_t> shown = shown_by_others(p);
      changed.insert(changed.end(), shown.begin(), shown.end());
      std::sort(changed.begin(), changed.end());
    }
    return changed;
  }

  /// Several priors' returns of one thing are one change: what lies beside changed points of another prior, nearer than
  /// to any other point of that, and may belong to them, changed too, though the scan cannot see well where it was.
  std::vector<std::uint32_t> shown_by_others(std::uint32_t p) {
    std::vector<std::uint8_t> beside(priors_[p].points.size(), 0);
    for (std::uint32_t q = 0; q < priors_.size(); ++q) {
      if (q != p && class_of_prior_point(epochs_[q]) == class_of_prior_point(epochs_[p])) mark_beside(q, p, beside);
    }
    std::vector<std::uint32_t> places;
    for (std::uint32_t i = 0; i < beside.size(); ++i) {
      if (beside[i]) places.push_back(i);
    }
    const std::vector<std::uint8_t> open = open_at(p, places);
    std::vector<std::uint32_t> shown;
    for (std::size_t k = 0; k < places.size(); ++k) {
      if (open[k]) shown.push_back(places[k]);
    }
    return shown;
  }

  /// Marks the points of prior `p` that have not changed yet, lie within reach of a changed point of prior `q`, and
  /// nearer to it than to any other point of that.
  void mark_beside(std::uint32_t q, std::uint32_t p, std::vector<std::uint8_t>& beside) const {
    const PriorState& state = states_[p];
    const PriorIndex::Impl& index = priors_[p].index.impl();
    const Pose p_from_q = priors_[p].world_from_sensor.inverse() * priors_[q].world_from_sensor;
    constexpr double kFar_m = std::numeric_limits<double>::infinity();
    std::vector<double> distance_m(beside.size(), kFar_m);  // of the points of p from the nearest changed one of q
    std::vector<std::uint32_t> places;
    for (const ClassedPoint& changed : states_[q].grown) {
      const Eigen::Vector3d changed_m = p_from_q * priors_[q].points[changed.index].cast<double>();
      const auto offer = [&](std::uint32_t i) {
        const std::uint32_t place = state.sources[i];
        if ((*state.is_grown)[place]) return;
        if (distance_m[place] == kFar_m) places.push_back(place);
        distance_m[place] = std::min(distance_m[place], (point_of(index.returns[i]) - changed_m).norm());
      };
      for_each_return_around(index, changed_m, reach_m(priors_[p], changed_m.cast<float>(), parameters_), offer,
                             *state.is_grown);
    }
    const Pose q_from_p = p_from_q.inverse();
    tbb::parallel_for(std::size_t{0}, places.size(), [&](std::size_t k) {
      const Eigen::Vector3d place_m = q_from_p * priors_[p].points[places[k]].cast<double>();
      if (!is_nearer_to_another(q, place_m, distance_m[places[k]])) beside[places[k]] = 1;
    });
  }

  bool is_nearer_to_another(std::uint32_t q, const Eigen::Vector3d& place_m, double distance_m) const {
    const PriorState& state = states_[q];
    bool near = false;
    const auto look_at = [&](std::uint32_t i) {
      near |= !(*state.is_grown)[state.sources[i]];
      return !near;
    };
    for_each_return_around(priors_[q].index.impl(), place_m, distance_m, look_at, *state.is_grown);
    return near;
  }

  /// Points of prior `p` that neither the scan nor another prior shows to have stayed.
  std::vector<std::uint8_t> open_at(std::uint32_t p, std::span<const std::uint32_t> places) {
    Answers& answers = states_[p].answers;
    asking_.look_closely(scan_, priors_[p], places, answers);
    const std::vector<std::uint8_t> refuted = refuted_at(p, places);
    std::vector<std::uint8_t> open(places.size());
    for (std::size_t k = 0; k < places.size(); ++k) {
      open[k] = answers[places[k]] != Answer::supported && !refuted[k];
    }
    return open;
  }

  /// A prior that is newer than `p` and can test the point decides: if it saw the place free, or if one of the scan's
  /// time supports the point, then nothing was removed since.
  std::vector<std::uint8_t> refuted_at(std::uint32_t p, std::span<const std::uint32_t> places) const {
    std::vector<std::uint8_t> refuted(places.size(), 0);
    for (std::size_t q = 0; q < priors_.size(); ++q) {
      const bool newer = between(priors_[p].captured_at, priors_[q].captured_at) > parameters_.contemporary_tolerance;
      const bool same_time_as_scan = epochs_[q] == Epoch::contemporary;
      if (q == p || !(newer || same_time_as_scan)) continue;
      const Answers answers = asking_.ask_at(priors_[q], priors_[p], places);
      for (std::size_t k = 0; k < places.size(); ++k) {
        refuted[k] |= same_time_as_scan ? answers[k] == Answer::supported : answers[k] == Answer::free;
      }
    }
    return refuted;
  }

  void add(std::uint32_t p, std::span<const std::uint32_t> changed, PriorChanges& changes) const {
    std::vector<PriorPointVotes> votes(changed.size());
    for (std::size_t q = 0; q < priors_.size(); ++q) {
      if (q == p || changed.empty()) continue;
      const Answers answers = asking_.ask_at(priors_[q], priors_[p], changed);
      for (std::size_t k = 0; k < changed.size(); ++k) {
        votes[k].free = static_cast<std::uint8_t>(votes[k].free + (answers[k] == Answer::free));
        votes[k].supported = static_cast<std::uint8_t>(votes[k].supported + (answers[k] == Answer::supported));
      }
    }
    for (std::size_t k = 0; k < changed.size(); ++k) {
      changes.points.push_back({.prior = p, .index = changed[k], .point_class = class_of_prior_point(epochs_[p])});
      changes.votes.push_back(votes[k]);
    }
  }

  const ScanView& scan_;
  std::span<const ScanView> priors_;
  const Asking& asking_;
  const CompareParameters& parameters_;
  std::vector<Epoch> epochs_;
  std::vector<PriorState> states_;
};

}  // namespace

PriorChanges find_prior_changes(const ScanView& scan, std::span<const ScanView> priors, const Asking& asking) {
  return PriorSearch(scan, priors, asking).run();
}

}  // namespace raywatch
