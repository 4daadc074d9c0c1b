#include "core/seeds.hpp"

#include <algorithm>
#include <tuple>

#include "core/cluster.hpp"
#include "core/cluster_votes.hpp"

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

bool is_sure(const ScanView& view, const std::vector<std::uint32_t>& cluster, std::span<const ScanView> asked,
             const CompareParameters& parameters) {
  constexpr std::size_t kLeastPoints = 5;
  constexpr double kLeastLogOdds = 1.2;  // hardly any false cluster of the simulated places reaches it
  if (cluster.size() < kLeastPoints) return false;
  const double porosity = porosity_of(view, cluster, parameters);
  return std::any_of(asked.begin(), asked.end(), [&](const ScanView& scan) {
    return log_odds_of_change(votes_of(view, cluster, scan, parameters), porosity) >= kLeastLogOdds;
  });
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
  std::vector<ClassedPoint> seeds;
  for (const PointClass point_class : {PointClass::added, PointClass::removed, PointClass::discrepancy}) {
    for (const std::vector<Candidate>& cluster : clusters_of(view, candidates, point_class, parameters)) {
      std::vector<std::uint32_t> members;
      for (const Candidate& candidate : cluster) {
        if (!candidate.contradicted) members.push_back(candidate.index);
      }
      sort_by_place(view.points, members);
      if (2 * members.size() < cluster.size() || !is_sure(view, members, asked, parameters)) continue;
      for (const std::uint32_t i : members) seeds.push_back({i, point_class});
    }
  }
  return seeds;
}

}  // namespace raywatch
