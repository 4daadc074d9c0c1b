#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <string>

#include "core/error.hpp"

namespace raywatch {

/// How many streams without an end may be open at once: each holds a thread of the server. Thread-safe.
class StreamSlots {
 public:
  explicit StreamSlots(std::size_t most) : most_(most) {}

 private:
  friend class StreamSlot;
  const std::size_t most_;
  std::atomic<std::size_t> taken_ = 0;
};

/// One of them, as long as it lives.
class StreamSlot {
 public:
  /// @throws Overloaded when all are taken.
  explicit StreamSlot(StreamSlots& slots) : slots_(slots) {
    if (slots_.taken_.fetch_add(1) < slots_.most_) return;
    --slots_.taken_;
    constexpr std::chrono::seconds kRetryAfter{5};
    throw Overloaded(std::to_string(slots_.most_) + " clients listen already; raise http.threads for more",
                     kRetryAfter);
  }
  ~StreamSlot() { --slots_.taken_; }
  StreamSlot(const StreamSlot&) = delete;
  StreamSlot& operator=(const StreamSlot&) = delete;

 private:
  StreamSlots& slots_;
};

}  // namespace raywatch
