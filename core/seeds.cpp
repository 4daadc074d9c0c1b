#include "core/seeds.hpp"

namespace raywatch {
namespace {

/// Whether two clusters are likely of one thing, each seen by another scan.
bool are_of_one_thing(const JudgedCluster& a, const JudgedCluster& b) {
  constexpr double kBeside_m = 0.1;
  if (a.point_class != b.point_class) return false;
  const Eigen::Vector3d margin_m = Eigen::Vector3d::Constant(kBeside_m);
  return a.box_m.intersects(Eigen::AlignedBox3d(b.box_m.min() - margin_m, b.box_m.max() + margin_m));
}

}  // namespace

std::vector<std::vector<ClassedPoint>> find_seeds(std::span<const std::vector<JudgedCluster>> scans,
                                                  const CompareParameters& parameters) {
  const double least_opinion = least_log_odds_of_second_opinion(parameters);
  const auto has_second_opinion = [&](const JudgedCluster& cluster, std::size_t scan) {
    if (cluster.rays_through < kEnoughRaysThrough) return false;
    if (cluster.next_log_odds >= least_opinion) return true;
    for (std::size_t other = 0; other < scans.size(); ++other) {
      if (other == scan) continue;
      for (const JudgedCluster& beside : scans[other]) {
        if (beside.log_odds >= least_opinion && are_of_one_thing(cluster, beside)) return true;
      }
    }
    return false;
  };
  constexpr double kSecondOpinion = 2.5;  // log-odds
  std::vector<std::vector<ClassedPoint>> seeds(scans.size());
  for (std::size_t scan = 0; scan < scans.size(); ++scan) {
    for (const JudgedCluster& cluster : scans[scan]) {
      const double missing = sure_log_odds(cluster.members.size(), parameters) - cluster.log_odds;
      if (missing > kSecondOpinion || (missing > 0.0 && !has_second_opinion(cluster, scan))) continue;
      for (const std::uint32_t i : cluster.members) seeds[scan].push_back({i, cluster.point_class});
    }
  }
  return seeds;
}

}  // namespace raywatch
