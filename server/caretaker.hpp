#pragma once

#include <cstdint>
#include <functional>
#include <stop_token>
#include <thread>

#include "core/time.hpp"
#include "server/retention_keeper.hpp"
#include "storage/store.hpp"

namespace raywatch {

struct CaretakerConfig {
  std::uint64_t low_disk_bytes = 0;  ///< less free disk than this is told
};

/// What happens without a scan: snoozes that are over, sensors that fall silent, a disk that fills up. Each call does
/// what is due; nothing is kept between calls. Thread-safe.
class Caretaker {
 public:
  Caretaker(Store& store, const CaretakerConfig& config) : store_(store), config_(config) {}

  /// @throws core/error.hpp when the store cannot be read or written.
  void look_after(Time now);

 private:
  void wake_snoozed(Time now);
  void look_after_sensors(Time now);
  void look_after_disk(Time now);

  Store& store_;
  CaretakerConfig config_;
};

/// The thread that calls it, and has retention kept, once a second. What they throw is logged, and tried again.
class CaretakerThread {
 public:
  CaretakerThread(Caretaker& caretaker, RetentionKeeper& retention, std::function<Time()> now);

 private:
  std::jthread thread_;
};

}  // namespace raywatch
