#include "core/join_parts.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <numeric>
#include <tuple>

#include "core/look.hpp"

namespace raywatch {
namespace {

/// A gap may be as wide as the larger part is long in plan, times this.
constexpr double kGapPerLength = 1.0;

bool comes_before(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::tie(a.x(), a.y(), a.z()) < std::tie(b.x(), b.y(), b.z());
}

/// One point for each occupied voxel, the first by its coordinates, so that the order of the points does not matter.
std::vector<Eigen::Vector3d> thinned(const Members& members, std::span<const Eigen::Vector3d> world_m, double voxel_m) {
  std::map<std::array<std::int64_t, 3>, Eigen::Vector3d> first;
  for (const std::uint32_t i : members) {
    const Eigen::Vector3d& p = world_m[i];
    const auto at = [&](int axis) { return static_cast<std::int64_t>(std::floor(p[axis] / voxel_m)); };
    const auto [voxel, is_new] = first.try_emplace({at(0), at(1), at(2)}, p);
    if (!is_new && comes_before(p, voxel->second)) voxel->second = p;
  }
  std::vector<Eigen::Vector3d> points_m;
  for (const auto& [voxel, point_m] : first) points_m.push_back(point_m);
  return points_m;
}

struct Part {
  Eigen::AlignedBox3d bounds_m;
  std::vector<Eigen::Vector3d> outline_m;  ///< some of its points, not farther apart than a part of its size
  std::vector<std::uint32_t> views;        ///< that show it, ascending
};

/// In plan.
double length_m(const Eigen::AlignedBox3d& bounds_m) { return bounds_m.sizes().head<2>().norm(); }

Part part_of(const Members& members, const SeenPoints& points) {
  constexpr double kVoxelsPerSize = 24.0, kLeast_m = 0.02;
  Part part;
  for (const std::uint32_t i : members) {
    part.bounds_m.extend(points.world_m[i]);
    part.views.push_back(points.view_of[i]);
  }
  std::ranges::sort(part.views);
  part.views.erase(std::ranges::unique(part.views).begin(), part.views.end());
  const double voxel_m = std::max(kLeast_m, part.bounds_m.sizes().norm() / kVoxelsPerSize);
  part.outline_m = thinned(members, points.world_m, voxel_m);
  return part;
}

/// The shortest way between two parts.
struct Gap {
  double width_m;
  std::uint32_t a, b;  ///< the parts
  Eigen::Vector3d from_m, to_m;
};

bool comes_before(const Gap& a, const Gap& b) {
  const auto key = [](const Gap& gap) {
    return std::tie(gap.width_m, gap.from_m.x(), gap.from_m.y(), gap.from_m.z(), gap.to_m.x(), gap.to_m.y(),
                    gap.to_m.z());
  };
  return key(a) < key(b);
}

Gap gap_between(const std::vector<Part>& parts, std::uint32_t a, std::uint32_t b) {
  double least_m2 = std::numeric_limits<double>::infinity();
  Gap gap{.a = a, .b = b};
  for (const Eigen::Vector3d& p : parts[a].outline_m) {
    for (const Eigen::Vector3d& q : parts[b].outline_m) {
      const double distance_m2 = (p - q).squaredNorm();
      if (distance_m2 >= least_m2) continue;
      least_m2 = distance_m2;
      gap.from_m = p;
      gap.to_m = q;
    }
  }
  if (comes_before(gap.to_m, gap.from_m)) std::swap(gap.from_m, gap.to_m);
  gap.width_m = std::sqrt(least_m2);
  return gap;
}

class Joining {
 public:
  Joining(const std::vector<Members>& clusters, const SeenPoints& points, const CompareParameters& parameters)
      : points_(points), parameters_(parameters), root_(clusters.size()) {
    for (const Members& members : clusters) {
      parts_.push_back(part_of(members, points));
      whole_m_.push_back(parts_.back().bounds_m);
    }
    std::iota(root_.begin(), root_.end(), 0u);
  }

  void run() {
    for (const Gap& gap : gaps()) {
      const std::uint32_t a = root_of(gap.a), b = root_of(gap.b);
      const double allowed_m = kGapPerLength * std::max(length_m(whole_m_[a]), length_m(whole_m_[b]));
      if (a == b || gap.width_m > allowed_m || is_seen_free(gap)) continue;
      root_[std::max(a, b)] = std::min(a, b);
      whole_m_[std::min(a, b)].extend(whole_m_[std::max(a, b)]);
    }
  }

  std::uint32_t root_of(std::uint32_t part) const {
    while (root_[part] != part) part = root_[part];
    return part;
  }

 private:
  /// Between all parts that are near enough to each other, the narrowest first. What is joined grows, so that a gap may
  /// only later be narrow enough.
  std::vector<Gap> gaps() const {
    std::vector<Gap> result;
    for (std::uint32_t a = 0; a < parts_.size(); ++a) {
      for (std::uint32_t b = a + 1; b < parts_.size(); ++b) {
        const double least_m = parts_[a].bounds_m.exteriorDistance(parts_[b].bounds_m);
        const double longer_m = std::max(length_m(parts_[a].bounds_m), length_m(parts_[b].bounds_m));
        if (least_m > kGrowth * kGapPerLength * longer_m) continue;
        result.push_back(gap_between(parts_, a, b));
      }
    }
    std::ranges::sort(result, [](const Gap& a, const Gap& b) { return comes_before(a, b); });
    return result;
  }

  bool is_seen_free(const Gap& gap) const {
    constexpr int kSteps = 16;
    std::vector<Eigen::Vector3d> places_m;
    for (int k = 1; k < kSteps; ++k) {
      places_m.push_back(gap.from_m + (static_cast<double>(k) / kSteps) * (gap.to_m - gap.from_m));
    }
    std::vector<std::uint32_t> views;
    std::ranges::set_union(parts_[gap.a].views, parts_[gap.b].views, std::back_inserter(views));
    return std::ranges::any_of(views, [&](std::uint32_t view) {
      const std::vector<Answer> answers = look_at(*points_.views[view], places_m, parameters_);
      return std::ranges::find(answers, Answer::free) != answers.end();
    });
  }

  /// How much longer a part may become by what is joined to it, for a gap beside it to be looked at.
  static constexpr double kGrowth = 3.0;

  const SeenPoints& points_;
  const CompareParameters& parameters_;
  std::vector<Part> parts_;                   ///< one a cluster
  std::vector<Eigen::AlignedBox3d> whole_m_;  ///< of each root, around all that was joined
  std::vector<std::uint32_t> root_;
};

}  // namespace

std::vector<Members> join_parts(std::vector<Members> clusters, const SeenPoints& points,
                                const CompareParameters& parameters) {
  if (clusters.size() < 2) return clusters;
  Joining joining(clusters, points, parameters);
  joining.run();
  std::vector<Members> joined;
  std::vector<std::size_t> place(clusters.size());
  for (std::uint32_t k = 0; k < clusters.size(); ++k) {
    const std::uint32_t root = joining.root_of(k);
    if (root == k) {
      place[k] = joined.size();
      joined.push_back(std::move(clusters[k]));
    } else {
      Members& whole = joined[place[root]];
      whole.insert(whole.end(), clusters[k].begin(), clusters[k].end());
    }
  }
  for (Members& members : joined) std::ranges::sort(members);
  return joined;
}

}  // namespace raywatch
