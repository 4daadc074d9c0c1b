#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/change.hpp"
#include "core/point_cloud.hpp"
#include "core/pose.hpp"
#include "core/prior_index.hpp"
#include "core/sensor.hpp"
#include "core/time.hpp"

namespace raywatch {

/// How the answers of several priors about one point become one class.
enum class Grouping : std::uint8_t {
  union_,     ///< the published grouping: changed if free in any prior; nothing else is weighed
  consensus,  ///< support by a prior speaks against a change; the newest prior that can test the point decides
};
std::string_view to_string(Grouping grouping);
/// @throws InvalidInput unless "union" or "consensus".
Grouping parse_grouping(std::string_view name);

/// The class of a point of the compared scan: the first that holds, in the order invalid; added, removed or
/// discrepancy; unchanged; occluded; unseen. The values are stored: never renumber.
enum class PointClass : std::uint8_t {
  unchanged = 0,    ///< supported by a prior, or changed but in no kept cluster
  added = 1,        ///< free in an earlier prior
  removed = 2,      ///< free in a later prior; of a prior's points: free in the compared scan
  discrepancy = 3,  ///< free in a contemporary prior
  occluded = 4,     ///< behind what a prior saw
  unseen = 5,       ///< no prior can tell
  invalid = 6,      ///< not a measurement of a surface: see `UsableRange`
};
inline constexpr std::size_t kPointClasses = 7;
std::string_view to_string(PointClass point_class);
/// @throws InvalidInput naming the known ones.
PointClass parse_point_class(std::string_view name);

/// What a comparison is made with. `core/profile.hpp` has the defaults of each kind of place.
struct CompareParameters {
  Grouping grouping = Grouping::consensus;
  /// T_a, the half-angle of the cone of prior returns that are asked about a point. Not given: it follows the angular
  /// resolution of each prior.
  std::optional<double> angle_rad;
  double range_m = 0.1;  ///< T_r
  /// In a consensus: how rough surfaces are. A point that is nearer than this to a surface of a prior is supported by
  /// it; what range noise and the errors of the poses explain is added. 0: answers are taken as they are, as in a
  /// union.
  double support_distance_m = 0.0;
  /// In a consensus, how far a change may grow from points that surely changed over those that no prior supports; at
  /// least to the neighbouring shots.
  double growth_distance_m = 0.0;
  /// In a consensus, how far around a cluster of free points a prior must be coherent: within it, leaves and grass
  /// sway. 0: not asked.
  double foliage_distance_m = 0.0;
  bool clustering = true;
  double cluster_distance_m = 0.10;     ///< d: points nearer than this belong together
  std::size_t cluster_min_points = 40;  ///< m: clusters of at most this many points are noise
  /// The range in which returns count. Applied when the indexes are built: see `usable_range`.
  double min_range_m = 0.0;
  double max_range_m = 1e9;
  Duration contemporary_tolerance = Duration::zero();
  /// In a consensus, poses are refined before anything is asked (core/align.hpp); else they are taken as reported.
  bool align = true;
};

/// One scan as it takes part in a comparison. Everything that is referred to must outlive the call.
struct ScanView {
  const PointCloud& points;
  const PriorIndex& index;  ///< of the same points
  Pose world_from_sensor;   ///< with the registration applied
  Time captured_at;
  SensorModel sensor;                     ///< as far as known or estimated
  PoseUncertainty pose_uncertainty = {};  ///< of `world_from_sensor`, as the registration left it
};

/// Which returns of a sensor take part in a comparison. `union` filters by the parameters alone; `consensus` also
/// respects what is known or estimated about the sensor. Indexes must be built with it.
UsableRange usable_range(const SensorModel& sensor, const CompareParameters& parameters);

/// A point of a prior that changed: it is free in the compared scan.
struct PriorPoint {
  std::uint32_t prior = 0;  ///< place in the list of priors
  std::uint32_t index = 0;  ///< place in that prior's points
  PointClass point_class = PointClass::removed;
  std::int32_t change = -1;  ///< place in `Comparison::changes`; -1: clustering is off
};

/// What one prior contributed.
struct PriorShare {
  std::size_t added = 0;    ///< points of the scan that changed and are free in this prior
  std::size_t removed = 0;  ///< points of this prior that changed
  double angle_rad = 0.0;   ///< T_a as used
};

/// How many priors say what about a changed point of a prior.
struct PriorPointVotes {
  std::uint8_t free = 1;  ///< the compared scan itself, and the other priors
  std::uint8_t supported = 0;
};

/// The result of asking, before points become changes: the classes hold for single points.
struct Detection {
  std::vector<PointClass> classes;           ///< one a point of the scan, in its order
  std::vector<std::uint8_t> free;            ///< number of priors that answer free, one a point
  std::vector<std::uint8_t> supported;       ///< number of priors that answer supported, one a point
  std::vector<std::vector<Answer>> answers;  ///< of each prior about each point of the scan
  std::vector<PriorPoint> prior_points;      ///< by prior, then index
  std::vector<PriorPointVotes> prior_votes;  ///< one a prior point
  std::vector<double> angle_rad;             ///< T_a as used, one a prior
  double testable = 0.0;
  std::vector<std::string> warnings;
};

/// The result of comparing one scan against its priors.
struct Comparison {
  std::vector<PointClass> classes;      ///< one a point of the scan, in its order
  std::vector<std::uint8_t> free;       ///< number of priors that answer free, one a point
  std::vector<std::uint8_t> supported;  ///< number of priors that answer supported, one a point
  std::vector<std::int32_t> change_of;  ///< place in `changes` or -1, one a point
  std::vector<PriorPoint>
      prior_points;             ///< by prior, then index; only those in kept clusters, unless clustering is off
  std::vector<Change> changes;  ///< by kind, then descending number of points, then centroid
  std::array<std::size_t, kPointClasses> counts{};  ///< of the scan's points, plus the changed ones of the priors
  double testable = 0.0;  ///< share of the scan's valid points that at least one prior answers with free or supported
  std::vector<PriorShare> priors;
  std::vector<std::string> warnings;
};

/// Asks both ways: the scan's points against the priors, the priors' points against the scan; and folds the answers.
/// @throws InvalidInput for a parameter out of its range or more than 255 priors.
Detection detect(const ScanView& scan, std::span<const ScanView> priors, const CompareParameters& parameters);

/// Clusters the changed points, drops what is noise, and describes what is left.
Comparison form_changes(const ScanView& scan, std::span<const ScanView> priors, const CompareParameters& parameters,
                        Detection detection);

/// Compares `scan` against `priors`: explicit change detection after Underwood, Gillsjo, Bailey and Vlaskine, "Explicit
/// 3D Change Detection using Ray-Tracing in Spherical Coordinates", ICRA 2013. `detect`, then `form_changes`.
///
/// Deterministic: the same arguments give the same bytes at any number of threads. Runs in the caller's oneTBB arena.
/// Without priors every valid point is unseen. All poses must be relative to an origin near the scans (float32 carries
/// the coordinates of changed points).
Comparison compare(const ScanView& scan, std::span<const ScanView> priors, const CompareParameters& parameters);

}  // namespace raywatch
