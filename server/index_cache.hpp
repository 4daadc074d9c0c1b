#pragma once

#include <condition_variable>
#include <cstdint>
#include <functional>
#include <list>
#include <memory>
#include <mutex>
#include <unordered_map>

#include "core/ids.hpp"
#include "core/point_cloud.hpp"
#include "core/prior_index.hpp"

namespace raywatch {

/// A stored scan in memory, ready to be compared.
struct IndexedScan {
  PointCloud points;
  PriorIndex index;

  std::uint64_t bytes() const;
};

/// Which scan, and which of its returns are indexed.
struct IndexKey {
  ScanId scan;
  double min_range_m = 0.0, max_range_m = 0.0, no_return_m = 0.0;

  IndexKey(ScanId id, const UsableRange& usable)
      : scan(id), min_range_m(usable.min_m), max_range_m(usable.max_m), no_return_m(usable.no_return_m.value_or(0.0)) {}
  friend bool operator==(const IndexKey&, const IndexKey&) = default;
};

struct IndexKeyHash {
  std::size_t operator()(const IndexKey& key) const noexcept;
};

struct IndexCacheStatus {
  std::uint64_t bytes = 0, hits = 0, misses = 0;
};

/// Keeps the scans that were used last, bounded in bytes. What is in use outlives its place here, so the memory of the
/// process is bounded by the limit plus what running comparisons hold. Thread-safe.
class IndexCache {
 public:
  using Build = std::function<IndexedScan()>;

  explicit IndexCache(std::uint64_t limit_bytes) : limit_bytes_(limit_bytes) {}

  /// The scan of `key`, by `build` if it is not here. Two threads that ask for the same key get one build: the second
  /// waits, so this must not be called from inside a task of an arena that `build` runs in. What `build` throws comes
  /// out here, and the next call builds again.
  std::shared_ptr<const IndexedScan> get(const IndexKey& key, const Build& build);

  /// Takes a scan that is in memory already. Nothing happens when it is here or being built.
  void put(const IndexKey& key, IndexedScan scan);

  /// Forgets a scan that was deleted.
  void forget(ScanId scan);

  IndexCacheStatus status() const;

 private:
  struct Entry {
    IndexKey key;
    std::shared_ptr<const IndexedScan> scan;  ///< empty while it is being built
    std::uint64_t bytes = 0;
  };
  using Entries = std::list<Entry>;  // the one used last comes first

  void keep(Entries::iterator entry, std::shared_ptr<const IndexedScan> scan);
  void erase(Entries::iterator entry);

  const std::uint64_t limit_bytes_;
  mutable std::mutex mutex_;
  std::condition_variable built_;
  Entries entries_;
  std::unordered_map<IndexKey, Entries::iterator, IndexKeyHash> by_key_;
  IndexCacheStatus status_;
};

}  // namespace raywatch
