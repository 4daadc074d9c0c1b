#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/panorama.hpp"
#include "core/point_cloud.hpp"
#include "core/pose.hpp"
#include "core/time.hpp"

namespace raywatch {

/// An earlier scan that may serve as a prior.
struct PriorCandidate {
  Pose world_from_sensor;
  Time captured_at;
  std::shared_ptr<const Panorama> coverage;
  bool required = false;     ///< asked for by name (an explicit reference): chosen unless it overlaps nowhere
  std::string refused = {};  ///< why it must not be chosen; empty: it may be
};

/// What was found about a candidate.
struct CandidateAssessment {
  double distance_m = 0.0;  ///< between the sensors' positions
  Duration age{};           ///< of the candidate when the new scan was taken; negative when it is the later one
  double overlap = 0.0;     ///< share of the sample inside the candidate's coverage
  double gain = 0.0;        ///< share that it added to what was already covered, when it was its turn
  bool chosen = false;
  std::string reason;  ///< why it was chosen or not, in words
};

struct ChoiceParameters {
  std::size_t max_priors = 4;
  std::size_t sample_points = 2000;
  double min_overlap = 0.02;   ///< candidates that share less are of no use
  double repeat_weight = 0.1;  ///< worth of seeing a point again that one other prior covers; halved for two, and so on
};

/// Usable points of the scan in the world frame: the first of each of `count` equal parts of its order that has one.
std::vector<Eigen::Vector3d> sample_world_points(const PointCloud& points, const Pose& world_from_sensor,
                                                 const UsableRange& usable, std::size_t count);

/// Picks priors greedily, each for what it adds to the part of the sample that is already covered, so that different
/// vantage points are preferred over the same one twice. Ties go to the newer, then to the earlier in the list.
/// @returns one assessment a candidate, in the candidates' order.
std::vector<CandidateAssessment> choose_priors(std::span<const Eigen::Vector3d> sample_m, const Pose& world_from_sensor,
                                               Time captured_at, std::span<const PriorCandidate> candidates,
                                               const ChoiceParameters& parameters);

}  // namespace raywatch
