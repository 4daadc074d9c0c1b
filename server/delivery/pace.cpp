#include "server/delivery/pace.hpp"

#include <algorithm>

namespace raywatch {
namespace {

constexpr std::chrono::minutes kLongestRest{5};
/// More than a day is nothing that a receiver asks for in earnest.
constexpr std::chrono::hours kLongestAsked{24};

}  // namespace

std::chrono::milliseconds retry_delay(std::span<const std::chrono::milliseconds> delays, std::uint32_t attempts,
                                      std::mt19937_64& random) {
  const std::size_t place = std::min<std::size_t>(attempts > 0 ? attempts - 1 : 0, delays.size() - 1);
  const double spread = std::uniform_real_distribution<double>(0.8, 1.2)(random);
  return std::chrono::milliseconds(static_cast<std::int64_t>(static_cast<double>(delays[place].count()) * spread));
}

Pace::Clock::time_point Pace::next() const {
  if (sent_.size() < per_minute_) return rest_until_;
  return std::max(rest_until_, sent_.front() + std::chrono::minutes(1));
}

void Pace::sent(Clock::time_point now) {
  sent_.push_back(now);
  if (sent_.size() > per_minute_) sent_.pop_front();
}

void Pace::failed(Clock::time_point now, std::chrono::milliseconds at_least) {
  constexpr std::uint32_t kDoublings = 10;
  const std::chrono::milliseconds grown = first_rest_ * (std::int64_t{1} << std::min(failures_, kDoublings));
  ++failures_;
  const std::chrono::milliseconds rest = std::min<std::chrono::milliseconds>(grown, kLongestRest);
  rest_until_ = now + std::max(rest, std::min<std::chrono::milliseconds>(at_least, kLongestAsked));
}

}  // namespace raywatch
