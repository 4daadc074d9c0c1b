#include "core/prior_groups.hpp"

#include <algorithm>

namespace raywatch {
namespace {

/// Which group speaks about a place.
class Speakers {
 public:
  explicit Speakers(std::span<const PriorGroup> groups) : groups_(groups) {
    for (std::size_t g = 0; g < groups.size(); ++g) {
      if (!groups[g].region_m) everywhere_ = g;
    }
  }

  std::size_t of(const Eigen::Vector3d& place_m) const {
    for (std::size_t g = groups_.size(); g-- > 0;) {
      if (groups_[g].region_m && groups_[g].region_m->contains(place_m)) return g;
    }
    return everywhere_;
  }

 private:
  std::span<const PriorGroup> groups_;
  std::size_t everywhere_ = 0;
};

void take_answers(const Detection& part, std::span<const std::size_t> speaker, std::size_t group, Detection& merged) {
  for (std::size_t i = 0; i < speaker.size(); ++i) {
    if (speaker[i] != group) continue;
    merged.classes[i] = part.classes[i];
    merged.free[i] = part.free[i];
    merged.supported[i] = part.supported[i];
  }
  for (const std::vector<Answer>& of_prior : part.answers) {
    std::vector<Answer>& kept = merged.answers.emplace_back(of_prior.size(), Answer::unseen);
    for (std::size_t i = 0; i < speaker.size(); ++i) {
      if (speaker[i] == group) kept[i] = of_prior[i];
    }
  }
}

void take_prior_points(const Detection& part, const PriorGroup& group, std::size_t number, const Speakers& speakers,
                       std::uint32_t first_prior, Detection& merged) {
  for (std::size_t k = 0; k < part.prior_points.size(); ++k) {
    PriorPoint point = part.prior_points[k];
    const ScanView& prior = group.priors[point.prior];
    if (speakers.of(prior.world_from_sensor * prior.points[point.index].cast<double>()) != number) continue;
    point.prior += first_prior;
    merged.prior_points.push_back(point);
    merged.prior_votes.push_back(part.prior_votes[k]);
  }
}

/// Takes out what a prior saw that shows what is normal only together with the others, and another one saw free.
void drop_never_normal(const PriorGroup& group, Detection& detection) {
  if (group.normal_together.empty()) return;
  std::size_t kept = 0;
  for (std::size_t k = 0; k < detection.prior_points.size(); ++k) {
    const bool others_saw_it_free = detection.prior_votes[k].free > 1;  // the compared scan is one of them
    if (others_saw_it_free && group.normal_together[detection.prior_points[k].prior]) continue;
    detection.prior_points[kept] = detection.prior_points[k];
    detection.prior_votes[kept++] = detection.prior_votes[k];
  }
  detection.prior_points.resize(kept);
  detection.prior_votes.resize(kept);
}

Detection detect_in(const ScanView& scan, const PriorGroup& group, const CompareParameters& parameters) {
  Detection detection = detect(scan, group.priors, parameters);
  drop_never_normal(group, detection);
  return detection;
}

double testable_share(const Detection& detection) {
  std::size_t valid = 0, testable = 0;
  for (std::size_t i = 0; i < detection.classes.size(); ++i) {
    valid += detection.classes[i] != PointClass::invalid;
    testable += (detection.free[i] | detection.supported[i]) != 0;
  }
  return valid == 0 ? 0.0 : static_cast<double>(testable) / static_cast<double>(valid);
}

}  // namespace

std::vector<ScanView> all_priors(std::span<const PriorGroup> groups) {
  std::vector<ScanView> priors;
  for (const PriorGroup& group : groups) {
    for (const ScanView& prior : group.priors) priors.push_back(prior);
  }
  return priors;
}

Detection detect_in_regions(const ScanView& scan, std::span<const PriorGroup> groups,
                            const CompareParameters& parameters) {
  if (groups.empty()) return detect(scan, {}, parameters);
  if (groups.size() == 1 && !groups.front().region_m) return detect_in(scan, groups.front(), parameters);
  const Speakers speakers(groups);
  std::vector<std::size_t> speaker(scan.points.size());
  for (std::size_t i = 0; i < speaker.size(); ++i) {
    speaker[i] = speakers.of(scan.world_from_sensor * scan.points[i].cast<double>());
  }
  Detection merged;
  merged.classes.assign(speaker.size(), PointClass::unseen);
  merged.free.assign(speaker.size(), 0);
  merged.supported.assign(speaker.size(), 0);
  std::uint32_t first_prior = 0;
  for (std::size_t g = 0; g < groups.size(); ++g) {
    const Detection part = detect_in(scan, groups[g], parameters);
    take_answers(part, speaker, g, merged);
    take_prior_points(part, groups[g], g, speakers, first_prior, merged);
    merged.angle_rad.insert(merged.angle_rad.end(), part.angle_rad.begin(), part.angle_rad.end());
    merged.warnings.insert(merged.warnings.end(), part.warnings.begin(), part.warnings.end());
    first_prior += static_cast<std::uint32_t>(groups[g].priors.size());
  }
  merged.testable = testable_share(merged);
  return merged;
}

}  // namespace raywatch
