#include "api/ordered_points.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

namespace raywatch {

std::shared_ptr<const PointSet> OrderedPoints::get(const std::string& key, const Build& build) {
  if (auto found = find(key)) return found;
  auto built = std::make_shared<const PointSet>(build());
  keep(key, built);
  return built;
}

std::shared_ptr<const PointSet> OrderedPoints::find(const std::string& key) {
  const std::lock_guard lock(mutex_);
  const auto found = std::ranges::find(entries_, key, &Entry::key);
  if (found == entries_.end()) return nullptr;
  entries_.splice(entries_.begin(), entries_, found);
  return found->set;
}

void OrderedPoints::keep(const std::string& key, std::shared_ptr<const PointSet> set) {
  if (bytes_of(*set) > limit_bytes_) return;
  const std::lock_guard lock(mutex_);
  if (std::ranges::find(entries_, key, &Entry::key) != entries_.end()) return;
  entries_.push_front({key, std::move(set)});
  std::size_t bytes = 0;
  for (auto entry = entries_.begin(); entry != entries_.end();) {
    bytes += bytes_of(*entry->set);
    entry = bytes > limit_bytes_ ? entries_.erase(entry) : std::next(entry);
  }
}

}  // namespace raywatch
