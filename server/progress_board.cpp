#include "server/progress_board.hpp"

namespace raywatch {

double ProgressBoard::of(ComparisonId id) const {
  const std::lock_guard lock(mutex_);
  const auto found = shares_.find(id);
  return found == shares_.end() ? 0.0 : found->second;
}

void ProgressBoard::set(ComparisonId id, double share) {
  const std::lock_guard lock(mutex_);
  shares_[id] = share;
}

void ProgressBoard::remove(ComparisonId id) {
  const std::lock_guard lock(mutex_);
  shares_.erase(id);
}

}  // namespace raywatch
