#pragma once

#include <chrono>

namespace raywatch {

/// Wall time in laps, in milliseconds.
class Stopwatch {
 public:
  /// Since construction.
  double total_ms() const { return to_ms(Clock::now() - start_); }

  /// Since the lap before, or construction.
  double lap_ms() {
    const Clock::time_point now = Clock::now();
    const double lap = to_ms(now - lap_);
    lap_ = now;
    return lap;
  }

  template <class Rep, class Period>
  static double to_ms(std::chrono::duration<Rep, Period> time) {
    return std::chrono::duration<double, std::milli>(time).count();
  }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point start_ = Clock::now();
  Clock::time_point lap_ = start_;
};

}  // namespace raywatch
