#include "core/trend.hpp"

#include <doctest/doctest.h>
#include <rapidcheck.h>

#include <cmath>

#include "core/error.hpp"
#include "tests/simulator/random.hpp"

namespace raywatch {
namespace {

using namespace std::chrono_literals;

const Time kStart = parse_rfc3339("2026-03-01T00:00:00Z");

Time after_days(double days) {
  return kStart + std::chrono::duration_cast<Duration>(std::chrono::duration<double, std::ratio<86400>>(days));
}
double days_of(Time time) { return std::chrono::duration<double, std::ratio<86400>>(time - kStart).count(); }

/// Displacement whose velocity is 1 / (slope (failure - t)): the integral is a logarithm.
std::vector<TrendValue> creep(double failure_days, double slope, double until_days, double noise, std::uint64_t seed) {
  simulator::RandomSequence random(seed);
  std::vector<TrendValue> series;
  for (double t = 0.0; t <= until_days; t += 0.25) {
    series.push_back({after_days(t), -std::log(1.0 - t / failure_days) / slope + noise * random.normal()});
  }
  return series;
}

TEST_CASE("the velocity of a straight series is its slope, wherever it is asked") {
  std::vector<TrendValue> series;
  for (int i = 0; i < 20; ++i) series.push_back({after_days(0.5 * i), 3.0 + 1.5 * i});
  const std::vector<Velocity> found = velocities(series, {.window = 48h});
  CHECK(found.size() == 18);
  for (const Velocity& v : found) {
    CHECK(v.per_day == doctest::Approx(3.0));
    CHECK(v.sigma_per_day == doctest::Approx(0.0));
  }
}

TEST_CASE("the standard error of a velocity is how far velocities scatter") {
  double scatter2 = 0.0, claimed2 = 0.0;
  for (std::uint64_t seed = 1; seed <= 400; ++seed) {
    simulator::RandomSequence random(seed);
    std::vector<TrendValue> series;
    for (int i = 0; i < 10; ++i) series.push_back({after_days(i), 2.0 * i + 0.3 * random.normal()});
    const Velocity v = velocities(series, {.window = 24h * 30}).back();
    scatter2 += (v.per_day - 2.0) * (v.per_day - 2.0);
    claimed2 += v.sigma_per_day * v.sigma_per_day;
  }
  CHECK(claimed2 / scatter2 == doctest::Approx(1.0).epsilon(0.2));
}

TEST_CASE("a window with too few values has no velocity, and a series out of order is refused") {
  const std::vector<TrendValue> sparse{{after_days(0), 0}, {after_days(10), 1}, {after_days(20), 2}};
  CHECK(velocities(sparse, {.window = 72h}).empty());
  const std::vector<TrendValue> mixed{{after_days(1), 0}, {after_days(0), 1}};
  CHECK_THROWS_AS(velocities(mixed, {}), InvalidInput);
}

TEST_CASE("a series through centuries has its velocities, and no forecast beyond the last time there is") {
  const Time first = parse_rfc3339("1678-01-01T00:00:00Z"), last = parse_rfc3339("2261-12-01T00:00:00Z");
  const std::vector<TrendValue> apart{{first, 0}, {first + 24h, 1}, {first + 48h, 2}, {last, 3}};
  CHECK(velocities(apart, {.window = 24h * 365}).size() == 1);
  std::vector<Velocity> late;
  for (int i = 0; i < 8; ++i) late.push_back({last + i * 24h, 1.0 / (0.2 * (9'000.0 - i))});
  CHECK_FALSE(forecast_failure(late, {}).has_value());
}

TEST_CASE("the forecast of a creep whose inverse velocity is a line is where that line meets zero") {
  std::vector<Velocity> exact;
  for (int i = 0; i < 8; ++i) exact.push_back({after_days(i), 1.0 / (0.2 * (10.0 - i))});
  const auto forecast = forecast_failure(exact, {});
  REQUIRE(forecast);
  CHECK(days_of(forecast->at) == doctest::Approx(10.0));
  CHECK(forecast->r_squared == doctest::Approx(1.0));
  CHECK(forecast->values == 8);
}

TEST_CASE("from displacements with noise the forecast comes near, and its interval holds it") {
  int near = 0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    const std::vector<Velocity> speed = velocities(creep(30.0, 0.02, 27.0, 0.05, seed), {.window = 36h});
    const auto forecast = forecast_failure(speed, {.least_per_day = 3.0});
    REQUIRE(forecast);
    near += std::abs(days_of(forecast->at) - 30.0) < 1.5 ? 1 : 0;
    CHECK(forecast->earliest <= forecast->at);
    if (forecast->latest) CHECK(*forecast->latest >= forecast->at);
  }
  CHECK(near >= 38);
}

TEST_CASE("a series that does not accelerate has no forecast") {
  std::vector<Velocity> steady, slowing, few;
  simulator::RandomSequence random(7);
  for (int i = 0; i < 20; ++i) {
    steady.push_back({after_days(i), 2.0 + 0.1 * random.normal()});
    slowing.push_back({after_days(i), 2.0 / (1.0 + i)});
    if (i < 4) few.push_back({after_days(i), 1.0 / (10.0 - i)});
  }
  const auto forecast = forecast_failure(steady, {});
  CHECK((!forecast || days_of(forecast->at) > 40.0));
  CHECK_FALSE(forecast_failure(slowing, {}));
  CHECK_FALSE(forecast_failure(few, {}));
}

const LevelThresholds kThresholds{.yellow = 10.0, .orange = 20.0, .red = 40.0};

std::vector<Level> levels(std::vector<double> values, const LevelThresholds& thresholds) {
  std::vector<Level> result;
  LevelState state;
  for (const double value : values) result.push_back((state = next_level(state, value, thresholds)).level);
  return result;
}

TEST_CASE("a level is raised at its threshold and left only well below it, for some time") {
  using enum Level;
  CHECK(levels({9, 10, 9.5, 8.9, 9.2, 8.9, 8.8}, kThresholds) ==
        std::vector{green, yellow, yellow, yellow, yellow, yellow, green});
  CHECK(levels({50, 5, 15, 5, 5}, kThresholds) == std::vector{red, red, yellow, yellow, green});
}

TEST_CASE("what was not measured changes nothing") {
  using enum Level;
  const double gap = std::nan("");
  CHECK(levels({25, 1, gap, gap, 1}, kThresholds) == std::vector{orange, orange, orange, orange, green});
}

TEST_CASE("several values in a row can be asked for, and the level is what all of them reach") {
  using enum Level;
  LevelThresholds slow = kThresholds;
  slow.raise_after = 3;
  CHECK(levels({50, 50, 5, 50, 25, 50, 50}, slow) == std::vector{green, green, green, green, green, orange, orange});
}

TEST_CASE("a value between a threshold and its clearing keeps any level that it can have") {
  CHECK(rc::check([] {
    LevelState state{.level = static_cast<Level>(*rc::gen::inRange(0, 4))};
    const Level before = state.level;
    const double value = *rc::gen::inRange(0, 6000) / 100.0;
    for (int i = 0; i < 10; ++i) state = next_level(state, value, kThresholds);
    const LevelState again = next_level(state, value, kThresholds);
    RC_ASSERT(again.level == state.level);
    LevelState fresh;
    for (int i = 0; i < 10; ++i) fresh = next_level(fresh, value, kThresholds);
    RC_ASSERT(state.level >= fresh.level);
    RC_ASSERT(state.level <= std::max(before, fresh.level));
  }));
}

TEST_CASE("thresholds out of order are refused by their name") {
  const auto complaint = [](const LevelThresholds& thresholds) {
    try {
      check_thresholds(thresholds);
    } catch (const InvalidInput& error) {
      return error.fields().front().field;
    }
    return std::string("none");
  };
  CHECK(complaint(kThresholds) == "none");
  CHECK(complaint({.yellow = 10.0, .red = 5.0}) == "red");
  CHECK(complaint({.clear_share = 1.5}) == "clear_share");
  CHECK(complaint({.raise_after = 0}) == "raise_after");
}

}  // namespace
}  // namespace raywatch
