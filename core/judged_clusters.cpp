#include "core/judged_clusters.hpp"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <chrono>
#include <limits>
#include <optional>
#include <tuple>
#include <utility>

#include "core/cluster.hpp"
#include "core/cluster_aspect.hpp"
#include "core/cluster_plane.hpp"
#include "core/cluster_votes.hpp"
#include "core/glass.hpp"
#include "core/reach.hpp"

namespace raywatch {
namespace {

constexpr double kSurelyNot = -std::numeric_limits<double>::infinity();

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
  std::vector<std::tuple<float, float, float, std::uint32_t>> places;
  places.reserve(members.size());
  for (const std::uint32_t i : members) places.emplace_back(points.x_m[i], points.y_m[i], points.z_m[i], i);
  std::sort(places.begin(), places.end());
  std::transform(places.begin(), places.end(), members.begin(), [](const auto& place) { return std::get<3>(place); });
}

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

/// Judges the clusters of one scan.
class Judge {
 public:
  Judge(const ScanView& view, std::span<const ScanView> asked, bool is_one_of_several,
        const CompareParameters& parameters)
      : view_(view),
        asked_(asked),
        parameters_(parameters),
        wants_second_opinions_(is_one_of_several || asked.size() > 1) {}

  /// Fills in the log-odds of a cluster.
  void judge(JudgedCluster& cluster) const {
    constexpr std::size_t kLeastPoints = 5;
    if (cluster.members.size() < kLeastPoints) return;
    const double sure = sure_log_odds(cluster.members.size(), parameters_);
    const double least = wants_second_opinions_ ? std::min(sure, least_log_odds_of_second_opinion(parameters_)) : sure;
    std::optional<ClusterLook> look;  // needed of few clusters, whichever scan is asked
    for (const ScanView& scan : asked_) {
      const Opinion opinion = opinion_of(scan, cluster.members, least, look);
      cluster.next_log_odds = std::max(cluster.next_log_odds, std::min(opinion.log_odds, cluster.log_odds));
      cluster.log_odds = std::max(cluster.log_odds, opinion.log_odds);
      cluster.rays_through = std::max(cluster.rays_through, opinion.rays_through);
      if (cluster.log_odds >= sure) return;
    }
  }

 private:
  struct Opinion {
    double log_odds = kSurelyNot;
    std::size_t rays_through = 0;
  };

  Opinion opinion_of(const ScanView& scan, const std::vector<std::uint32_t>& cluster, double least,
                     std::optional<ClusterLook>& look) const {
    const std::optional<ClusterVotes> votes = votes_of(view_, cluster, scan, parameters_, least);
    if (!votes) return {};
    if (!look) look = look_of(view_, cluster, parameters_);
    double log_odds = log_odds_of_change(*votes, *look, parameters_);
    if (log_odds < least) return {};
    log_odds -= doubt_of(aspect_of(view_, cluster, scan), *votes, *look, parameters_);
    if (log_odds < least) return {};
    if (votes->rays_through < kEnoughRaysThrough && is_scattered(cluster.size(), look->smoothness)) return {};
    const std::optional<ClusterPlane> plane = ClusterPlane::fit(view_, cluster, scan);
    if (plane && may_be_glass(*plane, scan)) return {};
    if (is_contradicted(cluster, scan)) return {};
    return {log_odds, votes->rays_through};
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

  const ScanView& view_;
  std::span<const ScanView> asked_;
  const CompareParameters& parameters_;
  bool wants_second_opinions_;
};

Eigen::AlignedBox3d box_around(const ScanView& view, std::span<const std::uint32_t> members) {
  Eigen::AlignedBox3d box_m;
  for (const std::uint32_t i : members) box_m.extend(view.world_from_sensor * view.points[i].cast<double>());
  return box_m;
}

}  // namespace

double sure_log_odds(std::size_t points, const CompareParameters& parameters) {
  // Hardly any false cluster of the simulated places reaches it. Where leaves and grass are to be reckoned with, many
  // more clusters of free points are false than truly changed, above all the smallest.
  constexpr std::size_t kFew = 9;
  if (parameters.foliage_distance_m == 0.0) return 1.1;
  return points < kFew ? 3.0 : 1.2;
}

double least_log_odds_of_second_opinion(const CompareParameters& parameters) {
  // Through leaves and fences the rays of several scans pass, too: there a second scan tells nothing new.
  return parameters.foliage_distance_m == 0.0 ? -3.0 : std::numeric_limits<double>::infinity();
}

std::vector<JudgedCluster> judge_clusters(const ScanView& view, std::span<const Candidate> candidates,
                                          std::span<const ScanView> asked, bool is_one_of_several,
                                          const CompareParameters& parameters) {
  const Judge judge(view, asked, is_one_of_several, parameters);
  std::vector<JudgedCluster> result;
  for (const PointClass point_class : {PointClass::added, PointClass::removed, PointClass::discrepancy}) {
    const std::vector<std::vector<Candidate>> clusters = clusters_of(view, candidates, point_class, parameters);
    std::vector<JudgedCluster> judged(clusters.size());
    tbb::parallel_for(std::size_t{0}, clusters.size(), [&](std::size_t c) {
      judged[c].point_class = point_class;
      judged[c].members = agreed_members(view, clusters[c]);
      judge.judge(judged[c]);
    });
    for (JudgedCluster& cluster : judged) {
      if (cluster.log_odds == kSurelyNot) continue;
      cluster.box_m = box_around(view, cluster.members);
      result.push_back(std::move(cluster));
    }
  }
  return result;
}

}  // namespace raywatch
