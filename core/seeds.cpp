#include "core/seeds.hpp"

#include <algorithm>
#include <limits>
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

/// The greatest log-odds by which one of the asked scans saw that a cluster changed. @param members sorted by place.
double log_odds_of(const ScanView& view, std::span<const std::uint32_t> members, std::span<const ScanView> asked,
                   const CompareParameters& parameters) {
  const double porosity = porosity_of(view, members, parameters);
  double greatest = -std::numeric_limits<double>::infinity();
  for (const ScanView& scan : asked) {
    greatest = std::max(greatest, log_odds_of_change(votes_of(view, members, scan, parameters), porosity));
  }
  return greatest;
}

using Cluster = std::vector<std::uint32_t>;  // places in the scan

class SeedSearch {
 public:
  SeedSearch(const ScanView& view, std::span<const ScanView> asked, const CompareParameters& parameters,
             const GrowFrom& grow_from)
      : view_(view), asked_(asked), parameters_(parameters), grow_from_(grow_from) {}

  std::vector<ClassedPoint> operator()(std::span<const Candidate> candidates) {
    for (const PointClass point_class : {PointClass::added, PointClass::removed, PointClass::discrepancy}) {
      doubtful_.clear();
      for (const std::vector<Candidate>& cluster : clusters_of(view_, candidates, point_class, parameters_)) {
        judge(cluster, point_class);
      }
      if (!doubtful_.empty()) judge_again(point_class);
    }
    return std::move(seeds_);
  }

 private:
  void judge(const std::vector<Candidate>& cluster, PointClass point_class) {
    constexpr std::size_t kLeastPoints = 5;
    constexpr double kSure = 1.2;  // hardly any false cluster of the simulated places reaches it
    constexpr double kDoubtful = -9.0;
    Cluster members;
    for (const Candidate& candidate : cluster) {
      if (!candidate.contradicted) members.push_back(candidate.index);
    }
    if (members.size() < kLeastPoints || 2 * members.size() < cluster.size()) return;
    sort_by_place(view_.points, members);
    const double log_odds = log_odds_of(view_, members, asked_, parameters_);
    if (log_odds >= kSure) {
      add(members, point_class);
    } else if (log_odds >= kDoubtful) {
      doubtful_.push_back(std::move(members));
    }
  }

  /// Of a thing that stands before others, or is far from the scan that is asked, only a part may be seen free. With
  /// what lies beside that part and may belong to it more rays tell.
  void judge_again(PointClass point_class) {
    std::vector<ClassedPoint> tentative;
    for (const Cluster& cluster : doubtful_) {
      for (const std::uint32_t i : cluster) tentative.push_back({i, point_class});
    }
    std::vector<Candidate> grown;
    for (const ClassedPoint& point : grow_from_(tentative)) grown.push_back({point.index, point_class});
    std::vector<std::uint8_t> is_sure(view_.points.size(), 0);
    for (const std::vector<Candidate>& cluster : clusters_of(view_, grown, point_class, parameters_)) {
      Cluster members;
      for (const Candidate& point : cluster) members.push_back(point.index);
      sort_by_place(view_.points, members);
      if (log_odds_of(view_, members, asked_, parameters_) < 1.2) continue;
      for (const std::uint32_t i : members) is_sure[i] = 1;
    }
    for (const Cluster& cluster : doubtful_) {
      if (is_sure[cluster.front()]) add(cluster, point_class);
    }
  }

  void add(const Cluster& cluster, PointClass point_class) {
    for (const std::uint32_t i : cluster) seeds_.push_back({i, point_class});
  }

  const ScanView& view_;
  std::span<const ScanView> asked_;
  const CompareParameters& parameters_;
  const GrowFrom& grow_from_;
  std::vector<Cluster> doubtful_;
  std::vector<ClassedPoint> seeds_;
};

}  // namespace

float reach_m(const ScanView& view, const Eigen::Vector3f& point_m, const CompareParameters& parameters) {
  const auto least_m = static_cast<float>(parameters.cluster_distance_m);
  if (parameters.grouping == Grouping::union_ || !view.sensor.angular_resolution_rad) return least_m;
  const double spacing_m = view.sensor.angular_resolution_rad->maxCoeff() * point_m.norm();
  return std::max(least_m, static_cast<float>(kReachPerSpacing * spacing_m));
}

std::vector<ClassedPoint> find_seeds(const ScanView& view, std::span<const Candidate> candidates,
                                     std::span<const ScanView> asked, const CompareParameters& parameters,
                                     const GrowFrom& grow_from) {
  return SeedSearch(view, asked, parameters, grow_from)(candidates);
}

}  // namespace raywatch
