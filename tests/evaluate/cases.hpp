#pragma once

#include <cstddef>
#include <vector>

#include "core/time.hpp"
#include "tests/evaluate/place.hpp"

namespace raywatch::evaluation {

/// What a scan is compared with.
enum class Against {
  same_pose,   ///< one scan of an earlier state, from the same vantage
  other_pose,  ///< one scan of an earlier state, from another vantage
  several,     ///< the latest scan of each vantage in the latest earlier state
  quiet,       ///< the earlier scans of the same state, the latest of each vantage: whatever is found there is false
};

/// A comparison to be scored: places in `Place::scans`.
struct Case {
  Against against;
  std::size_t scan = 0;
  std::vector<std::size_t> priors;
};

/// Scans from places nearer to each other than this share a vantage.
inline constexpr double kVantage_m = 0.25;

/// Every comparison that a place offers. A state lasts as long as consecutive scans have the same present objects.
/// Scans no farther apart than `contemporary` are never compared.
/// @param most_pairs of single pairs, spread evenly over all that there are.
std::vector<Case> make_cases(const Place& place, Duration contemporary, std::size_t most_pairs);

}  // namespace raywatch::evaluation
