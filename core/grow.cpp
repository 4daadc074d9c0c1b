#include "core/grow.hpp"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <tuple>

#include "core/assumed_sensor.hpp"
#include "core/marked_points.hpp"
#include "core/reach.hpp"
#include "core/returns_near.hpp"

namespace raywatch {
namespace {

/// A point that has joined, and the seed from which it was reached.
struct Joined {
  std::uint32_t index;
  std::uint32_t seed;
  PointClass point_class;
};

/// A point beside one that has joined.
struct JoinedNeighbour {
  Joined joins;
  float distance_m;  ///< from the seed
};

bool is_nearer(const JoinedNeighbour& a, const JoinedNeighbour& b) {
  return std::tie(a.joins.index, a.distance_m, a.joins.seed) < std::tie(b.joins.index, b.distance_m, b.joins.seed);
}

class Growth {
 public:
  Growth(const ScanView& view, std::span<const std::uint32_t> sources, const CompareParameters& parameters)
      : view_(view), sources_(sources), parameters_(parameters) {}

  std::vector<ClassedPoint> operator()(std::span<const ClassedPoint> seeds, std::span<const Candidate> candidates,
                                       const IsOpen& is_open) {
    visited_.emplace(view_, sources_);
    candidate_.assign(view_.points.size(), 0);
    for (const Candidate& candidate : candidates) candidate_[candidate.index] = !candidate.contradicted;
    std::vector<Joined> front;
    for (const ClassedPoint& seed : seeds) {
      front.push_back({seed.index, seed.index, seed.point_class});
      visited_->mark(seed.index);
    }
    std::vector<ClassedPoint> changed;
    while (!front.empty()) {
      for (const Joined& joined : front) changed.push_back({joined.index, joined.point_class});
      const std::vector<Joined> offered = beside(front);
      std::vector<std::uint32_t> places;
      for (const Joined& offer : offered) {
        visited_->mark(offer.index);
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
  /// The points not yet visited that are within reach of the front, each from the nearest seed, by index.
  std::vector<Joined> beside(std::span<const Joined> front) const {
    std::vector<std::vector<JoinedNeighbour>> found(front.size());
    tbb::parallel_for(std::size_t{0}, front.size(), [&](std::size_t k) { found[k] = neighbours(front[k]); });
    std::vector<JoinedNeighbour> all;
    for (const auto& some : found) all.insert(all.end(), some.begin(), some.end());
    std::sort(all.begin(), all.end(), is_nearer);
    std::vector<Joined> result;
    for (const JoinedNeighbour& neighbour : all) {
      if (result.empty() || result.back().index != neighbour.joins.index) result.push_back(neighbour.joins);
    }
    return result;
  }

  /// How far the next point may be: as far as points of one thing may be apart, but where shots lie densely no farther
  /// than a few of them, as all those between would be looked at.
  float step_m(const Eigen::Vector3f& place_m) const {
    constexpr double kMostShots = 6.0;
    const double dense_m = kMostShots * spacing_of(view_).maxCoeff() * place_m.norm();
    return std::min(reach_m(view_, place_m, parameters_), static_cast<float>(dense_m));
  }

  std::vector<JoinedNeighbour> neighbours(const Joined& from) const {
    const PriorIndex::Impl& index = view_.index.impl();
    const Eigen::Vector3f place_m = view_.points[from.index], seed_m = view_.points[from.seed];
    const float reach = step_m(place_m);
    const float farthest_m = std::max(static_cast<float>(parameters_.growth_distance_m), reach);
    std::vector<JoinedNeighbour> result;
    const auto offer = [&](std::uint32_t i) {
      if ((*visited_)[sources_[i]]) return;
      const float distance_m = (point_of(index.returns[i]).cast<float>() - seed_m).norm();
      if (distance_m <= farthest_m) result.push_back({{sources_[i], from.seed, from.point_class}, distance_m});
    };
    for_each_return_around(index, place_m.cast<double>(), reach, offer, *visited_);
    return result;
  }

  const ScanView& view_;
  std::span<const std::uint32_t> sources_;
  const CompareParameters& parameters_;
  std::optional<MarkedPoints> visited_;
  std::vector<std::uint8_t> candidate_;  ///< free, though perhaps in no sure cluster
};

}  // namespace

std::vector<ClassedPoint> grow(const ScanView& view, std::span<const std::uint32_t> sources,
                               std::span<const ClassedPoint> seeds, std::span<const Candidate> candidates,
                               const CompareParameters& parameters, const IsOpen& is_open) {
  return Growth(view, sources, parameters)(seeds, candidates, is_open);
}

}  // namespace raywatch
