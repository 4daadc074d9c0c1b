#pragma once

#include <cstddef>
#include <functional>
#include <list>
#include <memory>
#include <mutex>
#include <string>

#include "api/point_set.hpp"

namespace raywatch {

/// Point sets in the order of refinement, kept while their parts are fetched one after the other: the order is one of
/// all points, and finding it costs far more than any part. Those used last stay, bounded in bytes. Thread-safe.
class OrderedPoints {
 public:
  using Build = std::function<PointSet()>;

  explicit OrderedPoints(std::size_t limit_bytes) : limit_bytes_(limit_bytes) {}

  /// The set of `key`, by `build` when it is not here. Two threads that ask for it at once may both build it.
  std::shared_ptr<const PointSet> get(const std::string& key, const Build& build);

 private:
  struct Entry {
    std::string key;
    std::shared_ptr<const PointSet> set;
  };

  std::shared_ptr<const PointSet> find(const std::string& key);
  void keep(const std::string& key, std::shared_ptr<const PointSet> set);

  const std::size_t limit_bytes_;
  std::mutex mutex_;
  std::list<Entry> entries_;  ///< the one used last comes first
};

}  // namespace raywatch
