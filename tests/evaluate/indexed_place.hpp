#pragma once

#include <memory>
#include <vector>

#include "core/compare.hpp"
#include "core/index_scan.hpp"
#include "core/profile.hpp"
#include "tests/evaluate/cases.hpp"

namespace raywatch::evaluation {

/// A case's scans as `compare` takes them.
struct CaseViews {
  ScanView scan;
  std::vector<ScanView> priors;
};

/// A place with every scan indexed once for each way of comparing, so that any number of thresholds can be tried.
/// Immutable; the place must outlive it. What is known about each sensor is estimated from its scan, as the program
/// does for files.
class IndexedPlace {
 public:
  /// Runs in the caller's oneTBB arena. The profile says which returns a consensus takes for the rig.
  IndexedPlace(const Place& place, Profile profile);

  const Place& place() const { return *place_; }
  /// `union` filters no return by what was estimated about a sensor, `consensus` does.
  CaseViews views(const Case& c, Grouping grouping) const;
  /// The same as a comparison with these parameters takes them: with the priors' poses refined, unless that is off.
  CaseViews refined_views(const Case& c, const CompareParameters& parameters) const;
  /// The coarsest spacing of the shots of any scan: what T_a is a multiple of.
  double spacing_rad() const { return spacing_rad_; }

 private:
  struct IndexedScan {
    std::shared_ptr<const ScanIndex> published;  ///< for `union`: every return
    std::shared_ptr<const ScanIndex> weighed;    ///< for `consensus`: without the rig and what stands for "no return"
  };
  static IndexedScan index(const SimulatedScan& scan, Profile profile);
  ScanView view(std::size_t scan, Grouping grouping) const;

  const Place* place_;
  std::vector<IndexedScan> scans_;
  double spacing_rad_ = 0.0;
};

}  // namespace raywatch::evaluation
