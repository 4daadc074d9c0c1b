#pragma once

#include <tbb/task_arena.h>

#include <memory>

#include "core/compare.hpp"
#include "server/index_cache.hpp"
#include "server/panorama_cache.hpp"
#include "storage/scans.hpp"
#include "storage/sites.hpp"
#include "storage/store.hpp"

namespace raywatch {

/// A stored scan as it takes part in a comparison.
struct LoadedScan {
  std::shared_ptr<const IndexedScan> indexed;
  Pose world_from_sensor;  ///< local
  Time captured_at;
  SensorModel sensor;
  PoseUncertainty pose_uncertainty;

  ScanView view() const {
    return {indexed->points, indexed->index, world_from_sensor, captured_at, sensor, pose_uncertainty};
  }
  /// Puts it where its registration says, or where it was reported when poses are taken as they are.
  void place(const ScanRecord& scan, const Site& site, bool refined);
};

/// Brings stored scans into memory, through the cache. Thread-safe.
class ScanLoader {
 public:
  ScanLoader(Store& store, IndexCache& cache) : store_(store), cache_(cache), panoramas_(store.payloads()) {}

  /// Computes in `arena`; must not be called from inside it.
  LoadedScan load(const ScanRecord& scan, const Site& site, const CompareParameters& parameters,
                  tbb::task_arena& arena) const;

  std::shared_ptr<const Panorama> panorama(const ScanRecord& scan) const { return panoramas_.get(scan); }

 private:
  Store& store_;
  IndexCache& cache_;
  mutable PanoramaCache panoramas_;
};

}  // namespace raywatch
