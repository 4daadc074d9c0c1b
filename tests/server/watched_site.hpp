#pragma once

#include <tbb/task_arena.h>

#include <string>
#include <vector>

#include "core/profile.hpp"
#include "server/comparison_runner.hpp"
#include "storage/alerts.hpp"
#include "storage/tracks.hpp"
#include "tests/support/temp_dir.hpp"

namespace raywatch {

/// A scan as it comes in.
struct TakenScan {
  std::string sensor;  ///< made, with the scan's pose as its fixed one, when there is none of the name
  PointCloud points;
  Pose world_from_sensor;
  Time captured_at;
};

struct WatchedSiteConfig {
  Profile profile = Profile::indoor;
  WatchConfig watch = {};
  CompareParameters parameters;  ///< of both comparisons that each scan gets
  std::uint64_t cache_bytes = 1 << 28;
  bool sensors_are_fixed = false;
};

/// A store with the site "yard", whose origin is 0, with its default rule, and what compares and watches its scans: all
/// of the daemon but HTTP and threads. Its clock stands where it is put.
class WatchedSite {
 public:
  explicit WatchedSite(const WatchedSiteConfig& config);

  /// Stores a scan, received now, and has it compared with `previous` and with the baseline.
  ScanId put(const TakenScan& scan);
  void set_now(Time now) { now_ = now; }
  Time now() const { return now_; }

  std::vector<TrackRecord> tracks() const;  ///< oldest first
  std::vector<AlertRecord> alerts() const;  ///< oldest first
  Store& store() { return store_; }
  const Store& store() const { return store_; }
  SiteId id() const { return site_; }

 private:
  SensorId sensor_of(const TakenScan& scan);
  void run_jobs();

  TempDir folder_;
  Store store_;
  WatchedSiteConfig config_;
  Time now_;
  IndexCache cache_;
  ProgressBoard progress_;
  ComparisonRunner runner_;
  tbb::task_arena arena_{2};
  SiteId site_;
  int number_ = 0;
};

}  // namespace raywatch
