#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "core/ask_kernels.hpp"
#include "core/error.hpp"
#include "core/for_each_point.hpp"
#include "core/nearest_return.hpp"
#include "core/prior_index_impl.hpp"

namespace raywatch {
namespace {

void check(const Thresholds& thresholds) {
  if (!(thresholds.angle_rad > 0.0 && thresholds.angle_rad <= std::numbers::pi / 2)) {
    throw InvalidInput("The angular threshold must be above 0 and at most 90 degrees.",
                       {{"angle_deg", "must be above 0 and at most 90"}});
  }
  if (!(thresholds.range_m >= 0.0 && std::isfinite(thresholds.range_m))) {
    throw InvalidInput("The range threshold must be 0 or more metres.", {{"range_m", "must be 0 or more"}});
  }
}

template <class AskBlock, class Result>
void ask_in_blocks(AskBlock ask_a_block, const PriorIndex& prior, const PointCloud& points,
                   std::span<const std::uint8_t> valid, const Pose& prior_from_points, const Thresholds& thresholds,
                   Result* results) {
  const PreparedPrior prepared(prior.impl(), thresholds);
  const RigidMotion motion(prior_from_points);
  constexpr std::size_t kGrain = 4096;
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, points.size(), kGrain), [&](const auto& block) {
    ask_a_block(prepared, planes_of(points).subspan(block.begin(), block.size()), valid.data() + block.begin(), motion,
                results + block.begin());
  });
}

}  // namespace

void ask(const PriorIndex& prior, const PointCloud& points, std::span<const std::uint8_t> valid,
         const Pose& prior_from_points, const Thresholds& thresholds, std::span<Answer> answers) {
  check(thresholds);
  if (prior.size() == 0) {
    std::fill(answers.begin(), answers.end(), Answer::unseen);
    return;
  }
  ask_in_blocks(ask_block, prior, points, valid, prior_from_points, thresholds, answers.data());
}

void find_free(const PriorIndex& prior, const PointCloud& points, std::span<const std::uint8_t> valid,
               const Pose& prior_from_points, const Thresholds& thresholds, std::span<std::uint8_t> free) {
  check(thresholds);
  if (prior.size() == 0) {
    std::fill(free.begin(), free.end(), std::uint8_t{0});
    return;
  }
  ask_in_blocks(find_free_in_block, prior, points, valid, prior_from_points, thresholds, free.data());
}

void find_near_returns(const PriorIndex& prior, const PointCloud& points, const Pose& prior_from_points,
                       double distance_m, std::span<std::uint8_t> near) {
  const PriorIndex::Impl& impl = prior.impl();
  for_each_point(points, prior_from_points, [&](std::size_t i, const Eigen::Vector3d& point_m) {
    // Nothing is near a sensor itself.
    near[i] = point_m.norm() > distance_m && nearest_return_m(impl, point_m, distance_m, distance_m) < distance_m;
  });
}

}  // namespace raywatch
