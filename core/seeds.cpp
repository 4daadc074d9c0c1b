#include "core/seeds.hpp"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <chrono>
#include <optional>
#include <tuple>

#include "core/cluster.hpp"
#include "core/cluster_plane.hpp"
#include "core/cluster_votes.hpp"
#include "core/glass.hpp"

namespace raywatch {
namespace {

/// A reach in multiples of the spacing of the shots: bridges a lost return, and surfaces seen aslant.
constexpr double kReachPerSpacing = 2.0;

std::vector<std::vector<Candidate>> clusters_of(const ScanView& view, std::span<const Candidate> candidates,
                                                PointClass point_class, const CompareParameters& parameters) {
  std::vector<Candidate> members;
  std::vector<Eigen::Vector3f> positions_m;
  std::vector<float> reaches_m;
  for (const Candidate& candidate : candidates) {
    if (candidate.point_class != point_class) continue;
    members.push_back(candidate);
    positions_m.push_back(view.points[candidate.index]);
    reaches_m.push_back(reach_m(view, positions_m.back(), parameters));
  }
  const std::vector<std::uint32_t> cluster_of = cluster_points(positions_m, reaches_m);
  std::vector<std::vector<Candidate>> clusters;
  for (std::size_t k = 0; k < members.size(); ++k) {
    if (cluster_of[k] == clusters.size()) clusters.emplace_back();
    clusters[cluster_of[k]].push_back(members[k]);
  }
  return clusters;
}

/// In an order that does not depend on that of the scan's points, as some of a large cluster stand for all of it.
void sort_by_place(const PointCloud& points, std::vector<std::uint32_t>& members) {
  const auto place = [&](std::uint32_t i) { return std::make_tuple(points.x_m[i], points.y_m[i], points.z_m[i]); };
  std::sort(members.begin(), members.end(), [&](std::uint32_t a, std::uint32_t b) { return place(a) < place(b); });
}

/// Judges the clusters of one scan.
class Judge {
 public:
  Judge(const ScanView& view, std::span<const ScanView> asked, const CompareParameters& parameters)
      : view_(view), asked_(asked), parameters_(parameters) {}

  bool is_sure(const std::vector<std::uint32_t>& cluster) const {
    constexpr std::size_t kLeastPoints = 5;
    if (cluster.size() < kLeastPoints) return false;
    std::optional<ClusterLook> look;  // needed of few clusters, whichever scan is asked
    return std::any_of(asked_.begin(), asked_.end(), [&](const ScanView& scan) {
      return is_changed(cluster, scan, look) && !is_contradicted(cluster, scan);
    });
  }

 private:
  /// Whether the rays of one scan say so.
  bool is_changed(const std::vector<std::uint32_t>& cluster, const ScanView& scan,
                  std::optional<ClusterLook>& look) const {
    constexpr std::size_t kRaysThroughScattered = 6;
    const double least = least_log_odds(cluster.size());
    const std::optional<ClusterVotes> votes = votes_of(view_, cluster, scan, parameters_, least);
    if (!votes) return false;
    if (!look) look = look_of(view_, cluster, parameters_);
    if (log_odds_of_change(*votes, *look, parameters_) < least) return false;
    if (votes->rays_through < kRaysThroughScattered && is_scattered(cluster.size(), look->smoothness)) return false;
    const std::optional<ClusterPlane> plane = ClusterPlane::fit(view_, cluster, scan);
    return !plane || !(may_be_glass(*plane, scan) || plane->is_met_edge_on());
  }

  /// Whether another scan of the same visit, or a newer one, shows that the cluster was there. A fence may let all rays
  /// of a far scan pass; that it came and went between two stations of one visit is less likely.
  bool is_contradicted(const std::vector<std::uint32_t>& cluster, const ScanView& scan) const {
    constexpr Duration kVisit = std::chrono::hours(1);
    return std::any_of(asked_.begin(), asked_.end(), [&](const ScanView& other) {
      return &other != &scan && between(other.captured_at, scan.captured_at) <= kVisit &&
             shows(other, view_, cluster, parameters_);
    });
  }

  /// Hardly any false cluster of the simulated places reaches it. Where leaves and grass are to be reckoned with, many
  /// more clusters of free points are false than truly changed, above all the smallest.
  double least_log_odds(std::size_t points) const {
    constexpr std::size_t kFew = 9;
    if (parameters_.foliage_distance_m == 0.0) return 1.1;
    return points < kFew ? 3.0 : 1.2;
  }

  const ScanView& view_;
  std::span<const ScanView> asked_;
  const CompareParameters& parameters_;
};

/// The members of a cluster that nobody contradicts, if these are the most.
std::vector<std::uint32_t> agreed_members(const ScanView& view, std::span<const Candidate> cluster) {
  std::vector<std::uint32_t> members;
  for (const Candidate& candidate : cluster) {
    if (!candidate.contradicted) members.push_back(candidate.index);
  }
  if (2 * members.size() < cluster.size()) members.clear();
  sort_by_place(view.points, members);
  return members;
}

}  // namespace

float reach_m(const ScanView& view, const Eigen::Vector3f& point_m, const CompareParameters& parameters) {
  const auto least_m = static_cast<float>(parameters.cluster_distance_m);
  if (parameters.grouping == Grouping::union_ || !view.sensor.angular_resolution_rad) return least_m;
  const double spacing_m = view.sensor.angular_resolution_rad->maxCoeff() * point_m.norm();
  return std::max(least_m, static_cast<float>(kReachPerSpacing * spacing_m));
}

std::vector<ClassedPoint> find_seeds(const ScanView& view, std::span<const Candidate> candidates,
                                     std::span<const ScanView> asked, const CompareParameters& parameters) {
  const Judge judge(view, asked, parameters);
  std::vector<ClassedPoint> seeds;
  for (const PointClass point_class : {PointClass::added, PointClass::removed, PointClass::discrepancy}) {
    const std::vector<std::vector<Candidate>> clusters = clusters_of(view, candidates, point_class, parameters);
    std::vector<std::vector<std::uint32_t>> sure(clusters.size());
    tbb::parallel_for(std::size_t{0}, clusters.size(), [&](std::size_t c) {
      std::vector<std::uint32_t> members = agreed_members(view, clusters[c]);
      if (judge.is_sure(members)) sure[c] = std::move(members);
    });
    for (const std::vector<std::uint32_t>& members : sure) {
      for (const std::uint32_t i : members) seeds.push_back({i, point_class});
    }
  }
  return seeds;
}

}  // namespace raywatch
