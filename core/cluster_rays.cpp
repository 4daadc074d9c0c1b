#include "core/cluster_rays.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <unordered_map>
#include <utility>
#include <vector>

#include "core/returns_near.hpp"

namespace raywatch {

Crossing::Crossing(const ScanView& view, const ScanView& asked, double margin_m)
    : fit_(view), view_from_asked_(view.world_from_sensor.inverse() * asked.world_from_sensor), margin_m_(margin_m) {}

bool Crossing::any_of(const Eigen::Vector3d& point_m, std::span<const Eigen::Vector3d> ends_m) const {
  const std::optional<PlanePatch> surface = surface_at(point_m);
  return std::any_of(ends_m.begin(), ends_m.end(),
                     [&](const Eigen::Vector3d& end_m) { return crosses(surface, point_m, end_m); });
}

std::optional<PlanePatch> Crossing::surface_at(const Eigen::Vector3d& point_m) const {
  return fit_(view_from_asked_ * point_m);
}

bool Crossing::crosses(const std::optional<PlanePatch>& surface, const Eigen::Vector3d& point_m,
                       const Eigen::Vector3d& end_m) const {
  if (!surface) return true;
  constexpr double kSurely = 2.0;  // standard deviations of the normal
  const double from_m = surface->distance_before_m(view_from_asked_.position_m);
  const double to_m = surface->distance_before_m(view_from_asked_ * end_m);
  const double least_m = margin_m_ + kSurely * surface->normal_sigma_rad * (end_m - point_m).norm();
  return (from_m > 0.0) != (to_m > 0.0) && std::abs(to_m) >= least_m;
}

PriorIndex index_of(const ScanView& view, std::span<const std::uint32_t> members, const ScanView& asked) {
  const Pose asked_from_view = asked.world_from_sensor.inverse() * view.world_from_sensor;
  PointCloud cluster;
  cluster.reserve(members.size());
  for (const std::uint32_t i : members) {
    const Eigen::Vector3f p = (asked_from_view * view.points[i].cast<double>()).cast<float>();
    cluster.push_back(p.x(), p.y(), p.z());
  }
  return PriorIndex::build(cluster, {});
}

namespace {

/// The members of a cluster around one ray.
class Surround {
 public:
  Surround(const Eigen::Vector3d& end_m, double angle_rad)
      : end_m_(end_m),
        eastward_(end_m.cross(Eigen::Vector3d::UnitZ())),
        northward_(eastward_.cross(end_m)),
        range_m_(end_m.norm()),
        cosine_m_(std::cos(angle_rad) * range_m_) {}

  void add(std::uint32_t i, const Eigen::Vector3d& member_m) {
    const double member_range_m = member_m.norm(), along_m2 = end_m_.dot(member_m);
    if (along_m2 < cosine_m_ * member_range_m) return;
    is_near_some_ |= i < kMostClusterMembers;
    farthest_m_ = std::max(farthest_m_, member_range_m);
    if (along_m2 > greatest_along_m_ * member_range_m) {
      greatest_along_m_ = along_m2 / member_range_m;
      nearest_ = i;
    }
    const double a = eastward_.dot(member_m), e = northward_.dot(member_m);
    west_ |= a <= 0.0;
    east_ |= a >= 0.0;
    south_ |= e <= 0.0;
    north_ |= e >= 0.0;
  }

  /// Whether there are members on all sides, one of those that are looked at among them, and the ray ends well behind
  /// all of them.
  bool lets_through(double margin_m) const {
    return is_near_some_ && west_ && east_ && south_ && north_ && range_m_ >= farthest_m_ + margin_m;
  }

  std::uint32_t nearest() const { return nearest_; }  ///< the member with the smallest angle to the ray

