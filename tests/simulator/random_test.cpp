#include "tests/simulator/random.hpp"

#include <doctest/doctest.h>

using namespace raywatch::simulator;

namespace {

struct Moments {
  double mean = 0.0;
  double variance = 0.0;
};

template <class Draw>
Moments moments_of(int count, const Draw& draw) {
  double sum = 0.0;
  double squares = 0.0;
  for (int i = 0; i < count; ++i) {
    const double value = draw(static_cast<std::uint64_t>(i));
    sum += value;
    squares += value * value;
  }
  return {sum / count, squares / count - sum / count * (sum / count)};
}

}  // namespace

TEST_CASE("random numbers have the moments of their distributions") {
  const CounterRandom random(42);
  // 100,000 draws: one standard error of the mean is 0.0032 (normal) and 0.0009 (uniform).
  const Moments normal = moments_of(100'000, [&](auto i) { return random.normal(Purpose::range_noise, i); });
  CHECK(std::abs(normal.mean) < 0.015);
  CHECK(normal.variance == doctest::Approx(1.0).epsilon(0.025));
  const Moments uniform = moments_of(100'000, [&](auto i) { return random.uniform(Purpose::dropout, i); });
  CHECK(uniform.mean == doctest::Approx(0.5).epsilon(0.01));
  CHECK(uniform.variance == doctest::Approx(1.0 / 12.0).epsilon(0.02));
}

TEST_CASE("numbers of different seeds, purposes and indices are uncorrelated") {
  const CounterRandom a(1);
  const CounterRandom b(2);
  const auto correlation = [](const auto& product) { return moments_of(100'000, product).mean; };
  CHECK(std::abs(correlation(
            [&](auto i) { return a.normal(Purpose::range_noise, i) * b.normal(Purpose::range_noise, i); })) < 0.015);
  CHECK(std::abs(correlation(
            [&](auto i) { return a.normal(Purpose::range_noise, i) * a.normal(Purpose::azimuth_noise, i); })) < 0.015);
  CHECK(std::abs(correlation([&](auto i) {
          return a.normal(Purpose::range_noise, i) * a.normal(Purpose::range_noise, i + 1);
        })) < 0.015);
}
