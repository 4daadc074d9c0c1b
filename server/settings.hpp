#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
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

/// What the command line says; it wins over the file.
struct SettingsGiven {
  std::optional<std::string> data_dir, host, log_format, log_level;
  std::optional<std::uint16_t> port;
  bool allow_remote = false;
};

/// Reads a configuration file and checks all that `serve` needs to start: also what only shows beside other settings or
/// on this machine's disk. What nobody names keeps its default.
/// @throws InvalidInput with every error: key, line, and what would be right.
Settings read_settings(const std::filesystem::path& file, const SettingsGiven& given = {});

/// The same from text; `name` stands in messages.
Settings parse_settings(std::string_view toml, const std::string& name, const SettingsGiven& given = {});

/// How a configuration file stands to the defaults.
struct SettingsReport {
  std::vector<std::string> absent;   ///< keys that a file may have and this one does not
  std::vector<std::string> changed;  ///< keys with another value than the default
};
SettingsReport compare_with_defaults(std::string_view toml, const std::string& name);

}  // namespace raywatch
