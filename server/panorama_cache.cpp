#include "server/panorama_cache.hpp"

#include <utility>

namespace raywatch {

std::shared_ptr<const Panorama> PanoramaCache::find(ScanId scan) {
  const std::lock_guard lock(mutex_);
  const auto found = by_scan_.find(scan.value);
  if (found == by_scan_.end()) return nullptr;
  entries_.splice(entries_.begin(), entries_, found->second);
  return found->second->second;
}

std::shared_ptr<const Panorama> PanoramaCache::get(const ScanRecord& scan) {
  if (std::shared_ptr<const Panorama> found = find(scan.id)) return found;
  auto panorama = std::make_shared<const Panorama>(payloads_.scan_panorama(scan.payload));
  const std::lock_guard lock(mutex_);
  if (by_scan_.contains(scan.id.value)) return panorama;
  entries_.emplace_front(scan.id, panorama);
  by_scan_[scan.id.value] = entries_.begin();
  if (entries_.size() > kMost) {
    by_scan_.erase(entries_.back().first.value);
    entries_.pop_back();
  }
  return panorama;
}

}  // namespace raywatch
