#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "server/daemon.hpp"
#include "server/log.hpp"

namespace raywatch {

/// Every setting of the program, each a plain struct beside the module that it belongs to.
struct Settings {
  DaemonConfig daemon;
  LogConfig log;
};

/// Reads a configuration file. What it does not name keeps its default.
/// @throws InvalidInput with every error of the file: key, line, and what would be right.
Settings read_settings(const std::filesystem::path& file);

/// The same from text; `name` stands in messages.
Settings parse_settings(std::string_view toml, const std::string& name);

/// How a configuration file stands to the defaults.
struct SettingsReport {
  std::vector<std::string> absent;   ///< keys that a file may have and this one does not
  std::vector<std::string> changed;  ///< keys with another value than the default
};
SettingsReport compare_with_defaults(std::string_view toml, const std::string& name);

}  // namespace raywatch
