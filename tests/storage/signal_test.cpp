#include "storage/signal.hpp"

#include <doctest/doctest.h>

#include <thread>

namespace raywatch {
namespace {

const auto kNever = Signal::Clock::now() + std::chrono::hours(1);

}  // namespace

TEST_CASE("what was said between looking and waiting is not missed") {
  Signal signal;
  const std::uint64_t seen = signal.generation();
  signal.notify();
  CHECK(signal.wait_past(seen, kNever));
}

TEST_CASE("who waits is woken by another thread") {
  Signal signal;
  const std::uint64_t seen = signal.generation();
  const std::jthread other([&] { signal.notify(); });
  CHECK(signal.wait_past(seen, kNever));
}

TEST_CASE("waiting ends when the time is over") {
  Signal signal;
  CHECK_FALSE(signal.wait_past(signal.generation(), Signal::Clock::now()));
}

TEST_CASE("nobody waits for a closed signal") {
  Signal signal;
  const std::uint64_t seen = signal.generation();
  const std::jthread other([&] { signal.close(); });
  CHECK_FALSE(signal.wait_past(seen, kNever));
  signal.notify();
  CHECK_FALSE(signal.wait_past(seen, kNever));
}

}  // namespace raywatch
