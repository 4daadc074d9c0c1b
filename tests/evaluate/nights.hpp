#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "core/change.hpp"
#include "core/time.hpp"

namespace raywatch::evaluation {

/// A yard watched for many nights.
struct NightsOptions {
  std::uint64_t seed = 1;
  bool hard = false;                ///< more clutter, and fixed sensors that are 1 cm and 0.05 degrees off
  double density = 1.0;             ///< of 64 rings of 1800 shots
  std::uint32_t scans = 1000;       ///< of two sensors together
  std::uint32_t rounds_apart = 20;  ///< something lasting happens every so many rounds of both sensors
};

/// Something that was left, or taken, for good: it must be told, once.
struct Planted {
  std::string name;
  ChangeKind kind = ChangeKind::added;
  Time at;
  std::size_t alerts = 0;
};

/// An alert that nothing planted explains.
struct FalseAlert {
  Time at;
  std::string title;
  Eigen::AlignedBox3d box_m;  ///< of its track at the beginning; empty for alerts of the system
};

struct NightsResult {
  std::size_t scans = 0, passers = 0;  ///< passers: how many times somebody stood in the yard
  std::vector<Planted> planted;
  std::vector<FalseAlert> false_alerts;

  std::size_t told(std::size_t times) const;  ///< how many of what was planted have so many alerts
};

/// Simulates the nights and has them watched as the daemon would, with the default rule of the outdoor profile. The
/// same options give the same result. @param progress is called after each scan with its number.
NightsResult watch_nights(const NightsOptions& options, const std::function<void(std::size_t)>& progress);

}  // namespace raywatch::evaluation
