#include "core/trend.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/names.hpp"

namespace raywatch {
namespace {

constexpr Names<Level, kLevels> kLevelNames{
    {{Level::green, "green"}, {Level::yellow, "yellow"}, {Level::orange, "orange"}, {Level::red, "red"}}};

using Days = std::chrono::duration<double, std::ratio<86400>>;

struct TrendSample {
  double t;
  double y;
};

/// A least-squares line of at least three samples at different times.
struct Line {
  double mean_t, mean_y, slope;
  double stt;         ///< sum of (t - mean t)^2
  double residual2;   ///< sum of squares around the line
  double deviation2;  ///< sum of squares around the mean
  double n;

  double variance() const { return residual2 / (n - 2.0); }
};

Line fit_line(std::span<const TrendSample> samples) {
  Line line{.n = static_cast<double>(samples.size())};
  for (const TrendSample& s : samples) {
    line.mean_t += s.t / line.n;
    line.mean_y += s.y / line.n;
  }
  double sty = 0.0;
  for (const TrendSample& s : samples) {
    line.stt += (s.t - line.mean_t) * (s.t - line.mean_t);
    sty += (s.t - line.mean_t) * (s.y - line.mean_y);
    line.deviation2 += (s.y - line.mean_y) * (s.y - line.mean_y);
  }
  line.slope = sty / line.stt;
  for (const TrendSample& s : samples) {
    const double off = s.y - line.mean_y - line.slope * (s.t - line.mean_t);
    line.residual2 += off * off;
  }
  return line;
}

double days_since(Time start, Time at) { return Days(between(start, at)).count(); }

/// The two-sided 95 % point of Student's t: Abramowitz and Stegun 26.7.5. Within 1 % from 3 degrees of freedom on.
double student95(double degrees) {
  return 1.959964 + 2.372271 / degrees + 2.822499 / (degrees * degrees) + 2.555853 / (degrees * degrees * degrees);
}

/// The times, as offsets from the mean, between which the line's true zero lies: the roots of
/// (y + b x)^2 = t^2 s^2 (1/n + x^2/Stt).
struct Zero {
  double from;
  std::optional<double> to;
};
std::optional<Zero> zero_of(const Line& line) {
  const double g = std::pow(student95(line.n - 2.0), 2.0) * line.variance();
  const double a = line.slope * line.slope - g / line.stt;
  const double b = line.mean_y * line.slope;
  const double c = line.mean_y * line.mean_y - g / line.n;
  if (a <= 0.0) return std::nullopt;  // the slope is not surely different from 0
  const double root = std::sqrt(std::max(0.0, b * b - a * c));
  return Zero{(-b - root) / a, (-b + root) / a};
}

std::optional<Time> time_at(Time start, double days) {
  constexpr double kMost_days = 36525.0;  // what lies beyond a century says nothing
  if (!(std::abs(days) < kMost_days)) return std::nullopt;
  const auto by = std::chrono::duration_cast<Duration>(Days(days));
  const Time at = shifted(start, by);
  return between(start, at) == by ? std::optional(at) : std::nullopt;
}

std::optional<double> threshold_of(const LevelThresholds& thresholds, Level level) {
  switch (level) {
    case Level::green:
      break;
    case Level::yellow:
      return thresholds.yellow;
    case Level::orange:
      return thresholds.orange;
    case Level::red:
      return thresholds.red;
  }
  return std::nullopt;
}

/// The highest level whose threshold, times a share, the value reaches.
Level level_of(double value, double share, const LevelThresholds& thresholds) {
  for (const Level level : {Level::red, Level::orange, Level::yellow}) {
    const std::optional<double> threshold = threshold_of(thresholds, level);
    if (threshold && value >= share * *threshold) return level;
  }
  return Level::green;
}

}  // namespace

std::string_view to_string(Level level) { return name_of(kLevelNames, level); }
Level parse_level(std::string_view name) { return value_of(kLevelNames, name, "level"); }

std::vector<Velocity> velocities(std::span<const TrendValue> series, const VelocityParameters& parameters) {
  const std::size_t least = std::max<std::size_t>(parameters.least_values, 3);
  for (std::size_t i = 1; i < series.size(); ++i) {
    if (series[i].at <= series[i - 1].at) throw InvalidInput("The values of a series must be in the order of time.");
  }
  std::vector<Velocity> result;
  std::vector<TrendSample> samples;
  std::size_t first = 0;
  for (std::size_t i = 0; i < series.size(); ++i) {
    while (between(series[first].at, series[i].at) > parameters.window) ++first;
    if (i + 1 - first < least) continue;
    samples.clear();
    for (std::size_t k = first; k <= i; ++k)
      samples.push_back({days_since(series[i].at, series[k].at), series[k].value});
    const Line line = fit_line(samples);
    result.push_back({series[i].at, line.slope, std::sqrt(line.variance() / line.stt)});
  }
  return result;
}

std::optional<FailureForecast> forecast_failure(std::span<const Velocity> velocities,
                                                const ForecastParameters& parameters) {
  const double least_per_day = std::max(parameters.least_per_day, 0.0);
  std::size_t first = velocities.size();
  while (first > 0 && velocities[first - 1].per_day > least_per_day) --first;
  if (velocities.size() - first < std::max<std::size_t>(parameters.least_values, 5)) return std::nullopt;
  const Time start = velocities.back().at;
  std::vector<TrendSample> samples;
  for (const Velocity& v : velocities.subspan(first)) samples.push_back({days_since(start, v.at), 1.0 / v.per_day});
  const Line line = fit_line(samples);
  const std::optional<Zero> zero = zero_of(line);
  if (line.slope >= 0.0 || !zero) return std::nullopt;
  const std::optional<Time> at = time_at(start, line.mean_t - line.mean_y / line.slope);
  const std::optional<Time> earliest = time_at(start, line.mean_t + zero->from);
  if (!at || !earliest) return std::nullopt;
  return FailureForecast{.at = *at,
                         .earliest = *earliest,
                         .latest = time_at(start, line.mean_t + zero->to.value()),
                         .r_squared = 1.0 - line.residual2 / line.deviation2,
                         .values = samples.size()};
}

void check_thresholds(const LevelThresholds& thresholds) {
  std::vector<FieldError> errors;
  double below = 0.0;
  for (const Level level : {Level::yellow, Level::orange, Level::red}) {
    const std::optional<double> threshold = threshold_of(thresholds, level);
    if (!threshold) continue;
    if (!(*threshold > below) || !std::isfinite(*threshold)) {
      errors.push_back({std::string(to_string(level)), "must be above 0 and above the thresholds of lower levels"});
    }
    below = std::max(below, *threshold);
  }
  if (!(thresholds.clear_share > 0.0 && thresholds.clear_share <= 1.0)) {
    errors.push_back({"clear_share", "must be above 0 and at most 1"});
  }
  if (thresholds.raise_after == 0) errors.push_back({"raise_after", "must be at least 1"});
  if (thresholds.clear_after == 0) errors.push_back({"clear_after", "must be at least 1"});
  if (!errors.empty()) throw InvalidInput("The thresholds are not in order.", std::move(errors));
}

LevelState next_level(const LevelState& state, double value, const LevelThresholds& thresholds) {
  if (!std::isfinite(value)) return state;
  const Level raised = level_of(value, 1.0, thresholds);
  const Level held = level_of(value, thresholds.clear_share, thresholds);
  const bool rises = raised > state.level, falls = held < state.level;
  if (!rises && !falls) return {.level = state.level, .pending = state.level};
  // Of values in a row the most careful counts: the lowest that all of them reach, the highest that any still holds.
  const bool goes_on = state.count > 0 && (state.pending > state.level) == rises;
  const Level asked =
      rises ? (goes_on ? std::min(raised, state.pending) : raised) : (goes_on ? std::max(held, state.pending) : held);
  const std::uint32_t count = goes_on ? state.count + 1 : 1;
  if (count >= (rises ? thresholds.raise_after : thresholds.clear_after)) return {.level = asked, .pending = asked};
  return {.level = state.level, .pending = asked, .count = count};
}

}  // namespace raywatch