 private:
  Eigen::Vector3d end_m_, eastward_, northward_;
  double range_m_, cosine_m_;
  double greatest_along_m_ = -1.0, farthest_m_ = 0.0;
  std::uint32_t nearest_ = 0;
  bool is_near_some_ = false;
  bool west_ = false, east_ = false, south_ = false, north_ = false;
};

/// Counts the rays of one scan through one cluster.
class RayCounter {
 public:
  RayCounter(const PriorIndex::Impl& cluster, const PriorIndex::Impl& rays, const RaySearch& search,
             const Crossing* crossing)
      : cluster_(cluster), rays_(rays), search_(search), crossing_(crossing) {}

  std::size_t operator()() {
    std::size_t through = 0;
    for (const Stretch& near : rays_near()) {
      for (std::uint32_t ray = near.first; ray < near.end; ++ray) {
        if (goes_through(point_of(rays_.returns[ray])) && ++through == search_.enough) return through;
      }
    }
    return through;
  }

 private:
  /// Neighbouring rays first..end - 1.
  struct Stretch {
    std::uint32_t first = 0, end = 0;

    bool meets(const Stretch& other) const { return first <= other.end && other.first <= end; }
    void join(const Stretch& other) {
      first = std::min(first, other.first);
      end = std::max(end, other.end);
    }
  };

  /// All rays that end in the directions of members, and some beside them, in order. Members are sorted by direction,
  /// so that the part of a large cluster that is looked at is a band of it, without holes, and what one member adds to
  /// a row mostly continues what the one before it did.
  std::vector<Stretch> rays_near() const {
    std::vector<Stretch> all, latest;
    const Cone cone(std::min(search_.angle_rad, std::numbers::pi / 2));
    for (std::size_t k = 0; k < std::min(kMostClusterMembers, cluster_.returns.size()); ++k) {
      std::size_t row = 0;
      cone.for_each_stretch(rays_.grid, direction_of(cluster_.returns[k]), [&](std::uint32_t first, std::uint32_t end) {
        const Stretch rays{rays_.first[first], rays_.first[end]};
        if (row == latest.size()) latest.push_back(rays);
        if (latest[row].meets(rays)) {
          latest[row].join(rays);
        } else {
          all.push_back(std::exchange(latest[row], rays));
        }
        ++row;
        return true;
      });
    }
    all.insert(all.end(), latest.begin(), latest.end());
    return joined(std::move(all));
  }

  static std::vector<Stretch> joined(std::vector<Stretch> stretches) {
    std::sort(stretches.begin(), stretches.end(), [](const Stretch& a, const Stretch& b) { return a.first < b.first; });
    std::vector<Stretch> result;
    for (const Stretch& next : stretches) {
      if (result.empty() || !result.back().meets(next)) {
        result.push_back(next);
      } else {
        result.back().join(next);
      }
    }
    return result;
  }

  bool goes_through(const Eigen::Vector3d& end_m) {
    Surround surround(end_m, search_.angle_rad);
    for_each_return_near(cluster_, end_m, search_.angle_rad,
                         [&](std::uint32_t i) { surround.add(i, point_of(cluster_.returns[i])); });
    if (!surround.lets_through(search_.margin_m)) return false;
    if (crossing_ == nullptr) return true;
    const Eigen::Vector3d member_m = point_of(cluster_.returns[surround.nearest()]);
    const auto [known, is_new] = surfaces_.try_emplace(surround.nearest());
    if (is_new) known->second = crossing_->surface_at(member_m);
    return crossing_->crosses(known->second, member_m, end_m);
  }

  const PriorIndex::Impl& cluster_;
  const PriorIndex::Impl& rays_;
  RaySearch search_;
  const Crossing* crossing_;
  std::unordered_map<std::uint32_t, std::optional<PlanePatch>>
      surfaces_;  ///< at members, as far as they were asked for
};

}  // namespace

std::size_t count_rays(const PriorIndex::Impl& cluster, const PriorIndex::Impl& rays, const RaySearch& search,
                       const Crossing* crossing) {
  return RayCounter(cluster, rays, search, crossing)();
}

}  // namespace raywatch
