#include "core/cluster.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <tuple>

namespace raywatch {
namespace {

/// Disjoint sets; the smallest member stands for its set, so that the result does not depend on the order of joining.
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), 0u); }

  std::uint32_t find(std::uint32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(std::uint32_t a, std::uint32_t b) {
    a = find(a);
    b = find(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<std::uint32_t> parent_;
};

/// A cube whose diagonal is shorter than the cluster distance: all of its points belong together without a test.
struct Voxel {
  std::array<std::int64_t, 3> key{};  // z, y, x: the order in which voxels are sorted
  std::uint32_t begin = 0, end = 0;   // its points in the sorted order
};

using Order = std::vector<std::uint32_t>;
using Points = std::span<const Eigen::Vector3f>;

std::array<std::int64_t, 3> key_of(const Eigen::Vector3f& point_m, const Eigen::Vector3f& low_m, double edge_m) {
  const Eigen::Vector3d cell = ((point_m - low_m).cast<double>() / edge_m).array().floor();
  return {static_cast<std::int64_t>(cell.z()), static_cast<std::int64_t>(cell.y()),
          static_cast<std::int64_t>(cell.x())};
}

std::vector<Voxel> make_voxels(Points points_m, double edge_m, Order& order) {
  Eigen::AlignedBox3f bounds;
  for (const auto& point : points_m) bounds.extend(point);
  std::vector<std::array<std::int64_t, 3>> keys(points_m.size());
  for (std::size_t i = 0; i < points_m.size(); ++i) keys[i] = key_of(points_m[i], bounds.min(), edge_m);
  order.resize(points_m.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(),
            [&](std::uint32_t a, std::uint32_t b) { return std::tie(keys[a], a) < std::tie(keys[b], b); });
  std::vector<Voxel> voxels;
  for (std::uint32_t i = 0; i < order.size(); ++i) {
    if (voxels.empty() || voxels.back().key != keys[order[i]]) voxels.push_back({keys[order[i]], i, i});
    voxels.back().end = i + 1;
  }
  return voxels;
}

/// Whether two groups of points come nearer than a distance: groups are halved along their longest side, and halves
/// whose boxes are too far apart, or so near that any pair will do, are decided without looking at points.
class Nearness {
 public:
  Nearness(Points points_m, double distance_m) : points_m_(points_m), squared_m2_(distance_m * distance_m) {}

  bool operator()(std::span<std::uint32_t> a, std::span<std::uint32_t> b) const {
    const Eigen::AlignedBox3f box_a = bounds(a), box_b = bounds(b);
    if (box_a.cast<double>().squaredExteriorDistance(box_b.cast<double>()) >= squared_m2_) return false;
    if (box_a.merged(box_b).diagonal().cast<double>().squaredNorm() < squared_m2_) return true;
    constexpr std::size_t kFew = 64;
    if (a.size() * b.size() <= kFew) return any_pair(a, b);
    const bool split_a = a.size() > 1 && (b.size() == 1 || box_a.diagonal().norm() >= box_b.diagonal().norm());
    auto& whole = split_a ? a : b;
    const std::size_t half = halve(whole, split_a ? box_a : box_b);
    const auto first = whole.first(half), second = whole.subspan(half);
    return split_a ? (*this)(first, b) || (*this)(second, b) : (*this)(a, first) || (*this)(a, second);
  }

 private:
  Eigen::AlignedBox3f bounds(std::span<const std::uint32_t> group) const {
    Eigen::AlignedBox3f box;
    for (const std::uint32_t i : group) box.extend(points_m_[i]);
    return box;
  }

  bool any_pair(std::span<const std::uint32_t> a, std::span<const std::uint32_t> b) const {
    return std::any_of(a.begin(), a.end(), [&](std::uint32_t i) {
      return std::any_of(b.begin(), b.end(), [&](std::uint32_t j) {
        return (points_m_[i].cast<double>() - points_m_[j].cast<double>()).squaredNorm() < squared_m2_;
      });
    });
  }

  std::size_t halve(std::span<std::uint32_t> group, const Eigen::AlignedBox3f& box) const {
    Eigen::Index axis = 0;
    box.diagonal().maxCoeff(&axis);
    const std::size_t half = group.size() / 2;
    std::nth_element(group.begin(), group.begin() + static_cast<std::ptrdiff_t>(half), group.end(),
                     [&](std::uint32_t i, std::uint32_t j) { return points_m_[i][axis] < points_m_[j][axis]; });
    return half;
  }

  Points points_m_;
  double squared_m2_;
};

/// The voxels that come later in the order and can hold a point near enough: rows of up to five voxels in x, one row
/// for each later offset in z and y. As the voxels are sorted, the start of each row only ever moves forward.
template <class Visit>
void for_each_neighbour_pair(const std::vector<Voxel>& voxels, Visit visit) {
  constexpr std::int64_t kReach = 2;
  for (std::int64_t dz = 0; dz <= kReach; ++dz) {
    for (std::int64_t dy = dz == 0 ? 0 : -kReach; dy <= kReach; ++dy) {
      const bool same_row = dz == 0 && dy == 0;
      std::size_t start = 0;
      for (std::size_t v = 0; v < voxels.size(); ++v) {
        const auto& key = voxels[v].key;
        const std::array<std::int64_t, 3> first{key[0] + dz, key[1] + dy, key[2] + (same_row ? 1 : -kReach)};
        while (start < voxels.size() && voxels[start].key < first) ++start;
        for (std::size_t w = start; w < voxels.size(); ++w) {
          const auto& other = voxels[w].key;
          if (other[0] != first[0] || other[1] != first[1] || other[2] > key[2] + kReach) break;
          visit(v, w);
        }
      }
    }
  }
}

/// The cluster of each point in the order of each cluster's first one. `name(i)`, below `n`, names the set of a point.
template <class Name>
std::vector<std::uint32_t> numbered(std::size_t n, Name name) {
  constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> number_of(n, kNone);
  std::vector<std::uint32_t> clusters(n);
  std::uint32_t next = 0;
  for (std::uint32_t i = 0; i < n; ++i) {
    std::uint32_t& number = number_of[name(i)];
    if (number == kNone) number = next++;
    clusters[i] = number;
  }
  return clusters;
}

}  // namespace

std::vector<std::uint32_t> cluster_points(std::span<const Eigen::Vector3f> points_m, double distance_m) {
  constexpr double kShorter = 0.999;  // of the edge that fits exactly, so that rounding cannot make the diagonal longer
  if (points_m.empty()) return {};
  Order order;
  const std::vector<Voxel> voxels = make_voxels(points_m, kShorter * distance_m / std::sqrt(3.0), order);
  const auto group = [&](std::size_t v) {
    return std::span(order).subspan(voxels[v].begin, voxels[v].end - voxels[v].begin);
  };

  DisjointSets sets(voxels.size());
  const Nearness near(points_m, distance_m);
  for_each_neighbour_pair(voxels, [&](std::size_t v, std::size_t w) {
    const auto a = static_cast<std::uint32_t>(v), b = static_cast<std::uint32_t>(w);
    if (sets.find(a) != sets.find(b) && near(group(v), group(w))) sets.join(a, b);
  });

  std::vector<std::uint32_t> voxel_of(points_m.size());
  for (std::uint32_t v = 0; v < voxels.size(); ++v) {
    for (const std::uint32_t i : group(v)) voxel_of[i] = v;
  }
  return numbered(points_m.size(), [&](std::uint32_t i) { return sets.find(voxel_of[i]); });
}

std::vector<std::uint32_t> cluster_points(std::span<const Eigen::Vector3f> points_m, std::span<const float> reach_m) {
  if (points_m.empty()) return {};
  const double least_m = *std::min_element(reach_m.begin(), reach_m.end());
  const double greatest_m = *std::max_element(reach_m.begin(), reach_m.end());
  DisjointSets sets(points_m.size());
  // Linking those of at least one reach by that reach, for each reach, links each pair by the smaller of its two.
  for (double level_m = least_m; level_m <= greatest_m; level_m *= std::numbers::sqrt2) {
    std::vector<std::uint32_t> members;
    std::vector<Eigen::Vector3f> positions_m;
    for (std::uint32_t i = 0; i < points_m.size(); ++i) {
      if (reach_m[i] < level_m) continue;
      members.push_back(i);
      positions_m.push_back(points_m[i]);
    }
    const std::vector<std::uint32_t> cluster_of = cluster_points(positions_m, level_m);
    std::vector<std::uint32_t> first_of;
    for (std::size_t k = 0; k < members.size(); ++k) {
      if (cluster_of[k] == first_of.size()) first_of.push_back(members[k]);
      sets.join(first_of[cluster_of[k]], members[k]);
    }
  }
  return numbered(points_m.size(), [&](std::uint32_t i) { return sets.find(i); });
}

}  // namespace raywatch
