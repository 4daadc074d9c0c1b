#pragma once

#include <cstddef>

#include "core/time.hpp"
#include "storage/store.hpp"

namespace raywatch {

/// A run that begins no later than this after its due time and grace was not missed.
inline constexpr Duration kPunctual = std::chrono::minutes(15);

/// Makes the runs of schedules when they are due. Keeps nothing in memory, so that it goes on where it was after a
/// restart; a clock that jumps forward makes missed runs, one that jumps back makes no run twice that brought
/// something.
class ScheduleClock {
 public:
  explicit ScheduleClock(Store& store) : store_(store) {}

  /// Makes all runs that are due by now, as each schedule catches up. @returns how many were queued.
  /// @throws core/error.hpp.
  std::size_t look(Time now);

 private:
  Store& store_;
};

}  // namespace raywatch
