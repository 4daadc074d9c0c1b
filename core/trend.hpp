#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "core/time.hpp"

namespace raywatch {

/// One value of a series: a volume, a displacement.
struct TrendValue {
  Time at;
  double value = 0.0;
};

struct VelocityParameters {
  Duration window = std::chrono::hours(72);  ///< values this long before a value, and itself, make its velocity
  std::size_t least_values = 3;              ///< fewer make none; at least 3
};

/// How fast a series changes.
struct Velocity {
  Time at;
  double per_day = 0.0;
  double sigma_per_day = 0.0;  ///< standard error, from the scatter of the values around their line
};

/// The slope of the least-squares line through the values of the window, for every value that has enough of them.
/// @param series in the order of time, no two at the same. @throws InvalidInput when it is not.
std::vector<Velocity> velocities(std::span<const TrendValue> series, const VelocityParameters& parameters);

struct ForecastParameters {
  double least_per_day = 0.0;    ///< the forecast rests on the latest velocities that are all above
  std::size_t least_values = 5;  ///< and on no fewer; at least 5
};

/// When an accelerating slope would fail.
struct FailureForecast {
  Time at;
  /// The interval of 95 %. Nothing: the series does not say how late at the latest.
  Time earliest;
  std::optional<Time> latest;
  double r_squared = 0.0;  ///< of the line through the inverse velocities
  std::size_t values = 0;  ///< that it rests on
};

/// The method of the inverse velocity: in the last stage of creep 1/v falls linearly with time, and the slope fails
/// where the line meets zero. T. Fukuzono, "A new method for predicting the failure time of a slope", 4th International
/// Conference and Field Workshop on Landslides, Tokyo, 1985, for alpha = 2. The interval is that of the ratio of two
/// normal variables after Fieller (1954). Nothing when the inverse velocity does not surely fall.
std::optional<FailureForecast> forecast_failure(std::span<const Velocity> velocities,
                                                const ForecastParameters& parameters);

/// How worrying a figure is.
enum class Level : std::uint8_t { green, yellow, orange, red };
inline constexpr std::size_t kLevels = 4;
std::string_view to_string(Level level);
/// @throws InvalidInput naming the known ones.
Level parse_level(std::string_view name);

/// When a figure has which level. A figure that may fall as well as rise is judged by its magnitude, by the caller.
struct LevelThresholds {
  std::optional<double> yellow, orange, red;  ///< from this value on; not given: the level is not used
  /// A level is left when the value is below this share of its threshold.
  double clear_share = 0.9;
  std::uint32_t raise_after = 1;  ///< so many values in a row must ask for a higher level
  std::uint32_t clear_after = 2;  ///< and so many for a lower one
};
/// @throws InvalidInput naming the field: thresholds must be above 0 and rise, the share lie above 0 and at most 1, the
/// counts be at least 1.
void check_thresholds(const LevelThresholds& thresholds);

/// The level of a figure, and what it may become.
struct LevelState {
  Level level = Level::green;
  Level pending = Level::green;  ///< what the latest values ask for, all of them
  std::uint32_t count = 0;       ///< of the values in a row that ask for another level
  friend bool operator==(const LevelState&, const LevelState&) = default;
};

/// The state after the next value. A value that is not finite changes nothing: what was not measured is no all-clear.
LevelState next_level(const LevelState& state, double value, const LevelThresholds& thresholds);

}  // namespace raywatch
