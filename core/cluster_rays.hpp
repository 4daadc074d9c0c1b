#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <span>

#include "core/compare.hpp"
#include "core/plane_patch.hpp"
#include "core/prior_index_impl.hpp"

namespace raywatch {

/// Tells which rays of one scan cross the surface that another shows around its points. A ray that ends well behind a
/// point, but on the same side of its surface, has only passed it: flat ground, met from afar at grazing incidence.
class Crossing {
 public:
  /// @param margin_m how far behind the surface a ray must end at least
  Crossing(const ScanView& view, const ScanView& asked, double margin_m);

  // Points and rays, which are given by their ends, are in the frame of `asked`.

  /// The surface that the view shows at one of its points, if it shows one.
  std::optional<PlanePatch> surface_at(const Eigen::Vector3d& point_m) const;
  /// Whether a ray of `asked` that passed the point crossed the surface there; without a surface every ray did.
  bool crosses(const std::optional<PlanePatch>& surface, const Eigen::Vector3d& point_m,
               const Eigen::Vector3d& end_m) const;
  /// Whether any of several rays crossed the surface at a point.
  bool any_of(const Eigen::Vector3d& point_m, std::span<const Eigen::Vector3d> ends_m) const;

 private:
  PatchFitter fit_;
  Pose view_from_asked_;
  double margin_m_;
};

/// An index of the members of a cluster alone, in the frame of `asked`.
PriorIndex index_of(const ScanView& view, std::span<const std::uint32_t> members, const ScanView& asked);

/// Members of a cluster around which rays are looked for, at most.
inline constexpr std::size_t kMostClusterMembers = 500;

/// Which rays go through a cluster: its members within the angle surround the ray, and it ends behind all of them.
struct RaySearch {
  double angle_rad;
  double margin_m;                                               ///< how far behind them at least
  std::size_t enough = std::numeric_limits<std::size_t>::max();  ///< more are not counted
};

/// Counts the rays that go through a cluster; when `crossing` is given, only those that cross the surface of which its
/// members are points. Both indexes are in the frame of the rays' scan.
std::size_t count_rays(const PriorIndex::Impl& cluster, const PriorIndex::Impl& rays, const RaySearch& search,
                       const Crossing* crossing);

}  // namespace raywatch
