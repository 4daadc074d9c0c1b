#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/compare.hpp"
#include "tests/simulator/simulated_scan.hpp"

/// How results are scored against the truth, point by point.
namespace raywatch::evaluation {

using simulator::SimulatedScan;
using simulator::StateId;

/// How many points were found and missed.
struct PointCounts {
  std::size_t found = 0;      ///< changed, and called so
  std::size_t false_ = 0;     ///< not changed, but called so
  std::size_t missed = 0;     ///< changed, but not called so
  std::size_t unchanged = 0;  ///< not changed, and not called so

  double precision() const;  ///< found / (found + false); 1 when nothing was called changed
  double recall() const;     ///< found / (found + missed); 1 when nothing changed
  double f_score() const;    ///< harmonic mean of both
  PointCounts& operator+=(const PointCounts& other);
  friend bool operator==(const PointCounts&, const PointCounts&) = default;
};

/// Both directions of a comparison.
struct Counts {
  PointCounts added;    ///< the scan's points
  PointCounts removed;  ///< the priors' points, each prior's for itself
  PointCounts both() const;
  Counts& operator+=(const Counts& other);
  friend bool operator==(const Counts&, const Counts&) = default;
};

/// The truth about a point. What lies on no surface is ignored: neither found nor false nor missed.
enum class Truth : std::uint8_t { unchanged, changed, ignored };

/// The truth about a comparison, which depends on the labels only.
struct CaseTruth {
  std::vector<Truth> scan;                 ///< changed: what it shows was there in none of the priors
  std::vector<std::vector<Truth>> priors;  ///< changed: what it shows was not there any more in the scan
};
CaseTruth truth_of(const SimulatedScan& scan, std::span<const SimulatedScan* const> priors);

/// What a comparison says of each point, whether it clusters or not.
struct Verdicts {
  std::vector<std::uint8_t> scan;                 ///< 1: called changed
  std::vector<std::vector<std::uint8_t>> priors;  ///< of each prior's points
};

/// Of single points, before clustering.
Verdicts verdicts_of(const Detection& detection, std::span<const ScanView> priors);
/// Of what is left after clustering.
Verdicts verdicts_of(const Comparison& comparison, std::span<const ScanView> priors);

Counts count_points(const Verdicts& verdicts, const CaseTruth& truth);

}  // namespace raywatch::evaluation
