#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <vector>

#include "tests/simulator/random.hpp"

namespace raywatch::simulator {

/// Finds room for things on a floor so that they do not stand in each other.
class FloorPlan {
 public:
  explicit FloorPlan(const Eigen::AlignedBox2d& area_m) : area_m_(area_m) {}

  void keep_free(const Eigen::Vector2d& center_m, double radius_m) { taken_.push_back({center_m, radius_m}); }
  bool is_free(const Eigen::Vector2d& center_m, double radius_m) const;
  /// A random place with that much free room around it, not yet taken. Nothing if a hundred trials find none.
  std::optional<Eigen::Vector2d> find(RandomSequence& random, double radius_m) const;
  /// `find` and `keep_free`.
  std::optional<Eigen::Vector2d> take(RandomSequence& random, double radius_m);

 private:
  struct Circle {
    Eigen::Vector2d center_m;
    double radius_m;
  };
  Eigen::AlignedBox2d area_m_;
  std::vector<Circle> taken_;
};

}  // namespace raywatch::simulator
