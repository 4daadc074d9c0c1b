#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "tests/simulator/scene.hpp"

namespace raywatch::simulator {

struct Hit {
  double range_m;
  std::uint32_t solid;  ///< its place in the scene
  StateId state;
};

/// Finds the first solid on a ray. Infinite shapes are tried one by one, all others through a hierarchy of bounding
/// boxes. Immutable, so any number of threads may cast; the scene must outlive it.
class RayCaster {
 public:
  explicit RayCaster(const Scene& scene);

  std::optional<Hit> cast(const Ray& ray) const;
  const Scene& scene() const { return *scene_; }

 private:
  /// A leaf holds order_[first .. first + count); an inner node (count 0) has its children at this + 1 and `first`.
  struct Node {
    Eigen::AlignedBox3d box;
    std::uint32_t first = 0;
    std::uint32_t count = 0;
  };
  void build(std::uint32_t first, std::uint32_t last, const std::vector<Eigen::AlignedBox3d>& boxes);

  const Scene* scene_;
  std::vector<std::uint32_t> infinite_;
  std::vector<std::uint32_t> order_;
  std::vector<Node> nodes_;
};

/// The same by trying every solid.
std::optional<Hit> cast_by_brute_force(const Scene& scene, const Ray& ray);

}  // namespace raywatch::simulator
