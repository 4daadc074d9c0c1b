#pragma once

#include <map>
#include <span>
#include <utility>
#include <vector>

#include "core/compare.hpp"
#include "core/rule.hpp"
#include "core/track.hpp"
#include "storage/comparisons.hpp"
#include "storage/scans.hpp"
#include "storage/sites.hpp"
#include "storage/store.hpp"
#include "storage/tracks.hpp"

namespace raywatch {

struct WatchConfig {
  std::uint32_t learn_scans = 3;  ///< of each vantage, the first so many are what is normal
  /// A scan from a new vantage learns when what is normal already tells about less than this share of its points;
  /// otherwise it is judged by that.
  double learn_below_testable = 0.8;
  std::chrono::seconds late_tolerance{2};  ///< sensors of one site may be so far behind each other
  std::chrono::seconds moved_within{600};  ///< an object is missed here and found there within this time
  std::size_t sample_points = 64;          ///< points of a change that later scans are asked about
  std::size_t coverage_places = 500;       ///< places in a zone about which each scan is asked
};

/// What a scan is asked about: the places of tracks and the zones of its site.
struct SiteView {
  std::vector<TrackRecord> tracks;
  std::vector<Zone> zones;
};

/// What a scan shows of the tracks and zones of its site; everything that needs its points.
struct Glance {
  std::vector<std::vector<Eigen::Vector3f>> samples;  ///< of each change of the comparison
  std::map<TrackId, Sight> sights;                    ///< of the tracks that were followed when it was asked
  std::vector<std::pair<ZoneId, double>> coverage;
};

/// The result of a watching comparison on its way into the store.
struct WatchedComparison {
  const ScanRecord& scan;  ///< with its registration
  const Site& site;
  ComparisonId comparison;
  double testable = 0.0;
  std::span<const Change> changes;
  std::span<const ChangeId> ids;  ///< of the changes
};

/// Watches a site: learns what is normal, follows changes through time, and judges them by the rules. What it decides
/// follows from the store and the scan alone, and is committed together with the comparison, so that a crash at any
/// moment neither loses nor repeats any of it. Thread-safe; the scans of one site must come one after the other.
class Watcher {
 public:
  explicit Watcher(const WatchConfig& config) : config_(config) {}

  SiteView view_site(const Snapshot& snapshot, SiteId site) const;
  /// Asks the scan, before the transaction. Computes in the caller's arena.
  Glance look(const SiteView& site, const ScanView& scan, std::span<const ScanView> priors,
              const Comparison& comparison, const CompareParameters& parameters) const;

  /// Brings baseline, tracks, alerts and events up to the scan.
  void commit(Transaction& transaction, const WatchedComparison& watched, const Glance& glance, Time now) const;

 private:
  WatchRole role_of(const Snapshot& snapshot, const WatchedComparison& watched) const;
  bool is_late(const Snapshot& snapshot, const ScanRecord& scan) const;
  void learn(Transaction& transaction, const WatchedComparison& watched, WatchRole role, Time now) const;

  WatchConfig config_;
};

}  // namespace raywatch
