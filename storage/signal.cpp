#include "storage/signal.hpp"

namespace raywatch {

std::uint64_t Signal::generation() const {
  const std::lock_guard lock(mutex_);
  return generation_;
}

void Signal::notify() {
  const std::lock_guard lock(mutex_);
  ++generation_;
  changed_.notify_all();
}

bool Signal::wait_past(std::uint64_t seen, Clock::time_point deadline) {
  std::unique_lock lock(mutex_);
  changed_.wait_until(lock, deadline, [&] { return closed_ || generation_ > seen; });
  return !closed_ && generation_ > seen;
}

bool Signal::is_closed() const {
  const std::lock_guard lock(mutex_);
  return closed_;
}

void Signal::close() {
  const std::lock_guard lock(mutex_);
  closed_ = true;
  changed_.notify_all();
}

}  // namespace raywatch
