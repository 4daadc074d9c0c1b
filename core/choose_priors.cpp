#include "core/choose_priors.hpp"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cstdio>

namespace raywatch {
namespace {

std::string percent(double share) {
  char text[16];
  std::snprintf(text, sizeof text, "%.1f %%", 100.0 * share);
  return text;
}

using Cover = std::vector<std::uint8_t>;  // one a sample point: inside the coverage or not

double share(std::size_t count, std::size_t total) {
  return total == 0 ? 0.0 : static_cast<double>(count) / static_cast<double>(total);
}

/// What a candidate adds: points not covered yet in full, points that are covered already at the repetition's weight.
struct Gain {
  double fresh = 0.0;
  double worth = 0.0;
};

Gain gain_of(const Cover& cover, const std::vector<std::uint8_t>& times_covered, double repeat_weight) {
  std::size_t fresh = 0;
  double repeated = 0.0;
  for (std::size_t i = 0; i < cover.size(); ++i) {
    if (!cover[i]) continue;
    if (times_covered[i] == 0) {
      ++fresh;
    } else {
      repeated += repeat_weight / times_covered[i];
    }
  }
  const double fresh_share = share(fresh, cover.size());
  return {fresh_share, fresh_share + (cover.empty() ? 0.0 : repeated / static_cast<double>(cover.size()))};
}

}  // namespace

std::vector<Eigen::Vector3d> sample_world_points(const PointCloud& points, const Pose& world_from_sensor,
                                                 const UsableRange& usable, std::size_t count) {
  const std::size_t taken = std::min(count, points.size());
  std::vector<Eigen::Vector3d> sample_m;
  sample_m.reserve(taken);
  for (std::size_t k = 0; k < taken; ++k) {
    // The first usable point of each of as many equal parts of the scan.
    const std::size_t end = (k + 1) * points.size() / taken;
    for (std::size_t i = k * points.size() / taken; i < end; ++i) {
      const Eigen::Vector3d point_m = points[i].cast<double>();
      if (!is_usable(point_m.norm(), usable)) continue;
      sample_m.push_back(world_from_sensor * point_m);
      break;
    }
  }
  return sample_m;
}

std::vector<CandidateAssessment> choose_priors(std::span<const Eigen::Vector3d> sample_m, const Pose& world_from_sensor,
                                               Time captured_at, std::span<const PriorCandidate> candidates,
                                               const ChoiceParameters& parameters) {
  std::vector<CandidateAssessment> assessments(candidates.size());
  std::vector<Cover> covers(candidates.size());
  tbb::parallel_for(std::size_t{0}, candidates.size(), [&](std::size_t c) {
    covers[c] = covered(*candidates[c].coverage, candidates[c].world_from_sensor.inverse(), sample_m);
  });
  for (std::size_t c = 0; c < candidates.size(); ++c) {
    CandidateAssessment& assessment = assessments[c];
    assessment.distance_m = (candidates[c].world_from_sensor.position_m - world_from_sensor.position_m).norm();
    assessment.age = between(candidates[c].captured_at, captured_at);
    assessment.overlap =
        share(static_cast<std::size_t>(std::count(covers[c].begin(), covers[c].end(), 1)), sample_m.size());
    if (!candidates[c].refused.empty()) {
      assessment.reason = candidates[c].refused;
    } else if (assessment.overlap < parameters.min_overlap) {
      assessment.reason = "too little overlap: " + percent(assessment.overlap) + " of the scan's points, " +
                          percent(parameters.min_overlap) + " needed";
    }
  }

  std::vector<std::uint8_t> times_covered(sample_m.size(), 0);
  const auto take = [&](std::size_t c, const Gain& gain, std::string reason) {
    assessments[c].chosen = true;
    assessments[c].gain = gain.fresh;
    assessments[c].reason = std::move(reason);
    for (std::size_t i = 0; i < times_covered.size(); ++i) {
      if (covers[c][i] && times_covered[i] < 255) ++times_covered[i];
    }
  };

  for (std::size_t c = 0; c < candidates.size(); ++c) {
    if (!candidates[c].required || !assessments[c].reason.empty()) continue;
    take(c, gain_of(covers[c], times_covered, parameters.repeat_weight), "asked for");
  }
  std::size_t chosen = 0;
  while (true) {
    std::size_t best = candidates.size();
    Gain best_gain;
    for (std::size_t c = 0; c < candidates.size(); ++c) {
      if (candidates[c].required || assessments[c].chosen || !assessments[c].reason.empty()) continue;
      const Gain gain = gain_of(covers[c], times_covered, parameters.repeat_weight);
      assessments[c].gain = gain.fresh;
      const bool better = best == candidates.size() || gain.worth > best_gain.worth ||
                          (gain.worth == best_gain.worth && candidates[c].captured_at > candidates[best].captured_at);
      if (better) {
        best = c;
        best_gain = gain;
      }
    }
    if (best == candidates.size() || chosen == parameters.max_priors) break;
    ++chosen;
    take(best, best_gain,
         chosen == 1 ? "overlaps most: " + percent(assessments[best].overlap)
                     : "adds " + percent(best_gain.fresh) + " to what is covered, overlaps " +
                           percent(assessments[best].overlap));
  }
  for (CandidateAssessment& assessment : assessments) {
    if (assessment.chosen || !assessment.reason.empty()) continue;
    assessment.reason = "the limit of " + std::to_string(parameters.max_priors) +
                        " priors was reached by scans that add more; this one would add " + percent(assessment.gain);
  }
  return assessments;
}

}  // namespace raywatch
