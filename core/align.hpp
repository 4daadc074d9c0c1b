#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/compare.hpp"
#include "core/pose.hpp"

namespace raywatch {

/// What came of fitting a scan onto others. The names are stored: see `to_string`.
enum class RegistrationState : std::uint8_t {
  none,   ///< nothing to align with, or too little in common; the pose is used as reported
  good,   ///< fitted; the correction is within what a reported pose may be off
  moved,  ///< fitted, but the correction is larger: of a fixed sensor it says that it was moved or has tilted
  bad,    ///< there is no fit: what the scans show contradicts each other, or the correction has no end
};
std::string_view to_string(RegistrationState state);
/// @throws InvalidInput naming the known ones.
RegistrationState parse_registration_state(std::string_view name);

struct AlignParameters {
  /// One standard deviation of a reported pose: a direction that the scene does not fix stays as uncertain as this.
  PoseUncertainty reported{.position_m = 0.02, .angle_rad = 0.0015};
  /// A correction beyond this is more than an error of a pose. The distance between the sensors adds what a reference
  /// turned by this angle swings a scan around it.
  PoseUncertainty tolerance{.position_m = 0.15, .angle_rad = 0.009};
  /// Surfaces farther apart than this are not taken for the same one.
  double search_m = 0.5;
  /// Surfaces nearer than this agree, however little noise there is.
  double agree_m = 0.03;
  /// A fit is bad when, in some direction of motion that the scene fixes, a smaller share of the evidence agrees.
  double least_agreement = 0.5;
  /// The same for a correction beyond the tolerance, which a wrong fit is more likely to ask for than a right one.
  double least_agreement_moved = 0.8;
  /// Fewer pieces of surface that both scans show, or a smaller share of the sample, are too little in common.
  std::size_t least_matches = 60;
  double least_overlap = 0.02;
  std::size_t sample = 2500;  ///< pieces of surface that the scan is represented by
};

/// How the pose of a scan was refined. The names of frames: world_from_sensor = correction * reported.
struct Alignment {
  RegistrationState state = RegistrationState::none;
  Pose correction;                  ///< identity when there is none, or when it is bad
  double residual_m = 0.0;          ///< root mean square of the distances between surfaces that agree
  double inliers = 0.0;             ///< share of the scan's pieces of surface, where seen by a reference, that agree
  double agreement = 0.0;           ///< the same, of the evidence in the direction of motion where it is least
  std::size_t matches = 0;          ///< pieces of surface that agree
  std::size_t free_directions = 0;  ///< of the six directions of motion, those that the scene does not fix
  PoseUncertainty uncertainty;      ///< of the corrected pose relative to the references; wide when the fit is bad
};

/// Whether a comparison refines poses: the published method takes them as they are.
inline bool refines_poses(const CompareParameters& parameters) {
  return parameters.align && parameters.grouping == Grouping::consensus;
}

/// How far a correction moves a sensor, and by what angle it turns it.
PoseUncertainty size_of(const Pose& correction, const Pose& reported);

/// Finds the small rigid motion that fits the scan onto the references, whose poses are taken as they are.
///
/// Point-to-plane ICP: flat pieces of surface, chosen so that their normals are as different as the scene allows, look
/// for their counterparts along the rays of each reference (Blais and Levine 1995), so that no search tree is needed.
/// What changed, was hidden or is not flat falls out by Tukey's weights. Directions of motion that the scene does not
/// fix (a bare plane, a corridor) are left as reported: solution remapping after Zhang, Kaess and Singh, "On degeneracy
/// of optimization-based state estimation problems", ICRA 2016.
///
/// Deterministic: the same arguments give the same bytes at any number of threads. Runs in the caller's oneTBB arena.
Alignment align(const ScanView& scan, std::span<const ScanView> references, const AlignParameters& parameters);

/// The same motion in coordinates to which `origin_m` is added.
Pose with_origin(const Pose& correction, const Eigen::Vector3d& origin_m);

/// The priors of a comparison after each was aligned with the scan.
struct AlignedPriors {
  std::vector<Alignment> alignments;  ///< one a prior
  std::vector<ScanView> usable;       ///< at their corrected poses, without those that fit badly while others fit
  std::vector<std::uint32_t> places;  ///< of the usable ones, in the list of all
  std::vector<std::string> warnings;  ///< of priors that were left out or stand far from where they were said to
};

/// Aligns each prior with the scan, whose pose stays as it is. If none fits, all are taken at their poses as reported,
/// and `warnings` says so.
AlignedPriors align_priors(const ScanView& scan, std::span<const ScanView> priors, const AlignParameters& parameters);

/// Turns a comparison with the usable priors into one that speaks of all of them, in their order, and has the warnings.
void restore_places(const AlignedPriors& aligned, Comparison& comparison);

}  // namespace raywatch
