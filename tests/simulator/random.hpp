#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstdint>
#include <numbers>

namespace raywatch::simulator {

/// The finaliser of splitmix64 (Steele, Lea, Flood 2014): a bijection of 64 bits without visible structure.
constexpr std::uint64_t scrambled(std::uint64_t bits) {
  bits += 0x9e3779b97f4a7c15ULL;
  bits = (bits ^ (bits >> 30)) * 0xbf58476d1ce4e5b9ULL;
  bits = (bits ^ (bits >> 27)) * 0x94d049bb133111ebULL;
  return bits ^ (bits >> 31);
}

/// What a random number is for. Numbers of different purposes are independent.
enum class Purpose : std::uint64_t {
  azimuth_noise,
  elevation_noise,
  range_noise,
  dropout,
  self_return,
  registration,
  sway,
  scene,
};

/// Random numbers that depend on nothing but (seed, purpose, index): the same for any order and number of threads.
class CounterRandom {
 public:
  explicit constexpr CounterRandom(std::uint64_t seed) : seed_(scrambled(seed)) {}

  constexpr std::uint64_t bits(Purpose purpose, std::uint64_t index) const {
    return scrambled(scrambled(seed_ ^ scrambled(static_cast<std::uint64_t>(purpose) + 1)) + index);
  }
  /// In [0, 1).
  double uniform(Purpose purpose, std::uint64_t index) const { return to_unit(bits(purpose, index)); }
  /// Mean 0, standard deviation 1 (Box-Muller).
  double normal(Purpose purpose, std::uint64_t index) const {
    const std::uint64_t first = bits(purpose, index);
    const double radius = std::sqrt(-2.0 * std::log1p(-to_unit(first)));
    return radius * std::cos(2.0 * std::numbers::pi * to_unit(scrambled(first ^ 0xd1b54a32d192ed03ULL)));
  }

 private:
  static double to_unit(std::uint64_t bits) { return static_cast<double>(bits >> 11) * 0x1.0p-53; }

  std::uint64_t seed_;
};

/// An interval to draw from.
struct Interval {
  double from;
  double to;
};

/// A sequence of random numbers, for building scenes.
class RandomSequence {
 public:
  explicit constexpr RandomSequence(std::uint64_t seed, Purpose purpose = Purpose::scene)
      : random_(seed), purpose_(purpose) {}

  double in(const Interval& interval) {
    return interval.from + (interval.to - interval.from) * random_.uniform(purpose_, next_++);
  }
  double normal() { return random_.normal(purpose_, next_++); }
  Eigen::Vector3d normal_vector() {
    const double x = normal();
    const double y = normal();
    return {x, y, normal()};
  }
  bool chance(double probability) { return random_.uniform(purpose_, next_++) < probability; }
  /// In 0 .. count - 1; `count` must not be 0.
  std::uint64_t below(std::uint64_t count) { return random_.bits(purpose_, next_++) % count; }
  /// A seed for something that shall not depend on how many numbers were drawn elsewhere.
  std::uint64_t seed() { return random_.bits(purpose_, next_++); }

 private:
  CounterRandom random_;
  Purpose purpose_;
  std::uint64_t next_ = 0;
};

}  // namespace raywatch::simulator
