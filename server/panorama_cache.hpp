#pragma once

#include <cstdint>
#include <list>
#include <memory>
#include <mutex>
#include <unordered_map>

#include "core/panorama.hpp"
#include "storage/payloads.hpp"
#include "storage/scans.hpp"

namespace raywatch {

/// Keeps the panoramas of the scans that were offered last: the latest of each vantage are asked about by every new
/// scan around. Some 15 kB each, at most `kMost`. Thread-safe.
class PanoramaCache {
 public:
  static constexpr std::size_t kMost = 1024;

  explicit PanoramaCache(const Payloads& payloads) : payloads_(payloads) {}

  /// @throws what reading it throws.
  std::shared_ptr<const Panorama> get(const ScanRecord& scan);

 private:
  using Entry = std::pair<ScanId, std::shared_ptr<const Panorama>>;
  using Entries = std::list<Entry>;  // the one used last comes first

  std::shared_ptr<const Panorama> find(ScanId scan);

  const Payloads& payloads_;
  std::mutex mutex_;
  Entries entries_;
  std::unordered_map<std::int64_t, Entries::iterator> by_scan_;  ///< ids are never used again
};

}  // namespace raywatch
