#include "core/grow.hpp"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "core/cluster.hpp"
#include "core/cluster_votes.hpp"
#include "core/cone.hpp"
#include "core/fold.hpp"
#include "core/prior_index_impl.hpp"

namespace raywatch {
namespace {

/// A reach in multiples of the spacing of the shots: bridges a lost return, and surfaces seen aslant.
constexpr double kReachPerSpacing = 2.0;

/// A point that has joined, and the seed from which it was reached.
struct Joined {
  std::uint32_t index;
  std::uint32_t seed;
  PointClass point_class;
};

/// A point beside one that has joined.
struct Neighbour {
  Joined joins;
  float distance_m;  ///< from the seed
};

bool is_nearer(const Neighbour& a, const Neighbour& b) {
  return std::tie(a.joins.index, a.distance_m, a.joins.seed) < std::tie(b.joins.index, b.distance_m, b.joins.seed);
}

class Growth {
 public:
  Growth(const ScanView& view, std::span<const ScanView> asked, const CompareParameters& parameters)
      : view_(view), asked_(asked), parameters_(parameters) {}

  std::vector<ClassedPoint> operator()(std::span<const Candidate> candidates, const IsOpen& is_open) {
    visited_.assign(view_.points.size(), 0);
    candidate_.assign(view_.points.size(), 0);
    for (const Candidate& candidate : candidates) candidate_[candidate.index] = !candidate.contradicted;
    std::vector<Joined> front = seeds(candidates);
    std::vector<ClassedPoint> changed;
    if (!front.empty()) source_ = sources_of(view_.index.impl(), view_.points);
    for (const Joined& seed : front) visited_[seed.index] = 1;
    while (!front.empty()) {
      for (const Joined& joined : front) changed.push_back({joined.index, joined.point_class});
      const std::vector<Joined> offered = beside(front);
      std::vector<std::uint32_t> places;
      for (const Joined& offer : offered) {
        visited_[offer.index] = 1;
        places.push_back(offer.index);
      }
      const std::vector<std::uint8_t> open = is_open(places);
      front.clear();
      for (std::size_t k = 0; k < offered.size(); ++k) {
        if (!open[k]) continue;
        front.push_back(offered[k]);
        if (candidate_[offered[k].index]) front.back().seed = offered[k].index;
      }
    }
    std::sort(changed.begin(), changed.end(), [](const auto& a, const auto& b) { return a.index < b.index; });
    return changed;
  }

 private:
  std::vector<Joined> seeds(std::span<const Candidate> candidates) const {
    std::vector<Joined> result;
    for (const PointClass point_class : {PointClass::added, PointClass::removed, PointClass::discrepancy}) {
      for (const std::vector<Candidate>& cluster : clusters_of(candidates, point_class)) {
        std::vector<std::uint32_t> members;
        for (const Candidate& candidate : cluster) {
          if (!candidate.contradicted) members.push_back(candidate.index);
        }
        if (2 * members.size() < cluster.size() || !is_sure(members)) continue;
        for (const std::uint32_t i : members) result.push_back({i, i, point_class});
      }
    }
    return result;
  }

  std::vector<std::vector<Candidate>> clusters_of(std::span<const Candidate> candidates, PointClass point_class) const {
    std::vector<Candidate> members;
    std::vector<Eigen::Vector3f> positions_m;
    std::vector<float> reaches_m;
    for (const Candidate& candidate : candidates) {
      if (candidate.point_class != point_class) continue;
      members.push_back(candidate);
      positions_m.push_back(view_.points[candidate.index]);
      reaches_m.push_back(reach_m(view_, positions_m.back(), parameters_));
    }
    const std::vector<std::uint32_t> cluster_of = cluster_points(positions_m, reaches_m);
    std::vector<std::vector<Candidate>> clusters;
    for (std::size_t k = 0; k < members.size(); ++k) {
      if (cluster_of[k] == clusters.size()) clusters.emplace_back();
      clusters[cluster_of[k]].push_back(members[k]);
    }
    return clusters;
  }

