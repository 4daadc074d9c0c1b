#include "server/index_cache.hpp"

#include <utility>

namespace raywatch {

std::uint64_t IndexedScan::bytes() const {
  const std::size_t floats =
      points.x_m.capacity() + points.y_m.capacity() + points.z_m.capacity() + points.intensity.capacity();
  return floats * sizeof(float) + index.bytes() + sizeof(*this);
}

std::size_t IndexKeyHash::operator()(const IndexKey& key) const noexcept {
  // The ranges hardly ever differ between the keys of one scan.
  return std::hash<ScanId>{}(key.scan);
}

std::shared_ptr<const IndexedScan> IndexCache::get(const IndexKey& key, const Build& build) {
  std::unique_lock lock(mutex_);
  for (auto found = by_key_.find(key); found != by_key_.end(); found = by_key_.find(key)) {
    if (found->second->scan) {
      ++status_.hits;
      entries_.splice(entries_.begin(), entries_, found->second);
      return found->second->scan;
    }
    built_.wait(lock);
  }
  ++status_.misses;
  entries_.push_front({key, nullptr, 0});
  const Entries::iterator entry = entries_.begin();
  by_key_.emplace(key, entry);

  lock.unlock();
  std::shared_ptr<const IndexedScan> scan;
  try {
    scan = std::make_shared<const IndexedScan>(build());
  } catch (...) {
    lock.lock();
    erase(entry);
    built_.notify_all();
    throw;
  }
  lock.lock();
  keep(entry, scan);
  built_.notify_all();
  return scan;
}

void IndexCache::put(const IndexKey& key, IndexedScan scan) {
  const std::lock_guard lock(mutex_);
  if (by_key_.contains(key)) return;
  entries_.push_front({key, nullptr, 0});
  by_key_.emplace(key, entries_.begin());
  keep(entries_.begin(), std::make_shared<const IndexedScan>(std::move(scan)));
}

void IndexCache::forget(ScanId scan) {
  const std::lock_guard lock(mutex_);
  for (auto entry = entries_.begin(); entry != entries_.end();) {
    const auto next = std::next(entry);
    if (entry->key.scan == scan && entry->scan) erase(entry);
    entry = next;
  }
}

IndexCacheStatus IndexCache::status() const {
  const std::lock_guard lock(mutex_);
  return status_;
}

void IndexCache::keep(Entries::iterator entry, std::shared_ptr<const IndexedScan> scan) {
  entry->bytes = scan->bytes();
  entry->scan = std::move(scan);
  status_.bytes += entry->bytes;
  for (auto oldest = entries_.end(); status_.bytes > limit_bytes_ && oldest != entries_.begin();) {
    const auto candidate = std::prev(oldest);
    oldest = candidate;
    if (!candidate->scan) continue;  // being built
    oldest = std::next(candidate);
    erase(candidate);
  }
}

void IndexCache::erase(Entries::iterator entry) {
  status_.bytes -= entry->bytes;
  by_key_.erase(entry->key);
  entries_.erase(entry);
}

}  // namespace raywatch
