#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <random>
#include <span>

namespace raywatch {

/// How long to wait after the attempt number `attempts` (from 1): the delay of that number, the last for all that
/// follow, spread by a fifth to both sides, so that what failed together is not tried together.
/// @param delays not empty
std::chrono::milliseconds retry_delay(std::span<const std::chrono::milliseconds> delays, std::uint32_t attempts,
                                      std::mt19937_64& random);

/// When a channel may send: so many messages a minute, and after a failure only when the receiver had time to recover,
/// the longer, the more have failed in a row. Not thread-safe.
class Pace {
 public:
  using Clock = std::chrono::steady_clock;

  Pace(std::uint32_t per_minute, std::chrono::milliseconds first_rest)
      : per_minute_(per_minute), first_rest_(first_rest) {}

  /// The moment from which on the next message may go out.
  Clock::time_point next() const;
  void sent(Clock::time_point now);
  void succeeded() { failures_ = 0; }
  /// @param at_least as the receiver asked
  void failed(Clock::time_point now, std::chrono::milliseconds at_least);
  std::uint32_t failures_in_a_row() const { return failures_; }

 private:
  std::uint32_t per_minute_;
  std::chrono::milliseconds first_rest_;
  std::uint32_t failures_ = 0;
  Clock::time_point rest_until_{};
  std::deque<Clock::time_point> sent_;  ///< the last `per_minute`
};

}  // namespace raywatch
