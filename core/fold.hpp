#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/compare.hpp"

namespace raywatch {

/// When a prior was taken, seen from the compared scan.
enum class Epoch : std::uint8_t { earlier, contemporary, later };
Epoch epoch_of(const ScanView& prior, const ScanView& scan, Duration tolerance);

/// The class of a point of a prior of that epoch that is free in the scan.
PointClass class_of_prior_point(Epoch prior);

/// True for the classes that mean a change.
bool is_change(PointClass point_class);

/// One prior's answer about one point, as the folds see it.
struct PriorOpinion {
  Answer answer;
  Epoch epoch;
};

/// The published grouping: changed if free in any prior. What an earlier or later prior says comes before a
/// contemporary one's discrepancy.
PointClass fold_union(std::span<const PriorOpinion> opinions);
/// The same for the points from `begin` on, one a class. `answers` are those of each prior about each point.
void fold_union(std::span<const std::vector<Answer>> answers, std::span<const Epoch> epochs, std::size_t begin,
                std::span<PointClass> classes);

/// Evidence is weighed: within each epoch the newest prior that can test the point decides (`opinions` are ordered from
/// the newest to the oldest; `group` numbers those that are contemporary with each other), and support within its group
/// wins. A discrepancy needs that no prior at all supports the point.
PointClass fold_consensus(std::span<const PriorOpinion> opinions, std::span<const std::uint32_t> group);

/// The priors from the newest to the oldest, and which of them are contemporary with each other: a group ends where the
/// step to the next older prior is longer than the tolerance.
struct PriorOrder {
  std::vector<std::size_t> newest_first;
  std::vector<std::uint32_t> group;  ///< in the order of `newest_first`
};
PriorOrder order_by_age(std::span<const ScanView> priors, Duration tolerance);

}  // namespace raywatch