  /// Whether a prior surely saw the place of the cluster free. Each bound was measured on simulated scenes: it lies
  /// between what things that came or went show, and what shelves seen edge-on, foliage, fences and mixed returns show.
  bool is_sure(const std::vector<std::uint32_t>& cluster) const {
    constexpr std::size_t kLeastRays = 5;
    constexpr double kLeastCoherence = 0.55;
    constexpr double kLeastSurroundings = 0.85;
    const double noise_m = view_.sensor.range_noise_m.value_or(0.0);
    const double greatest_roughness_m = std::max(parameters_.support_distance_m / 3.0, noise_m);
    if (cluster.size() < kLeastRays) return false;
    return std::any_of(asked_.begin(), asked_.end(), [&](const ScanView& asked) {
      const ClusterVotes votes = votes_of(view_, cluster, asked, parameters_);
      return votes.rays_through >= kLeastRays && votes.coherence >= kLeastCoherence &&
             votes.surroundings >= kLeastSurroundings && votes.roughness_m <= greatest_roughness_m;
    });
  }

  /// The points not yet visited that are within reach of the front, each from the nearest seed, by index.
  std::vector<Joined> beside(std::span<const Joined> front) const {
    std::vector<std::vector<Neighbour>> found(front.size());
    tbb::parallel_for(std::size_t{0}, front.size(), [&](std::size_t k) { found[k] = neighbours(front[k]); });
    std::vector<Neighbour> all;
    for (const auto& some : found) all.insert(all.end(), some.begin(), some.end());
    std::sort(all.begin(), all.end(), is_nearer);
    std::vector<Joined> result;
    for (const Neighbour& neighbour : all) {
      if (result.empty() || result.back().index != neighbour.joins.index) result.push_back(neighbour.joins);
    }
    return result;
  }

  std::vector<Neighbour> neighbours(const Joined& from) const {
    const PriorIndex::Impl& index = view_.index.impl();
    const Eigen::Vector3f place_m = view_.points[from.index], seed_m = view_.points[from.seed];
    const float reach = reach_m(view_, place_m, parameters_);
    const double ratio = reach / place_m.norm();
    const float farthest_m = std::max(static_cast<float>(parameters_.growth_distance_m), reach);
    std::vector<Neighbour> result;
    const Direction axis = direction_of(place_m.x(), place_m.y(), place_m.z());
    Cone(ratio < 1.0 ? std::asin(ratio) : std::numbers::pi / 2)
        .for_each_cell(index.grid, axis, [&](std::uint32_t cell, bool) {
          for (std::uint32_t i = index.first[cell]; i < index.first[cell + 1]; ++i) {
            if (visited_[source_[i]]) continue;
            const Eigen::Vector3f p = point_of(index.returns[i]).cast<float>();
            if ((p - place_m).squaredNorm() >= reach * reach) continue;
            const float distance_m = (p - seed_m).norm();
            if (distance_m <= farthest_m) result.push_back({{source_[i], from.seed, from.point_class}, distance_m});
          }
          return true;
        });
    return result;
  }

  const ScanView& view_;
  std::span<const ScanView> asked_;
  const CompareParameters& parameters_;
  std::vector<std::uint32_t> source_;  ///< of each return of the view's index, its place in the scan
  std::vector<std::uint8_t> visited_;
  std::vector<std::uint8_t> candidate_;  ///< free, though perhaps in no sure cluster
};

}  // namespace

float reach_m(const ScanView& view, const Eigen::Vector3f& point_m, const CompareParameters& parameters) {
  const auto least_m = static_cast<float>(parameters.cluster_distance_m);
  if (parameters.grouping == Grouping::union_ || !view.sensor.angular_resolution_rad) return least_m;
  const double spacing_m = view.sensor.angular_resolution_rad->maxCoeff() * point_m.norm();
  return std::max(least_m, static_cast<float>(kReachPerSpacing * spacing_m));
}

std::vector<ClassedPoint> grow(const ScanView& view, std::span<const Candidate> candidates,
                               std::span<const ScanView> asked, const CompareParameters& parameters,
                               const IsOpen& is_open) {
  return Growth(view, asked, parameters)(candidates, is_open);
}

}  // namespace raywatch
