#pragma once

#include <array>
#include <string>
#include <string_view>

namespace raywatch {

inline constexpr std::array<std::string_view, 6> kLogLevels = {"trace", "debug", "info", "warning", "error", "off"};
inline constexpr std::array<std::string_view, 2> kLogFormats = {"human", "json"};

struct LogConfig {
  std::string level = "info";    ///< one of `kLogLevels`; what is less grave is not logged
  std::string format = "human";  ///< human: a readable line an entry; json: an object a line
};

/// Sets up the log of the process, on standard error. To be called before anything is logged.
void start_log(const LogConfig& config);

}  // namespace raywatch
