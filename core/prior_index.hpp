#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string_view>

#include "core/point_cloud.hpp"
#include "core/pose.hpp"

namespace raywatch {

/// What one prior says about one world point. The first that holds, with N the prior's returns within T_a of the
/// point's direction, rho its range in the prior's sensor frame and rho_i the range of return i.
enum class Answer : std::uint8_t {
  unseen,     ///< N is empty
  free,       ///< every rho_i >= rho + T_r, and N surrounds the direction (Algorithm 1 of Underwood et al. 2013)
  supported,  ///< some |rho_i - rho| < T_r
  occluded,   ///< every rho_i <= rho - T_r
  ambiguous,  ///< nearer and farther returns, or farther ones that do not surround the direction
};

/// The two thresholds of the question.
struct Thresholds {
  double angle_rad = 0.0;  ///< T_a, a great-circle angle, 0 < T_a <= pi/2
  double range_m = 0.0;    ///< T_r >= 0
};

/// A scan, sorted by direction, that answers what was free, occupied or out of sight from where it was taken.
/// Immutable after `build`, so any number of threads may ask it. Independent of the thresholds.
class PriorIndex {
 public:
  /// Indexes the usable returns. O(n). Runs in the caller's oneTBB arena.
  static PriorIndex build(const PointCloud& points, const UsableRange& usable);

  PriorIndex(PriorIndex&&) noexcept;
  PriorIndex& operator=(PriorIndex&&) noexcept;
  ~PriorIndex();

  std::size_t size() const;   ///< usable returns
  std::size_t bytes() const;  ///< memory held
  const UsableRange& usable() const;

  struct Impl;
  const Impl& impl() const { return *impl_; }

 private:
  explicit PriorIndex(std::unique_ptr<const Impl> impl);
  std::unique_ptr<const Impl> impl_;
};

/// Asks `prior` about every point of `points`, which stand in a frame that `prior_from_points` leads out of.
/// Points for which `valid` is 0 get `unseen`. `answers` has one element a point.
/// @throws InvalidInput when a threshold is out of its range.
void ask(const PriorIndex& prior, const PointCloud& points, std::span<const std::uint8_t> valid,
         const Pose& prior_from_points, const Thresholds& thresholds, std::span<Answer> answers);

/// For each point whether `ask` would answer free: 1 if so, else 0.
/// @throws InvalidInput when a threshold is out of its range.
void find_free(const PriorIndex& prior, const PointCloud& points, std::span<const std::uint8_t> valid,
               const Pose& prior_from_points, const Thresholds& thresholds, std::span<std::uint8_t> free);

/// For each point whether a return of `prior` lies nearer to it than `distance_m` (> 0), in any direction.
void find_near_returns(const PriorIndex& prior, const PointCloud& points, const Pose& prior_from_points,
                       double distance_m, std::span<std::uint8_t> near);

}  // namespace raywatch
