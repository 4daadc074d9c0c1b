#pragma once

#include <mutex>
#include <unordered_map>

#include "core/ids.hpp"

namespace raywatch {

/// How far each running comparison is. Thread-safe.
class ProgressBoard {
 public:
  /// 0..1; 0 for one that does not run.
  double of(ComparisonId id) const;
  void set(ComparisonId id, double share);
  void remove(ComparisonId id);

 private:
  mutable std::mutex mutex_;
  std::unordered_map<ComparisonId, double> shares_;
};

}  // namespace raywatch
