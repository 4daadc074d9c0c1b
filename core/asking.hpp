#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/compare.hpp"

namespace raywatch {

using Answers = std::vector<Answer>;  ///< one a point

/// T_a when it is not given: wide enough to have neighbours on every side of a direction, also where the spacing of the
/// shots varies. 1 degree when nothing is known of a sensor's resolution.
double default_angle_rad(const SensorModel& sensor);

/// How the scans of a comparison are asked about each other's points.
class Asking {
 public:
  /// Keeps a reference to the parameters.
  explicit Asking(const CompareParameters& parameters) : parameters_(parameters) {}

  /// Whether evidence is weighed: in a consensus, unless that is switched off.
  bool weighs() const;
  /// Whether changes grow from what is sure.
  bool grows() const { return weighs() && parameters_.clustering; }
  const CompareParameters& parameters() const { return parameters_; }

  /// T_a as used for a scan that is asked: as given, or by the spacing of its shots.
  double angle_rad(const ScanView& asked) const;

  /// What `asked` answers about all points of `view`; about those that are not valid: unseen.
  Answers ask_all(const ScanView& asked, const ScanView& view, std::span<const std::uint8_t> valid) const;
  /// The places of those points that it answers free about: the same, faster, where no other answer matters.
  std::vector<std::uint32_t> find_free(const ScanView& asked, const ScanView& view,
                                       std::span<const std::uint8_t> valid) const;
  /// What it answers about some, weighed.
  Answers ask_at(const ScanView& asked, const ScanView& view, std::span<const std::uint32_t> places) const;
  /// Looks more closely at what `asked` answered about some points of `view`. Nothing when evidence is not weighed.
  void look_closely(const ScanView& asked, const ScanView& view, std::span<const std::uint32_t> places,
                    Answers& answers) const;

  /// Says so when the T_a that was given is too narrow for the shots of a scan.
  void warn_of_coarse_rings(const ScanView& asked, const std::string& name, std::vector<std::string>& warnings) const;

 private:
  Thresholds thresholds(const ScanView& asked) const { return {angle_rad(asked), parameters_.range_m}; }
  /// For `weigh`: a surface needs neighbours on every side. Farther ones, which a wide T_a would add, only make it less
  /// flat.
  Thresholds surface_thresholds(const ScanView& asked) const;

  const CompareParameters& parameters_;
};

/// One a point: 1 for those that the scan's index holds.
std::vector<std::uint8_t> valid_points(const ScanView& view);

PointCloud points_at(const PointCloud& points, std::span<const std::uint32_t> places);

/// True for the answers that a closer look may change.
inline bool is_undecided(Answer answer) { return answer == Answer::free || answer == Answer::ambiguous; }

}  // namespace raywatch
